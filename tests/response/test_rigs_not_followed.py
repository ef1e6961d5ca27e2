"""Rigs that the engine does not follow are refused in one line, by whatever they are given to."""

from __future__ import annotations

import pytest

import vibroimpact as vi

ISOLATOR = vi.Isolator(1.0, 0.1)
BUMPER = vi.Bumper(20.0, 0.4, 0.1)
RIGS = {
    r"^right: RigidStop\(.*\) cannot be followed": vi.RigidStop(0.5, 0.1),
    r"^right.gap: -100 mm is a preload": BUMPER.replace(gap=-0.1),
}
SHAKEN = vi.Harmonic(1.0, 0.2)


@pytest.mark.parametrize(("message", "stop"), RIGS.items())
@pytest.mark.parametrize(
    "ask",
    [
        lambda rig: vi.simulate(rig, SHAKEN, 1),
        lambda rig: vi.simulate(rig, SHAKEN, 1, vi.State(0.0)),
        lambda rig: vi.sweep(rig, 1.0, [0.2]),
        lambda rig: vi.steady(rig, SHAKEN),
        lambda rig: vi.orbit(rig, SHAKEN, vi.State()),
        lambda rig: vi.branch(rig, SHAKEN, low=0.1, high=0.3),
        lambda rig: vi.coexisting(rig, SHAKEN),
        lambda rig: vi.lyapunov_exponents([(rig, 1.0)], [0.2]),
        lambda rig: vi.resonance_diagram(rig, 1.0, 0.1, 0.3),
    ],
)
def test_the_engine_refuses(message: str, stop: vi.RigidStop, ask) -> None:
    with pytest.raises(vi.InputError, match=message) as caught:
        ask(vi.Oscillator(1.0, ISOLATOR, stop, BUMPER))
    assert "\n" not in str(caught.value)
