"""The derivative of a state after a cycle by the state before: by the tangent, by differences."""

from __future__ import annotations

from typing import Any

import numpy as np

import vibroimpact as vi
from vibroimpact.engine import lyapunov
from vibroimpact.engine.state import FIRST
from vibroimpact.response.engine_system import engine_rig


def both_derivatives(
    rig: vi.Rig, start: Any, parts: int, count: int, by: float
) -> tuple[Any, Any, float]:
    """Those of the first `count` of `parts`, by differences of `by`; and the damping."""
    forcing = rig.periodic

    def moved(vector: Any) -> tuple[Any, Any, float]:
        q, damping, vector = np.zeros((parts, parts)), np.zeros(1), vector.copy()
        outcome = lyapunov.monodromy(
            engine_rig(rig), forcing.amplitude, forcing.frequency, forcing.phase, vector, 1, 1000,
            q, damping,
        )  # fmt: skip
        assert outcome == 0
        return q[:count, :count], vector[FIRST : FIRST + count], float(damping[0])

    exact, _, damping = moved(start)
    rows = []
    for i in range(count):
        ends = []
        for sign in (1.0, -1.0):
            near = start.copy()
            near[FIRST + i] += sign * by
            ends.append(moved(near)[1])
        rows.append((ends[0] - ends[1]) / (2.0 * by))
    return exact, np.array(rows), damping
