"""A mass with clearance on both sides: J. P. Den Hartog and S. J. Mikina, Forced vibrations with
non-linear spring constants, Trans. ASME 54 (1932) 157-164.

The mass M is free within ±G, and held by a spring k beyond; F cos ωt acts on it. No table of the
published curves was found, so what they were drawn from is derived, in
`comparisons/impact_oscillators.py`.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from literature.comparisons.impact_oscillators import (
    DEAD_ZONE,
    FORCE,
    MASS,
    RATE,
    STIFFNESS,
    dead_zone_amplitude,
    dead_zone_orbit,
    dead_zone_shaken,
)

RATIOS = [0.35, 0.5, 0.6, 0.7, 0.8, 0.9]


@pytest.mark.parametrize("ratio", RATIOS)
def test_the_resonance_curve(ratio: float) -> None:
    expected = dead_zone_amplitude(ratio)
    orbit = dead_zone_orbit(ratio)
    assert float(orbit["displacement_max"]) == pytest.approx(expected, rel=1e-10)
    assert float(orbit["displacement_min"]) == pytest.approx(-expected, rel=1e-10)
    assert sorted(orbit.attrs["contacts"]) == ["L", "R"]
    np.testing.assert_allclose(orbit["final_state"].values[:2], [expected, 0.0], atol=1e-9)


def test_it_is_followed_as_a_branch() -> None:
    ends = [ratio * RATE / math.tau for ratio in (0.6, 0.9)]
    start = vi.State(dead_zone_amplitude(0.75), 0.0)
    data = vi.branch(
        vi.Rig(DEAD_ZONE, dead_zone_shaken(0.75)), start, vary={"frequency": (ends[0], ends[1])}
    )
    frequency = data["frequency"].values
    assert (frequency.min(), frequency.max()) == pytest.approx(tuple(ends))
    expected = [dead_zone_amplitude(f * math.tau / RATE) for f in frequency]
    np.testing.assert_allclose(data["displacement_max"], expected, rtol=1e-8)


def test_without_clearance_it_is_a_linear_spring() -> None:
    """F/(k - M ω²), the curve for k₁ = k₂."""
    closed = vi.Bumper(STIFFNESS, 0.0, 0.0)
    rig = vi.Oscillator(MASS, vi.Isolator(0.0, 0.0), closed, closed)
    for ratio in (0.4, 0.7, 1.4):
        expected = FORCE / (STIFFNESS - MASS * (ratio * RATE) ** 2)
        data = vi.simulate(vi.Rig(rig, dead_zone_shaken(ratio)), 3, vi.State(expected), samples=32)
        exact = expected * np.cos(math.tau * data["cycle"].values)
        np.testing.assert_allclose(data["displacement"], exact, atol=1e-11)
