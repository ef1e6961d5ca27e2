"""Single orbits by Newton's method."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import vibroimpact as vi
from properties.strategies import Motion, examples, motions
from vibroimpact.stability.family import family
from vibroimpact.stability.fixed_points import Section, corrected, evaluated


def test_it_agrees_with_settling():
    case = vi.laboratory.case("B3-10mm-A3")
    for frequency in (0.5, 1.12, 2.0):
        shaken = vi.Harmonic(case.amplitude, frequency, 0.4)
        settled = vi.steady(case.oscillator, shaken)
        found = vi.orbit(case.oscillator, shaken, settled)
        for name in ("displacement_max", "acceleration_max", "energy_supplied"):
            assert float(found[name]) == pytest.approx(float(settled[name]), rel=1e-10)
        assert float(found["residual"]) <= 1e-12
        np.testing.assert_allclose(found["exponents"], settled["exponents"], atol=1e-9)
        moduli = np.hypot(found["multiplier_real"], found["multiplier_imag"]).values
        assert np.log(moduli[0]) * frequency == pytest.approx(
            float(settled["exponents"][0]), abs=1e-9
        )


def test_the_antisymmetric_orbit_of_the_non_regular_range_is_unstable():
    """B3-10mm-A3 through 1.02 to 1.10 Hz: there, with a multiplier above 1."""
    case = vi.laboratory.case("B3-10mm-A3")
    for frequency in (1.02, 1.06, 1.10):
        found = vi.orbit(
            case.oscillator, vi.Harmonic(case.amplitude, frequency), vi.State(1e-3, -0.02)
        )
        assert bool(found["antisymmetric"])
        assert int(found["stable"]) == 0
        assert 1.01 < float(found["multiplier_real"][0]) < 2.0
        assert found.attrs["contacts"] == "LR"
        # A motion beside it leaves.
        shaken = vi.Harmonic(case.amplitude, frequency)
        state = found["final_state"].values
        beside = vi.State(state[0] + 1e-7, state[1])
        left = vi.steady(case.oscillator, shaken, beside, window=50)
        assert float(left["displacement_excursion"]) > 1.005 * float(
            found["displacement_excursion"]
        )


def test_a_longer_period():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), vi.Bumper(29.0, 0.0, 1.26), None)
    omega = 0.81
    shaken = vi.Harmonic(0.7 * omega**2, omega / (2 * np.pi), np.pi)
    settled = vi.steady(rig, shaken)
    found = vi.orbit(rig, shaken, settled, period=5)
    assert int(found["period"]) == 5
    assert float(found["cycle"][-1]) == 5.0


@examples(60)
@given(motions(least_damping=0.02), st.floats(0.0, 6.28))
def test_monodromy_against_differences_of_the_map(motion: Motion, phase: float) -> None:
    """At whatever the state at the section: flight, contact, relaxing bumpers."""
    rig = motion.oscillator
    shaken = motion.excitation.replace(phase=phase)
    fam = family(rig, shaken, "frequency")
    settled = vi.simulate(rig, shaken, 20, samples=0)["final_state"].values
    size = max(abs(settled[0]), abs(settled[1]) / shaken.angular_frequency, 1e-12)
    scale = np.array([size, size * shaken.angular_frequency, size, size, shaken.frequency])
    section = Section(fam, 1, False, scale)
    point = np.append(settled[:4], shaken.frequency)
    mode = {1: 1.0, -1: 2.0}.get(int(settled[5]), 0.0)
    status, here, _ = evaluated(section, point, mode)
    assume(int(status) == 0)
    for component in (0, 1):
        slopes = []
        for step in (1e-5, 3e-6):
            ends = []
            for sign in (1.0, -1.0):
                beside = point.copy()
                beside[component] += sign * step * scale[component]
                if mode:  # the pressed bumper goes with the mass
                    beside[2 if mode == 1.0 else 3] += (
                        sign * step * scale[component] if component == 0 else 0.0
                    )
                status, other, image = evaluated(section, beside, mode)
                assume(int(status) == 0 and other.contacts == here.contacts)
                ends.append(image[:4])
            slopes.append((ends[0] - ends[1]) / (2.0 * step * scale[component]))
        weight = scale[component] / scale[:4]
        spread = np.max(np.abs(slopes[0] - slopes[1]) * weight)
        assume(spread < 1e-6)
        error = np.max(np.abs(slopes[1] - here.carried[component]) * weight)
        assert error < 1e-6 + 4.0 * spread


def test_the_half_cycle_map_squared_is_the_map():
    case = vi.laboratory.case("B2-G1-A3")
    fam = family(case.oscillator, vi.Harmonic(case.amplitude, 1.3, 0.3), "frequency")
    settled = vi.steady(case.oscillator, fam.excitation)["final_state"].values
    point = np.append(settled[:4], 1.3)
    scale = np.array([7.5e-3, 0.06, 7.5e-3, 7.5e-3, 1.0])
    halves = [corrected(Section(fam, 1, mirror, scale), point, 0.0) for mirror in (True, False)]
    assert all(int(status) == 0 for status, _ in halves)
    (_, half), (_, full) = halves
    np.testing.assert_allclose(half.monodromy, full.monodromy, atol=1e-9)
    np.testing.assert_allclose(
        np.sort(np.abs(half.multipliers)), np.sort(np.abs(full.multipliers)), atol=1e-9
    )
    assert half.contacts == full.contacts


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"period": 0}, "period"),
        ({"samples": True}, "samples"),
        ({"guess": "rest"}, "start"),
        ({"guess": vi.State(0.5, 3.0)}, "no orbit"),
    ],
)
def test_refused(wrong, told):
    case = vi.laboratory.case("B2-G1-A3")
    with pytest.raises(vi.InputError, match=told):
        vi.orbit(case.oscillator, vi.Harmonic(case.amplitude, 1.06, 0.0), **wrong)


def doubled():
    """A motion from rest that settles on two forcing cycles."""
    case = vi.laboratory.case("B3-10mm-A3")
    return case.oscillator, vi.Harmonic(case.amplitude, 1.1075)


def test_without_a_guess_it_is_the_motion_from_rest_with_its_period():
    rig, shaken = doubled()
    assert int(vi.steady(rig, shaken)["period"]) == 2
    assert int(vi.orbit(rig, shaken)["period"]) == 2
    data = vi.branch(rig, shaken, low=1.1, high=1.2)
    between = data["stable"].values >= 0  # in the doubling itself it is that of period 1
    assert set(data["period"].values[between]) == {2}


def test_another_orbit_than_the_motion_from_rest_is_told():
    rig, shaken = doubled()
    told = "of period 1 is not the motion from rest, which has period 2"
    with pytest.warns(RuntimeWarning, match=told):
        data = vi.orbit(rig, shaken, period=1)
    assert int(data["period"]) == 1
    with pytest.warns(RuntimeWarning, match="not the motion from rest, which does not settle"):
        vi.orbit(rig, shaken.replace(frequency=1.06), period=1)


def test_a_motion_from_rest_that_does_not_settle_has_no_period():
    rig, shaken = doubled()
    with pytest.raises(vi.InputError, match=r"from rest does not settle at 1\.06 Hz"):
        vi.orbit(rig, shaken.replace(frequency=1.06))
