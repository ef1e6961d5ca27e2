"""Going ahead to a steady motion: sooner there, and nowhere else."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import vibroimpact as vi
from samples import sample
from vibroimpact.engine import extrapolation


def held(rig: vi.Oscillator, frequencies, **options):
    return vi.sweep(vi.Rig(rig, 1.0), frequencies, **options)


@pytest.mark.parametrize("code", ["B1-G4-A1", "B2-G1-A3", "B3-G2-A2", "B4-G1-A3"])
def test_it_comes_where_following_comes(code: str) -> None:
    """300 cycles later, far more than following needs, the motion is what it was."""
    case = vi.laboratory.case(code)
    frequencies = case.frequencies[:: sample(1, 4)]
    swept = vi.sweep(case, frequencies)
    for direction in swept.direction.values:
        for frequency in frequencies:
            one = swept.sel(direction=direction, frequency=frequency)
            if one["motion"] != "periodic":
                continue
            shaken = vi.Harmonic(case.amplitude, float(frequency))
            later = vi.simulate(vi.Rig(case.oscillator, shaken), 300, one["section"], samples=0)
            size = abs(one["section"].values[:2]).max()
            np.testing.assert_allclose(
                later["final_state"][:2], one["section"][:2], atol=1e-11 * size, rtol=0.0
            )


def test_it_takes_a_fraction_of_the_cycles() -> None:
    """Following alone takes 75 and 81 (docs/decisions/0014-settling.md)."""
    for code in ("B2-G1-A3", "B3-G2-A2"):
        case = vi.laboratory.case(code)
        swept = vi.sweep(case, case.frequencies)
        assert swept["cycles"].where(swept["period"] == 1).mean() < 18


def warned_orbit(rig: vi.Oscillator, shaken: vi.Harmonic):
    with pytest.warns(RuntimeWarning, match="is not the motion from rest"):
        return vi.orbit(vi.Rig(rig, shaken), period=1)


def test_what_does_not_attract_is_not_reached() -> None:
    """Two cycles are stable; the orbit of one, to which two secants lead as well, is not."""
    rig = vi.Oscillator(
        1.0, vi.Isolator(1.0, 0.054322474523786496), None, vi.Bumper(4.422971066385286, 0.0, 0.0)
    )
    swept = vi.sweep(
        vi.Rig(rig, 0.054322474523786496), np.linspace(0.32, 0.41, 10), max_cycles=1000
    )
    orbits = [
        warned_orbit(rig, vi.Harmonic(0.054322474523786496, float(f)))
        for f, n in zip(swept.frequency.values, swept["period"].values[0], strict=True)
        if n == 2
    ]
    assert len(orbits) > 0
    for one in orbits:
        assert not bool(one["stable"])


@given(
    st.floats(0.3, 3000.0),
    st.floats(0.02, 0.6),
    st.floats(0.0, 1.0),
    st.floats(0.0, 1.2),
    st.floats(0.1, 0.6),
)
def test_random_rigs_stay_where_they_are_said_to_be(
    stiffness: float, damping: float, relaxation: float, gap: float, frequency: float
) -> None:
    bumper = vi.Bumper(stiffness, relaxation * stiffness, gap)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, damping), bumper, bumper)
    one = held(rig, [frequency], directions="forward", max_cycles=200).isel(
        direction=0, frequency=0
    )
    if one["motion"] != "periodic":
        return
    shaken = vi.Harmonic(1.0, frequency)
    cycles = 40 * int(one["period"])
    later = vi.simulate(vi.Rig(rig, shaken), cycles, one["section"], samples=0)["final_state"]
    size = abs(one["section"].values[:2]).max()
    np.testing.assert_allclose(later[:2], one["section"][:2], atol=1e-10 * size, rtol=0.0)


def test_two_secants_tell_an_affine_map() -> None:
    rng = np.random.default_rng(0)
    matrix = np.array([[0.3, -0.7], [0.6, 0.5]])
    goal = rng.normal(size=2)
    buffer = np.zeros(extrapolation.ROOM)
    units = np.ones(2)
    state = rng.normal(size=2)
    for _ in range(4):
        image = goal + matrix @ (state - goal)
        before, after = (np.array([0.0, 0.0, *one]) for one in (state, image))
        extrapolation.remember_change(buffer, before, after, 2)
        state = image
        if _ >= 2:
            way, moved, contracts = extrapolation.guess(buffer, units, 2)
    assert contracts
    assert moved < 1e-13
    assert way == pytest.approx(abs(goal - state).max(), rel=1e-10)
    np.testing.assert_allclose(buffer[12:14], goal, rtol=1e-12)


def test_a_slow_approach_is_shortened_too() -> None:
    """Undamped but for a hundredth: following alone takes some thousand cycles."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02))
    one = held(rig, [5.0 / math.tau], directions="forward", max_cycles=3000)
    assert one["motion"].item() == "periodic"
    assert one["cycles"].item() < 500
