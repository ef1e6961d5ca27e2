"""From one event to the next: flight, then contact, then flight."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.contact import contact
from vibroimpact.engine.linear.evaluate import relaxed
from vibroimpact.engine.linear.flight import flight
from vibroimpact.engine.linear.tables import SIZE, TABLES, VALID_FROM, H
from vibroimpact.engine.motion import DETACHED, FLIGHT, LIMIT, RIGHT, Motion, coordinates

WORK_LIMIT = 3e7
"""Table steps that one forcing cycle may take, about a second of computing."""


@kernel
def advance(plan: Vector, motion: Motion, limit: float) -> tuple[int, float, Motion]:
    """Go on to the next contact or detachment, or for the time `limit` if that comes first.

    Returns
    -------
    event, t, motion
        What ended the stretch (see `motion`), its length (s), and the motion behind it.
    """
    mode, fresh, u, v, right, left, age, clock = motion
    s, c = clock
    if mode == FLIGHT:
        event, t, u, v, s, c, right, left = flight(plan, u, v, s, c, right, left, fresh, limit, age)
        if event == LIMIT:
            return event, t, Motion(mode, 0, u, v, right, left, age + t, (s, c))
        return event, t, Motion(event, 1, u, v, right, left, 0.0, (s, c))
    sign, x, v, s, c = coordinates(motion)
    event, t, x, v, s, c = contact(plan, mode, x, v, s, c, fresh == 1, limit, age)
    if mode == RIGHT:
        right = x
        left = relaxed(left, plan[par.BUMPER + par.WIDTH + par.RATE], t)
    else:
        left = x
        right = relaxed(right, plan[par.BUMPER + par.RATE], t)
    gap = plan[par.BUMPER + par.WIDTH * (mode - 1) + par.GAP]
    u, v, s, c = sign * (gap + x), sign * v, sign * s, sign * c
    if event == DETACHED:
        return event, t, Motion(FLIGHT, mode, u, v, right, left, 0.0, (s, c))
    return event, t, Motion(mode, 0, u, v, right, left, age + t, (s, c))


@kernel
def too_much_work(plan: Vector, period: float) -> bool:
    """Whether one cycle could take more than WORK_LIMIT table steps."""
    for mode in range(3):
        early = TABLES + SIZE * mode
        late = early + 3 * SIZE
        if plan[early + H] > 0.0:
            steps = min(period, plan[late + VALID_FROM]) / plan[early + H]
            if plan[late + VALID_FROM] < period:
                steps += period / plan[late + H]
            if not steps < WORK_LIMIT:
                return True
    return False
