"""A rig along a parameter."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from stability.followed import between_stops


def test_from_no_dashpot_and_to_none():
    """The rate at which a bumper relaxes is infinite there."""
    turn = 2 * np.pi
    shaken = vi.Harmonic(0.2, 1.2 / turn)
    ends = []
    for damping in (0.0, 1.0):
        data = vi.branch(
            vi.Rig(between_stops(damping), shaken), span=(0.0, 2.0), parameter="stops.damping"
        )
        ends.append(data.isel(point=int(data["stops.damping"].values.argmin())))
        ends.append(data.isel(point=int(data["stops.damping"].values.argmax())))
    for one, other in ((ends[0], ends[2]), (ends[1], ends[3])):
        assert float(one["stops.damping"]) == float(other["stops.damping"])
        np.testing.assert_allclose(one["section"], other["section"], atol=1e-12)


@pytest.mark.parametrize("parameter", ["gap", "amplitude", "stops.stiffness", "stiffness_ratio"])
def test_other_parameters(parameter):
    """Each orbit belongs to the rig that the parameter says."""
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)
    ranges = {
        "gap": (1e-3, 15e-3),
        "amplitude": (0.1, 1.0),
        "stops.stiffness": (1e5, 1e6),
        "stiffness_ratio": (1.0, 50.0),
    }
    low, high = ranges[parameter]
    data = vi.branch(vi.Rig(case.oscillator, shaken), span=(low, high), parameter=parameter)
    assert data.attrs["parameter"] == parameter
    for i in np.linspace(0, data.sizes["point"] - 1, 8).astype(int):
        value = float(data[parameter][i])
        rig, excitation = case.oscillator, shaken
        if parameter == "amplitude":
            excitation = shaken.replace(amplitude=value)
        elif parameter == "gap":
            rig = rig.replace(right=rig.right.replace(gap=value), left=rig.left.replace(gap=value))
        else:
            stiffness = value if parameter == "stops.stiffness" else value * rig.isolator.stiffness
            damping = rig.right.damping
            if parameter == "stiffness_ratio":  # the relaxation time is kept
                damping *= stiffness / rig.right.stiffness
            bumper = rig.right.replace(stiffness=stiffness, damping=damping)
            rig = rig.replace(right=bumper, left=bumper)
        state = data["section"].isel(point=i)
        moved = vi.simulate(vi.Rig(rig, excitation), 1, state, 0)["final_state"]
        np.testing.assert_allclose(moved[:2], state[:2], rtol=0, atol=1e-9)


@pytest.mark.parametrize("frequency", [0.7, 3.0])
def test_over_the_gap_into_preload(frequency):
    """Where the gaps are negative both bumpers are pressed at once, which is another flow."""
    case = vi.laboratory.case("B1-G1-A3")
    shaken = vi.Harmonic(case.amplitude, frequency)

    def rig(gap: float) -> vi.Oscillator:
        bumper = vi.Bumper("100 kN/m", "10 kN s/m", gap)
        return case.oscillator.replace(right=bumper, left=bumper)

    ways = [
        vi.branch(vi.Rig(rig(gap), shaken), span=("-1 mm", "1 mm"), parameter="gap")
        for gap in (1e-3, -1e-3)
    ]
    for data in ways:
        assert data.attrs["ended_low"] == "the range ends at -1 mm"
        assert data.attrs["ended_high"] == "the range ends at 1 mm"
        assert np.abs(np.diff(data["displacement_max"])).max() < 1e-4
        for i in (0, -1):
            last = data.isel(point=i)
            phase = float(last["section"].sel(component="phase"))
            settled = vi.steady(vi.Rig(rig(float(last["gap"])), shaken.replace(phase=phase)))
            state = settled["final_state"].values
            np.testing.assert_allclose(last["section"].values[:4], state[:4], atol=1e-12)
            # The samples of the record come close to the exact extremes.
            most = float(settled["displacement"].max())
            assert most <= float(last["displacement_max"]) <= 1.0002 * most
    for i in (0, -1):
        one, other = (data.isel(point=i) for data in ways)
        for name in ("displacement_max", "displacement_min", "acceleration_max"):
            assert float(one[name]) == pytest.approx(float(other[name]), rel=1e-9)


def test_over_the_restitution_of_a_wall():
    case = vi.laboratory.case("B1-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)

    def rig(restitution: float) -> vi.Oscillator:
        return case.oscillator.replace(right=vi.RigidStop(restitution, "2 mm"), left=None)

    data = vi.branch(vi.Rig(rig(0.6), shaken), span=(0.5, 0.95), parameter="restitution")
    assert data.attrs["parameter"] == "stops.restitution"
    ends = {data.attrs["ended_low"], data.attrs["ended_high"]}
    assert ends == {"the range ends at 0.5", "the range ends at 0.95"}
    for i in np.linspace(0, data.sizes["point"] - 1, 6).astype(int):
        here = data.isel(point=i)
        alone = vi.orbit(vi.Rig(rig(float(here["stops.restitution"])), shaken), here["section"])
        assert float(alone["displacement_min"]) == pytest.approx(
            float(here["displacement_min"]), rel=1e-9
        )
        np.testing.assert_allclose(alone["multiplier_real"], here["multiplier_real"], atol=1e-6)


@pytest.mark.parametrize(
    ("parameter", "low", "high"),
    [*sample([("elastic_stiffness", 2.0, 6.0)], []), ("stops.right.restitution", 0.4, 0.9)],
)
def test_parameters_that_do_not_count_in_proportion(parameter, low, high):
    """Each orbit belongs to the rig that the parameter says, and closes there."""
    stop = vi.PowerBumper(200.0, 0.3, 1.5, restitution=0.6)
    rig = vi.Oscillator(1.0, vi.BoucWenIsolator(4.0, 1.0, 0.2, 0.1), stop, stop.replace(gap=0.5))
    shaken = vi.Harmonic(0.5, 1.1 / (2 * np.pi))
    data = vi.branch(vi.Rig(rig, shaken), span=(low, high), parameter=parameter)
    values = data[parameter].values
    assert values.min() <= low + 1e-9
    assert values.max() >= high - 1e-9
    for k in np.linspace(0, len(values) - 1, 5).astype(int):
        value = float(values[k])
        if parameter == "elastic_stiffness":
            here = rig.replace(isolator=rig.isolator.replace(elastic_stiffness=value))
        else:
            here = rig.replace(right=stop.replace(restitution=value))
        start = data["section"].isel(point=int(k))
        cycles = int(np.ravel(data["period"])[min(int(k), data["period"].size - 1)])
        after = vi.simulate(vi.Rig(here, shaken), cycles, start, samples=0)["final_state"]
        np.testing.assert_allclose(after[:2], start[:2], atol=1e-9)
