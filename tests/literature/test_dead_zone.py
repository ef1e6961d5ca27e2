"""A mass with clearance on both sides: J. P. Den Hartog and S. J. Mikina, Forced vibrations with
non-linear spring constants, Trans. ASME 54 (1932) 157-164.

The mass M is free within ±G, and held by a spring k beyond; F cos ωt acts on it. No table of the
published curves was found, so what they were drawn from is derived here. Without damping there is a
motion in phase with the force, even about t = 0 and odd about a quarter of the period T. With
p = √(k/M), it presses the right spring while |t| < t₁,

    u - G = B cos pt + Q cos ωt,    Q = F/(k - M ω²),    B cos pt₁ + Q cos ωt₁ = 0,

and flies through u(T/4) = 0 with

    u = -F/(M ω²) cos ωt + V (t - T/4).

u = G and one velocity at t₁ leave one equation for t₁. The amplitude is G + B + Q.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import vibroimpact as vi

MASS, STIFFNESS, GAP, FORCE = 2.0, 50.0, 0.1, 3.0
RATE = math.sqrt(STIFFNESS / MASS)
STOP = vi.Bumper(STIFFNESS, 0.0, GAP)
RIG = vi.Oscillator(MASS, vi.Isolator(0.0, 0.0), STOP, STOP)


def amplitude(ratio: float) -> float:
    """Of the motion in phase at ω = ratio · p; negative where it is against the force."""
    omega = ratio * RATE
    quarter = math.pi / (2 * omega)
    swing = FORCE / (STIFFNESS - MASS * omega**2)

    def parts(t: float) -> tuple[float, float]:
        return (
            -swing * math.cos(omega * t) / math.cos(RATE * t),
            (GAP + FORCE / (MASS * omega**2) * math.cos(omega * t)) / (t - quarter),
        )

    def gap_of_velocity(t: float) -> float:
        b, v = parts(t)
        inside = -b * RATE * math.sin(RATE * t) - swing * omega * math.sin(omega * t)
        return inside - (FORCE / (MASS * omega) * math.sin(omega * t) + v)

    # The contact lasts at most to the quarter, and longer than a quarter of the spring's period.
    low, high = math.pi / (2 * RATE) * (1 + 1e-9), quarter * (1 - 1e-9)
    t = brentq(gap_of_velocity, low, high, xtol=1e-15, rtol=1e-14)
    return GAP + parts(t)[0] + swing


RATIOS = [0.35, 0.5, 0.6, 0.7, 0.8, 0.9]


def shaken(ratio: float) -> vi.Harmonic:
    return vi.Harmonic(FORCE, ratio * RATE / math.tau, math.pi / 2, of="force")


@pytest.mark.parametrize("ratio", RATIOS)
def test_the_resonance_curve(ratio: float) -> None:
    expected = amplitude(ratio)
    found = vi.orbit(RIG, shaken(ratio), vi.State(expected, 0.0))
    assert float(found["displacement_max"]) == pytest.approx(expected, rel=1e-10)
    assert float(found["displacement_min"]) == pytest.approx(-expected, rel=1e-10)
    assert sorted(found.attrs["contacts"]) == ["L", "R"]
    np.testing.assert_allclose(found["final_state"].values[:2], [expected, 0.0], atol=1e-9)


def test_it_is_followed_as_a_branch() -> None:
    ends = [ratio * RATE / math.tau for ratio in (0.6, 0.9)]
    start = vi.State(amplitude(0.75), 0.0)
    data = vi.branch(RIG, shaken(0.75), start, low=ends[0], high=ends[1])
    frequency = data["frequency"].values
    assert (frequency.min(), frequency.max()) == pytest.approx(tuple(ends))
    expected = [amplitude(f * math.tau / RATE) for f in frequency]
    np.testing.assert_allclose(data["displacement_max"], expected, rtol=1e-8)


def test_without_clearance_it_is_a_linear_spring() -> None:
    """F/(k - M ω²), the curve for k₁ = k₂."""
    closed = vi.Bumper(STIFFNESS, 0.0, 0.0)
    rig = vi.Oscillator(MASS, vi.Isolator(0.0, 0.0), closed, closed)
    for ratio in (0.4, 0.7, 1.4):
        expected = FORCE / (STIFFNESS - MASS * (ratio * RATE) ** 2)
        data = vi.simulate(rig, shaken(ratio), 3, vi.State(expected), samples=32)
        exact = expected * np.cos(math.tau * data["cycle"].values)
        np.testing.assert_allclose(data["displacement"], exact, atol=1e-11)
