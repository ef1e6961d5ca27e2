"""A fixed point of the stroboscopic map nearby, and whether it attracts: Newton's last steps.

The derivative is that of small disturbances, one for each part of the state that outlives a cycle:
where these are two, it takes three cycles, and each further step one. No law is differentiated.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event_loop import cycle
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.matrix import radius, solve
from vibroimpact.engine.memory import stack
from vibroimpact.engine.motion import LEFT, RIGHT, Clock, Motion
from vibroimpact.engine.observe import UNOBSERVED
from vibroimpact.engine.section_map import placed

PARTS = 5
"""Of a stroboscopic state: u, u̇, u_R, u_L, z."""

DYING = 0.999
"""A disturbance that dies out more slowly in a cycle may be one that lives on: it is followed."""

_FORGOTTEN = 9.0
"""What relaxes by more powers of e in a cycle is another's memory no more."""
_DISTURBED = 1e-6
"""Of the motion's size."""
_STEPS = 6
_FAR = 1e-3
"""Of the motion's size: a longer step does not lead to a fixed point nearby."""
_FINE = 1e-10
"""Of the motion's size: behind a step as short as this nothing but rounding is left."""
_ROUGH = 1e-11
"""Of the motion's size: where rounding keeps a step from becoming shorter, this will do."""

matrix_room = stack(PARTS * PARTS)
step_room = stack(PARTS)


@kernel
def parts_of(motion: Motion, i: int) -> float:
    """A part of the stroboscopic state."""
    if i == 0:
        return motion.u
    if i == 1:
        return motion.v
    if i == 2:
        return motion.right
    if i == 3:
        return motion.left
    return motion.z


@kernel
def close_in(
    plan: Vector,
    motion: Motion,
    clock: Clock,
    period: float,
    weight: float,
    tolerance: float,
    scale: float,
    max_events: int,
) -> tuple[int, bool, Motion]:
    """Take Newton's last steps to a fixed point nearby, if disturbances of it die out.

    Returns
    -------
    cycles, found, motion
        The derivative is that of small disturbances, and is kept from step to step.
    """
    matrix, other, image = matrix_room(), matrix_room(), step_room()
    events, after, _ = cycle(plan, motion, clock, period, max_events, UNOBSERVED)
    if events > max_events:
        return 1, False, motion
    cycles = 1
    for i in range(PARTS):
        image[i] = parts_of(after, i)
    for j in range(PARTS):
        unit = 1.0 if j == 1 else weight
        by = 0.0
        if counts(plan, motion, j, period):
            begun = disturbed(plan, motion, j, _DISTURBED * scale / unit)
            by = parts_of(begun, j) - parts_of(motion, j)
            if by != 0.0:
                events, after, _ = cycle(plan, begun, clock, period, max_events, UNOBSERVED)
                cycles += 1
                if events > max_events:
                    return cycles, False, motion
        for i in range(PARTS):
            grown = (parts_of(after, i) - image[i]) / by if by != 0.0 else 0.0
            matrix[PARTS * i + j] = grown * (1.0 if i == 1 else weight) / unit
    step = step_room()
    last, change = math.inf, math.inf
    found = False
    for _ in range(_STEPS):
        for i in range(PARTS):
            unit = 1.0 if i == 1 else weight
            step[i] = unit * (image[i] - parts_of(motion, i))
            for j in range(PARTS):
                other[PARTS * i + j] = (1.0 if i == j else 0.0) - matrix[PARTS * i + j]
        if not solve(other, step, PARTS):
            return cycles, False, motion
        last, change = change, 0.0
        for i in range(PARTS):
            change = max(change, abs(step[i]))
        if change > _FAR * scale:
            return cycles, False, motion
        if not change < 0.5 * last:  # nothing is left but rounding
            found = last <= max(tolerance, _ROUGH) * scale
            break
        motion = stepped(plan, motion, step, weight)
        found = change <= _FINE * scale
        if found:
            break
        events, after, _ = cycle(plan, motion, clock, period, max_events, UNOBSERVED)
        cycles += 1
        if events > max_events:
            return cycles, False, motion
        for i in range(PARTS):
            image[i] = parts_of(after, i)
    return cycles, found and radius(matrix, other, PARTS) < DYING, motion


@kernel
def disturbed(plan: Vector, motion: Motion, i: int, by: float) -> Motion:
    """A motion whose part i is another by so much, or by as little less, if only that can be."""
    mode, _, u, v, right, left, z, _, clock = motion
    if i == 0:
        u += by
    elif i == 1:
        v += by
    elif i == 2:
        right += by
    elif i == 3:
        left += by
    else:
        z += by if z <= 0.0 else -by
    return placed(plan, mode, u, v, right, left, z, clock)


@kernel
def counts(plan: Vector, motion: Motion, i: int, period: float) -> bool:
    """Whether a part of the state outlives a cycle by itself."""
    if i < 2:
        return True
    if i == 4:
        return bool(plan[par.HYSTERETIC] != 0.0)
    side = RIGHT if i == 2 else LEFT
    at = par.BUMPER + par.WIDTH * (side - 1)
    if motion.mode & side or plan[at + par.KIND] != par.KELVIN_VOIGT:
        return False
    return bool(plan[at + par.RATE] * period < _FORGOTTEN)


@kernel
def stepped(plan: Vector, motion: Motion, step: Vector, weight: float) -> Motion:
    """A motion that is a step farther, given in the size of velocities, as one that can be."""
    u, v = motion.u + step[0] / weight, motion.v + step[1]
    right, left = motion.right + step[2] / weight, motion.left + step[3] / weight
    return placed(plan, motion.mode, u, v, right, left, motion.z + step[4] / weight, motion.clock)
