"""A forced oscillator between elastic stops: its limits in closed form and by another integration.

x″ + 2ζx′ + x = a cos Ωt with elastic stops of stiffness 10 at ±1, ζ = 0.05, a = 0.2. In free
flight it grazes where Ω⁴ − (2 − 4ζ²) Ω² + 1 − a² = 0; the upper fold, Ω = 1.5339796, was found
with a continuation of the unsmoothed problem by an independent integrator.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.response.resonance import features

TURN = 2.0 * math.pi


@cache
def rig() -> vi.Oscillator:
    stop = vi.Bumper(10.0, 0.0, 1.0)
    return vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop, stop)


@cache
def followed(phase: float = 0.0):
    return vi.branch(rig(), vi.Harmonic(0.2, 2.0 / TURN, phase), low=1.0 / TURN, high=2.5 / TURN)


def at(kind: str, data=None) -> list[float]:
    data = followed() if data is None else data
    return sorted(TURN * data["bifurcation_value"].values[data["bifurcation_kind"].values == kind])


def test_upper_fold():
    assert max(at("fold")) == pytest.approx(1.5339796, abs=1e-7)


@pytest.mark.parametrize("phase", [0.0, 1.0, 2.5])
def test_grazing_to_rounding(phase):
    exact = math.sqrt(max(np.roots([1.0, -(2.0 - 4.0 * 0.05**2), 1.0 - 0.2**2]).real))
    assert exact == pytest.approx(1.08086874, abs=1e-8)
    found = at("grazing", followed(phase))
    assert min(abs(value - exact) for value in found) < 1e-12


def test_free_flight_multipliers_on_the_branch():
    """exp((−ζ ± i√(1 − ζ²)) T), to 1e-13, wherever nothing is touched."""
    data = followed()
    free = (data["impacts_right"] + data["impacts_left"]).values == 0
    assert free.sum() > 10
    for i in np.flatnonzero(free):
        period = 1.0 / float(data["frequency"][i])
        expected = np.exp(complex(-0.05, math.sqrt(1 - 0.05**2)) * period)
        found = data["multiplier_real"].values[i] + 1j * data["multiplier_imag"].values[i]
        assert min(abs(found - expected)) < 1e-13
        assert abs(found[:2]).max() == pytest.approx(abs(expected), rel=1e-13)


def test_between_the_limits_there_are_three_orbits():
    data = followed()
    frequency = data["frequency"].values * TURN
    for value in (1.1, 1.3, 1.5):
        crossings = np.flatnonzero((frequency[:-1] - value) * (frequency[1:] - value) < 0.0)
        stable = [int(data["stable"][i]) for i in crossings]
        assert sorted(stable) == [0, 1, 1]


def test_a_stepped_sweep_jumps_at_the_limits():
    grid = np.arange(1.0, 1.8, 0.002) / TURN
    jumps = features(vi.sweep(rig(), 0.2, grid)).jumps
    spans = {jump.direction: sorted(TURN * f for f in (jump.before, jump.after)) for jump in jumps}
    assert spans["forward"][0] < max(at("fold")) < spans["forward"][1]
    # Downwards the sweep falls off at the fold just beside the grazing.
    assert spans["backward"][0] < min(f for f in at("fold") if f > 1.05) < spans["backward"][1]
