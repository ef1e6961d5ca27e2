"""A forced oscillator between elastic stops: its limits in closed form and by another integration.

x″ + 2ζx′ + x = a cos Ωt with elastic stops of stiffness 10 at ±1, ζ = 0.05, a = 0.2. In free
flight it grazes where Ω⁴ − (2 − 4ζ²) Ω² + 1 − a² = 0; its folds are in `comparisons/motions.py`.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from literature.comparisons.motions import STOPS, elastic_grazing, elastic_limits, elastic_stops
from vibroimpact.response.resonance import features

TURN = 2.0 * math.pi


@pytest.mark.parametrize("phase", [0.0, 1.0, 2.5])
def test_grazing_to_rounding(phase):
    exact = elastic_grazing()
    assert exact == pytest.approx(1.08086874, abs=1e-8)
    frequencies = elastic_limits("grazing", elastic_stops(phase))
    assert min(abs(value - exact) for value in frequencies) < 1e-12


def test_free_flight_multipliers_on_the_branch():
    """exp((−ζ ± i√(1 − ζ²)) T), to 1e-13, wherever nothing is touched."""
    data = elastic_stops()
    free = (data["impacts"].sel(stop="right") + data["impacts"].sel(stop="left")).values == 0
    assert free.sum() > 10
    for i in np.flatnonzero(free):
        period = 1.0 / float(data["frequency"][i])
        expected = np.exp(complex(-0.05, math.sqrt(1 - 0.05**2)) * period)
        multipliers = data["multiplier_real"].values[i] + 1j * data["multiplier_imag"].values[i]
        assert min(abs(multipliers - expected)) < 1e-13
        assert abs(multipliers[:2]).max() == pytest.approx(abs(expected), rel=1e-13)


def test_between_the_limits_there_are_three_orbits():
    data = elastic_stops()
    frequency = data["frequency"].values * TURN
    for value in (1.1, 1.3, 1.5):
        crossings = np.flatnonzero((frequency[:-1] - value) * (frequency[1:] - value) < 0.0)
        stable = [int(data["stable"][i]) for i in crossings]
        assert sorted(stable) == [0, 1, 1]


def test_a_stepped_sweep_jumps_at_the_limits():
    grid = np.arange(1.0, 1.8, 0.002) / TURN
    jumps = features(vi.sweep(vi.Rig(STOPS, 0.2), grid)).jumps
    spans = {jump.direction: sorted(TURN * f for f in (jump.before, jump.after)) for jump in jumps}
    assert spans["forward"][0] < max(elastic_limits("fold")) < spans["forward"][1]
    # Downwards the sweep falls off at the fold just beside the grazing.
    assert (
        spans["backward"][0]
        < min(f for f in elastic_limits("fold") if f > 1.05)
        < spans["backward"][1]
    )
