"""Leaps: motions that have become periodic, to 17 digits, and events that are hard to see."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from engine.taylor.rigs import followed, started
from vibroimpact.engine.motion import U, V

SHAKEN = vi.Harmonic(0.6, 1.2 / math.tau, -0.5 * math.pi)
BUMPER = vi.Bumper(20.0, 0.4, 1.0)

PERIODIC = {
    "polynomial": (
        vi.Oscillator(1.0, vi.PolynomialIsolator(1.0, 0.1, 0.5), BUMPER, BUMPER),
        0.6,
        (1.0490793441620474675, 0.60356688645627570732),
    ),
    "hunt-crossley": (
        vi.Oscillator(
            1.0,
            vi.Isolator(1.0, 0.1),
            vi.PowerBumper(40.0, 1.0, dissipation=0.3),
            vi.PowerBumper(40.0, 1.0, dissipation=0.3),
        ),
        0.6,
        (1.0889057034974773588, 0.85064394161649030314),
    ),
    "bouc-wen": (
        vi.Oscillator(
            1.0,
            vi.BoucWenIsolator(2.0, 0.5, 0.5, 0.1),
            vi.Bumper(20.0, 0.4, 0.7),
            vi.Bumper(20.0, 0.4, 0.7),
        ),
        0.8,
        (0.52913488120020345392, 0.79833857414172557207),
    ),
}
"""u and u̇ after 200 periods from rest, by `reference.any_law` with 25 digits."""


@pytest.mark.parametrize("name", PERIODIC)
def test_the_periodic_motion_is_met_to_rounding(name: str) -> None:
    rig, amplitude, exact = PERIODIC[name]
    end = followed(rig, SHAKEN.replace(amplitude=amplitude), 200, started(rig))
    np.testing.assert_allclose(end[[U, V]], exact, atol=2e-14)


@pytest.mark.parametrize("name", PERIODIC)
def test_a_hair_before_and_behind_a_grazing(name: str) -> None:
    """A stop that is touched by a hair, or missed by one: each is seen, however the leap lies."""
    rig, amplitude, _ = PERIODIC[name]
    free = rig.replace(right=None, left=None)
    shaken = SHAKEN.replace(amplitude=0.5 * amplitude)
    data = vi.simulate(vi.Rig(free, shaken), 1, vi.State(0.1, 0.5), 4096)
    most = float(data["displacement"].max())
    for distance in (1e-2, 1e-4, 1e-6):
        for sign in (-1.0, 1.0):
            gap = most * (1.0 + sign * distance)
            near = rig.replace(right=rig.right.replace(gap=gap), left=None)
            motion = vi.simulate(vi.Rig(near, shaken), 1, vi.State(0.1, 0.5), 1)
            assert bool(motion["event_time"].size) == (sign < 0.0), (distance, sign)
