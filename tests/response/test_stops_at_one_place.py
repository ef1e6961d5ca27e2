"""Two stops that begin at one place: the mass presses one of them at a time."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi

SHAKING = vi.Harmonic(amplitude=0.0847, frequency=0.0317, phase=1.32)


def stops(name: str, place: float) -> dict:
    """Two stops whose undeformed ends meet at this place."""
    soft, hard = vi.Bumper(0.00156, 0.00963, place), vi.Bumper(0.000494, 0.0, -place)
    return {
        "bumpers": {"right": soft, "left": hard},
        "a power law": {"right": vi.PowerBumper(0.00156, place, 1.5), "left": hard},
        "a wall": {"right": soft, "left": vi.RigidStop(0.8, -place)},
    }[name]


@pytest.mark.parametrize("name", ["bumpers", "a power law", "a wall"])
@pytest.mark.parametrize("place", [0.0, 0.3])
@pytest.mark.parametrize("velocity", [3.5, -3.5])
def test_a_start_within_rounding_of_both(name: str, place: float, velocity: float) -> None:
    """It is close to a start a little beside it, which touches one stop beyond doubt."""
    rig = vi.Rig(vi.Oscillator(0.124, vi.Isolator(0.00494, 7.5e-5), **stops(name, place)), SHAKING)
    side = 1.0 if name == "a wall" else np.sign(velocity)
    near = vi.simulate(rig, 3, vi.State(place + 1e-8 * side, velocity))
    assert near.sizes["event"] > 5
    outside = -1e-12 if name != "a wall" else 0.0
    for offset in (-2.3e-160, outside, 0.0, 1e-160, 1e-12):
        again = vi.simulate(rig, 3, vi.State(place + offset, velocity))
        np.testing.assert_allclose(again.displacement, near.displacement, rtol=0.0, atol=1e-5)
        assert abs(again.sizes["event"] - near.sizes["event"]) <= 2


@pytest.mark.parametrize("name", ["bumpers", "a power law", "a wall"])
def test_a_start_from_rest_between_them(name: str) -> None:
    rig = vi.Rig(vi.Oscillator(0.124, vi.Isolator(0.00494, 7.5e-5), **stops(name, 0.0)), SHAKING)
    motion = vi.simulate(rig, 3, vi.State(0.0))
    near = vi.simulate(rig, 3, vi.State(1e-8))
    assert np.abs(near.displacement).max() > 0.1
    np.testing.assert_allclose(motion.displacement, near.displacement, rtol=0.0, atol=1e-5)
