"""From one event to the next, between bumpers that cannot be touched at once."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.contact import contact
from vibroimpact.engine.linear.evaluate import relaxed
from vibroimpact.engine.linear.flight import flight
from vibroimpact.engine.linear.layout import LATE_TABLES, SIZE, SLOTS, TABLES, VALID_FROM, H
from vibroimpact.engine.linear.table_search import WITHIN, Bounds
from vibroimpact.engine.motion import (
    BOTH,
    DETACHED,
    FLIGHT,
    LEFT,
    LIMIT,
    RELEASED,
    RIGHT,
    SEEN_LEFT,
    Motion,
    Row,
    coordinates,
)

WORK_LIMIT = 3e7
"""Table steps that one forcing cycle may take, about a second of computing."""

Ended = tuple[int, float, float, Motion]
"""event, t, arrival, motion: what ended a stretch (see `motion`), its length (s), the velocity
just before, and the motion just behind."""


@inlined
def bumpers(plan: Vector) -> tuple[float, float, float, float]:
    """Gaps (m) and relaxation rates (1/s) of both sides."""
    left = par.BUMPER + par.WIDTH
    return (
        plan[par.BUMPER + par.GAP],
        plan[left + par.GAP],
        plan[par.BUMPER + par.RATE],
        plan[left + par.RATE],
    )


@inlined
def fly(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Free of both stops until one of them is touched."""
    _, fresh, u, v, right, left, z, age, clock = motion
    gap_r, gap_l, rate_r, rate_l = bumpers(plan)
    s, c = clock
    way, t, row, right, left = flight(
        plan,
        FLIGHT,
        Row(u, v, s, c),
        Bounds(gap_r, -gap_l, right, left, rate_r, rate_l),
        fresh & BOTH,
        fresh & RELEASED != 0,
        limit,
        age,
    )
    u, v, s, c = row
    if way == WITHIN:
        return LIMIT, t, v, Motion(FLIGHT, 0, u, v, right, left, z, age + t, (s, c))
    return way, t, v, Motion(way, way, u, v, right, left, z, 0.0, (s, c))


@inlined
def press(plan: Vector, motion: Motion, side: int, limit: float) -> Ended:
    """Pressed at least on this side until its bumper lets go."""
    mode, fresh, u, v, right, left, z, age, clock = motion
    gap_r, gap_l, rate_r, rate_l = bumpers(plan)
    sign, row = coordinates(motion)
    slot = mode
    if mode == BOTH and side == LEFT:
        slot, sign, row = SEEN_LEFT, -1.0, Row(left, -v, -clock[0], -clock[1])
    event, t, row = contact(plan, slot, side, row, fresh == side, limit, age)
    x, v, s, c = row
    if side == RIGHT:
        right = x
        left = -x - (gap_r + gap_l) if mode == BOTH else relaxed(left, rate_l, t)
        u = gap_r + x
    else:
        left = x
        right = -x - (gap_r + gap_l) if mode == BOTH else relaxed(right, rate_r, t)
        u = -(gap_l + x)
    v, clock = sign * v, (sign * s, sign * c)
    if event == DETACHED:
        return event, t, v, Motion(mode & ~side, side, u, v, right, left, z, 0.0, clock)
    return event, t, v, Motion(mode, 0, u, v, right, left, z, age + t, clock)


@inlined
def advance_apart(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next contact or detachment, or for the time `limit` if that comes first."""
    if motion.mode == FLIGHT:
        return fly(plan, motion, limit)
    return press(plan, motion, motion.mode, limit)


@kernel
def too_much_work(plan: Vector, period: float) -> bool:
    """Whether one cycle could take more than WORK_LIMIT table steps."""
    for slot in range(SLOTS):
        early = TABLES + SIZE * slot
        late = early + LATE_TABLES
        if plan[early + H] > 0.0:
            steps = min(period, plan[late + VALID_FROM]) / plan[early + H]
            if plan[late + VALID_FROM] < period:
                steps += period / plan[late + H]
            if not steps < WORK_LIMIT:
                return True
    return False
