"""A stop with a restitution that is pressed from rest: there is no impact to lose by."""

import math

import numpy as np
import pytest

import vibroimpact as vi


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("relation", ["exact", "flores"])
def test_pressed_from_rest_it_is_elastic(side: int, relation: str) -> None:
    stiffness, load = 50.0, 2.0
    stop = vi.PowerBumper(stiffness, 0.0, 1.0, restitution=0.5, relation=relation)
    stops = {"right": stop} if side == 1 else {"left": stop}
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), **stops, force=side * load)
    motion = vi.simulate(
        vi.Rig(rig, vi.Harmonic(1e-9, 4.0)), 3, start=vi.State(0.0, 0.0), samples=16
    )
    assert motion.attrs["message"].startswith("done")
    t = motion.time.values
    expected = load / (stiffness + 1.0) * (1.0 - np.cos(math.sqrt(stiffness + 1.0) * t))
    np.testing.assert_allclose(side * motion.displacement, expected, atol=1e-8)


def test_what_it_returns_afterwards_is_as_asked() -> None:
    """Pressed from rest, thrown off, and come back: now it is an impact."""
    stop = vi.PowerBumper(1e6, 0.0, 1.0, restitution=0.5)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), stop)
    motion = vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 0.4, math.pi)), 2, samples=8)
    came, went = (motion.event_velocity.values[i] for i in (2, 3))
    assert motion.event_contact.values[2] == 1
    assert -went / came == pytest.approx(0.5, abs=0.01)
