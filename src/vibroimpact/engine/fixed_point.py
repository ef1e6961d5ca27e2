"""A fixed point of the stroboscopic map nearby, and whether it attracts: Newton's last steps.

The derivative is that of small disturbances, one for each part of the state that outlives a cycle:
where these are two, it takes three cycles, and each further step one. No law is differentiated.
"""

from __future__ import annotations

import math

from vibroimpact.engine import flow
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.matrix import radius, solve
from vibroimpact.engine.state import FIRST, parts_buffer, put, square_buffer, state_buffer

DYING = 0.999
"""A disturbance that dies out more slowly in a cycle may be one that lives on: it is followed."""

_DISTURBED = 1e-6
"""Of the motion's size."""
_STEPS = 6
_FAR = 1e-3
"""Of the motion's size: a longer step does not lead to a fixed point nearby."""
_FINE = 1e-10
"""Of the motion's size: behind a step as short as this nothing but rounding is left."""
_ROUGH = 1e-11
"""Of the motion's size: where rounding keeps a step from becoming shorter, this will do."""


@kernel
def newton_iterate(
    plan: Vector,
    state: Vector,
    s: float,
    c: float,
    period: float,
    units: Vector,
    tolerance: float,
    scale: float,
    max_events: int,
) -> tuple[int, bool]:
    """Take Newton's last steps to a fixed point nearby, if disturbances of it die out.

    `state` is carried to the fixed point; where none is found it is of no use.

    Returns
    -------
    cycles, has_converged
        The derivative is that of small disturbances, and is kept from step to step.
    """
    parts = flow.parts(plan)
    matrix, other, image = square_buffer(), square_buffer(), parts_buffer()
    after, begun = state_buffer(), state_buffer()
    put(plan, state, after)
    if flow.cycle(plan, after, s, c, period, max_events) > max_events:
        return 1, False
    cycles = 1
    for i in range(parts):
        image[i] = after[FIRST + i]
    for j in range(parts):
        put(plan, state, begun)
        by = flow.disturb(plan, begun, j, _DISTURBED * scale / units[j], period)
        if by != 0.0:
            cycles += 1
            if flow.cycle(plan, begun, s, c, period, max_events) > max_events:
                return cycles, False
        for i in range(parts):
            grown = (begun[FIRST + i] - image[i]) / by if by != 0.0 else 0.0
            matrix[parts * i + j] = grown * units[i] / units[j]
    step = parts_buffer()
    last, change = math.inf, math.inf
    has_converged = False
    for _ in range(_STEPS):
        for i in range(parts):
            step[i] = units[i] * (image[i] - state[FIRST + i])
            for j in range(parts):
                other[parts * i + j] = (1.0 if i == j else 0.0) - matrix[parts * i + j]
        if not solve(other, step, parts):
            return cycles, False
        last, change = change, 0.0
        for i in range(parts):
            change = max(change, abs(step[i]))
        if change > _FAR * scale:
            return cycles, False
        if not change < 0.5 * last:  # nothing is left but rounding
            has_converged = last <= max(tolerance, _ROUGH) * scale
            break
        for i in range(parts):
            state[FIRST + i] += step[i] / units[i]
        flow.place(plan, state)
        has_converged = change <= _FINE * scale
        if has_converged:
            break
        put(plan, state, after)
        cycles += 1
        if flow.cycle(plan, after, s, c, period, max_events) > max_events:
            return cycles, False
        for i in range(parts):
            image[i] = after[FIRST + i]
    return cycles, has_converged and radius(matrix, other, parts) < DYING
