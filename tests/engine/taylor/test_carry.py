"""The tangent flow of curved laws against differences of the flow itself, through all events."""

from __future__ import annotations

import numpy as np
import pytest

from engine.taylor.rigs import HYSTERETIC, ISOLATORS, SHAKEN, STOPS, between, followed, started
from vibroimpact.engine import lyapunov
from vibroimpact.engine.motion import ISOLATOR, LEFT_BUMPER, MODE, RIGHT_BUMPER, U, V
from vibroimpact.engine.observers.tangent import DISTURBANCE, MEMORY
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_rig

ORDER = [U, V, RIGHT_BUMPER, LEFT_BUMPER, ISOLATOR]
SIGNS = np.array([1.0, 1.0, 1.0, -1.0, 1.0])
STEP = 1e-5


def carried(rig, state, cycles, shaken=SHAKEN):
    """Unit disturbances behind so many cycles, the damping's integral, and the end."""
    rows, damping, end = np.empty((DISTURBANCE, DISTURBANCE)), np.empty(1), state.copy()
    outcome = lyapunov.monodromy(
        engine_rig(Rig(rig, shaken)), shaken.amplitude, shaken.frequency, shaken.phase, end, cycles,
        10_000, rows, damping,
    )  # fmt: skip
    assert outcome == 0
    return rows, float(damping[0]), end


@pytest.mark.parametrize("stop", [name for name in STOPS if name != "pounding"])
@pytest.mark.parametrize("isolator", ISOLATORS)
def test_derivative_agrees_with_central_differences(isolator: str, stop: str) -> None:
    """Over a cycle with contacts, turns and yields; in flight at its start."""
    rig = between(isolator, stop)
    start = started(rig, 0.1, 0.9)
    start[ISOLATOR] = 0.05 if isolator in HYSTERETIC else 0.0
    rows, _, end = carried(rig, start, 1)
    np.testing.assert_allclose(end, followed(rig, SHAKEN, 1, start), atol=1e-13)
    components = [(U, 0), (V, 1)] + [(ISOLATOR, MEMORY)] * (isolator in HYSTERETIC)
    for at, row in components:
        differences = []
        for size in (STEP, 0.5 * STEP):
            ends = []
            for step in (size, -size):
                moved = start.copy()
                moved[at] += step
                ends.append(followed(rig, SHAKEN, 1, moved))
                assert ends[-1][MODE] == end[MODE]
            differences.append(SIGNS * (ends[0] - ends[1])[ORDER] / (2.0 * size))
        difference = (4.0 * differences[1] - differences[0]) / 3.0
        scale = max(np.abs(rows[row]).max(), 1e-3)
        assert np.abs(difference - rows[row]).max() < 1e-6 * scale


@pytest.mark.parametrize("isolator", ["linear", "duffing", "drag", "exponential"])
def test_without_events_volume_shrinks_by_the_divergence(isolator: str) -> None:
    """det = exp(−∫ damping) of displacement, velocity and what is remembered."""
    rig = between(isolator, None)
    rows, damping, _ = carried(rig, started(rig, 0.1, 0.9), 1)
    own = [0, 1] + [MEMORY] * (isolator in HYSTERETIC)
    assert np.linalg.det(rows[np.ix_(own, own)]) == pytest.approx(np.exp(-damping), rel=1e-9)
