"""The first orbit of a branch."""

from __future__ import annotations

import pytest

import vibroimpact as vi


def test_an_orbit_has_its_least_period():
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.branch(
        vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 2.0)),
        vary={"frequency": (1.9, 2.1)},
        period=3,
    )
    assert set(data["period"].values) == {1}


def doubled():
    """A motion from rest that settles on two forcing cycles."""
    case = vi.laboratory.case("B3-10mm-A3")
    return case.oscillator, vi.Harmonic(case.amplitude, 1.1075)


def test_another_orbit_than_the_motion_from_rest_is_told():
    rig, shaken = doubled()
    message = "period 1 and is not the motion from rest, which has period 2"
    with pytest.warns(RuntimeWarning, match=message):
        data = vi.orbit(vi.Rig(rig, shaken), period=1)
    assert int(data["period"]) == 1
    with pytest.warns(RuntimeWarning, match="not the motion from rest, which does not settle"):
        vi.orbit(vi.Rig(rig, shaken.replace(frequency=1.06)), period=1)


def test_a_motion_from_rest_that_does_not_settle_has_no_period():
    rig, shaken = doubled()
    with pytest.raises(vi.InputError, match=r"from rest does not settle at 1\.06 Hz"):
        vi.orbit(vi.Rig(rig, shaken.replace(frequency=1.06)))


def test_without_a_guess_it_is_the_motion_from_rest_with_its_period():
    rig, shaken = doubled()
    assert int(vi.steady(vi.Rig(rig, shaken))["period"]) == 2
    assert int(vi.orbit(vi.Rig(rig, shaken))["period"]) == 2
    data = vi.branch(vi.Rig(rig, shaken), vary={"frequency": (1.1, 1.2)})
    between = data["stable"].values >= 0  # in the doubling itself it is that of period 1
    assert set(data["period"].values[between]) == {2}


@pytest.mark.parametrize("period", [1, 2, 3])
def test_orbits_are_found_in_chaos(period):
    """From one state of a motion that does not settle it would be a matter of luck."""
    rig, shaken = doubled()
    for frequency in (1.04, 1.05, 1.06, 1.075):
        for phase in (0.0, 1.0, 2.5, 4.0):
            here = shaken.replace(frequency=frequency, phase=phase)
            with pytest.warns(RuntimeWarning, match="which does not settle"):
                data = vi.orbit(vi.Rig(rig, here), period=period, samples=1)
            assert int(data["period"]) == period


def test_a_branch_begins_in_chaos():
    rig, shaken = doubled()
    for frequency in (1.05, 1.06):
        with pytest.warns(RuntimeWarning, match="which does not settle"):
            data = vi.branch(
                vi.Rig(rig, shaken.replace(frequency=frequency)),
                vary={"frequency": (1.04, 1.08)},
                period=2,
            )
        assert set(data["period"].values) <= {1, 2}
