"""Free flight that is known without following it: only where nothing is touched on the way."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from samples import sample

MASS, PERIOD = 2.0, 0.7


def rig(damping_ratio: float, right: float, left: float, load: float = 0.0) -> vi.Oscillator:
    isolator = vi.Isolator.from_period(MASS, PERIOD, damping_ratio)
    stop = vi.Bumper(20.0 * isolator.stiffness, 3.0, right)
    other = vi.Bumper(9.0 * isolator.stiffness, 0.0, left)
    return vi.Oscillator(MASS, isolator, stop, other, load)


def held(one: vi.Oscillator, frequency: float, start: vi.State, phase: float = 0.0, **options):
    data = vi.sweep(vi.Rig(one, 1.0), [frequency], "forward", start=start, phase=phase, **options)
    return data.isel(direction=0, frequency=0)


@pytest.mark.parametrize("amplitude", [0.3, "2 mm", "1.5 N"])
@pytest.mark.parametrize("load", [0.0, 0.4])
def test_it_is_what_following_leads_to(amplitude: float | str, load: float) -> None:
    """Extremes and the state at any section, against a motion that is followed."""
    one = rig(0.1, 0.5, 0.5, load)
    for frequency in (0.4, 1.3, 3.0):
        data = vi.sweep(vi.Rig(one, amplitude), [frequency], "forward", phase=0.7)
        data = data.isel(direction=0, frequency=0)
        assert (data["cycles"], data["period"]) == (0, 1)
        shaken = vi.Harmonic(amplitude, frequency, 0.7)
        settled = vi.simulate(vi.Rig(one, shaken), 90, samples=0)
        motion = vi.simulate(vi.Rig(one, shaken), 1, settled, samples=512)
        for name in ("displacement", "acceleration"):
            size = float(np.ptp(motion[name].values))
            for end in ("max", "min"):
                exact, sampled = float(data[f"{name}_{end}"]), float(getattr(motion[name], end)())
                assert exact == pytest.approx(sampled, abs=1e-4 * size)
                assert (exact - sampled) * (1.0 if end == "max" else -1.0) >= -1e-12 * size
        ended = settled["final_state"].values[:2]
        scale = abs(ended).max()
        np.testing.assert_allclose(data["section"].values[:2], ended, rtol=0.0, atol=1e-12 * scale)


@settings(max_examples=sample(400, 40))
@given(
    st.floats(0.01, 1.5),
    st.floats(0.005, 0.03),
    st.floats(0.005, 0.03),
    st.floats(1.5, 4.0),
    st.floats(-0.02, 0.02),
    st.floats(-0.4, 0.4),
)
def test_whatever_the_start_it_is_the_motion_that_following_reaches(
    damping_ratio: float, right: float, left: float, ratio: float, u: float, v: float
) -> None:
    """`steady` follows every motion; what a hold knows at once must be the same one."""
    one = rig(damping_ratio, right, left)
    frequency = ratio / PERIOD
    start = vi.State(min(max(u, -left), right), v)
    data = held(one, frequency, start)
    if data["cycles"] > 0:
        return
    followed = vi.simulate(vi.Rig(one, vi.Harmonic(1.0, frequency)), 60, start, samples=1)
    assert followed.sizes["event"] == 0
    later = followed["final_state"].values[:2]
    lost = math.exp(-60 * _slowest(damping_ratio) * 2.0 * math.pi / ratio)
    size = max(abs(data["displacement_max"].item()), abs(u), abs(v))
    off = abs(data["section"].values[0] - later[0])
    assert off <= (1e-12 + 4.0 * lost) * size


def _slowest(ratio: float) -> float:
    """Decay rate over the natural frequency."""
    return ratio if ratio <= 1.0 else ratio - math.sqrt(ratio * ratio - 1.0)


def test_a_start_that_leads_into_a_stop_is_followed() -> None:
    """Large at first, the same free flight in the end, but only by following."""
    one = rig(0.1, 0.05, 0.05)
    near, far = (held(one, 3.0, vi.State(0.0, v)) for v in (0.0, 2.0))
    assert near["cycles"] == 0
    assert far["cycles"] > 0
    np.testing.assert_allclose(near["section"], far["section"], atol=1e-13)


def test_a_graze_is_followed() -> None:
    one = rig(0.1, 1.0, 1.0)
    reach = held(one, 1.3, vi.State(0.0, 0.0))["displacement_max"].item()
    steady = held(one, 1.3, vi.State(0.0, 0.0))["section"]
    for share, known in ((1.0 + 1e-6, True), (1.0 + 1e-12, False), (1.0 - 1e-6, False)):
        closer = rig(0.1, share * reach, 1.0)
        data = vi.sweep(vi.Rig(closer, 1.0), [1.3], "forward", start=steady).isel(
            direction=0, frequency=0
        )
        assert bool(data["cycles"] == 0) is known


def test_what_does_not_die_out_is_not_left_out() -> None:
    """Without damping a disturbance lives on, and a bumper without stiffness keeps its dent."""
    assert held(rig(0.0, 1.0, 1.0), 3.0, vi.State(0.01, 0.0))["cycles"] > 0
    slow = vi.Bumper(1.0, 1e9, 0.05)
    one = vi.Oscillator(MASS, vi.Isolator.from_period(MASS, PERIOD, 0.3), slow)
    dented = held(one, 3.0, vi.State(0.0, 0.0, deformation={"right": 0.02}))
    assert dented["cycles"] > 0
    assert held(one, 3.0, vi.State(0.0, 0.0))["cycles"] == 0


def test_the_left_tables_of_a_symmetric_rig_are_the_right_ones() -> None:
    """They are taken over; one rounding of a gap away each side makes its own."""
    case = vi.laboratory.case("B2-G1-A3")
    own = case.oscillator.left.replace(gap=math.nextafter(case.oscillator.left.gap, 1.0))
    for stop in (None, vi.RigidStop(0.7, case.oscillator.left.gap)):
        both = case.oscillator if stop is None else case.oscillator.replace(right=stop, left=stop)
        other = both.replace(left=own if stop is None else stop.replace(gap=own.gap))
        one, two = (
            vi.sweep(vi.Rig(r, case.amplitude), [1.5, 1.6, 1.7, 1.8]) for r in (both, other)
        )
        for name in ("displacement_max", "displacement_min", "peak_force"):
            np.testing.assert_allclose(one[name], two[name], rtol=1e-11)
