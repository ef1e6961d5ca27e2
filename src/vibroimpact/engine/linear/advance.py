"""From one event to the next, between bumpers that cannot be touched at once."""

from __future__ import annotations

from vibroimpact.engine.event import CONTACT, DETACHMENT, LIMIT, event_of
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.contact import contact
from vibroimpact.engine.linear.flight import flight
from vibroimpact.engine.linear.layout import LATE_TABLES, SIZE, SLOTS, TABLES, VALID_FROM, H, Row
from vibroimpact.engine.linear.table_search import WITHIN, Bounds
from vibroimpact.engine.motion import (
    BOTH,
    RELEASED,
    SEEN_LEFT,
    Ended,
    Motion,
    coordinates,
    main_stop,
)
from vibroimpact.engine.state import FLIGHT
from vibroimpact.engine.stops.kelvin_voigt import rate_of, relaxed
from vibroimpact.engine.stops.places import gap_of, place_at, total_gap

WORK_LIMIT = 3e7
"""Table steps that one forcing cycle may take, about a second of computing."""


@inlined
def fly(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Free of both stops until one of them is touched."""
    _, fresh, u, v, faces, z, age, clock = motion
    s, c = clock
    right, left = faces
    way, t, row, right, left = flight(
        plan,
        FLIGHT,
        Row(u, v, s, c),
        Bounds(gap_of(plan, 0), -gap_of(plan, 1), right, left, rate_of(plan, 0), rate_of(plan, 1)),
        fresh & BOTH,
        fresh & RELEASED != 0,
        limit,
        age,
    )
    u, v, s, c = row
    faces = (right, left)
    if way == WITHIN:
        return LIMIT, t, v, Motion(FLIGHT, 0, u, v, faces, z, age + t, (s, c))
    event = event_of(CONTACT, main_stop(way))
    return event, t, v, Motion(way, way, u, v, faces, z, 0.0, (s, c))


@inlined
def press(plan: Vector, motion: Motion, stop: int, limit: float) -> Ended:
    """Pressed at least on this stop until its bumper lets go."""
    mode, fresh, u, v, faces, z, age, clock = motion
    sign, row = coordinates(motion)
    slot = mode
    if mode == BOTH and stop == 1:
        slot, sign, row = SEEN_LEFT, -1.0, Row(faces[1], -v, -clock[0], -clock[1])
    left, t, row = contact(plan, slot, stop, row, fresh == 1 << stop, limit, age)
    x, v, s, c = row
    other = 1 - stop
    free = -x - total_gap(plan) if mode == BOTH else relaxed(faces[other], rate_of(plan, other), t)
    faces = (x, free) if stop == 0 else (free, x)
    u = place_at(plan, stop, x)
    v, clock = sign * v, (sign * s, sign * c)
    if left:
        bit = 1 << stop
        after = Motion(mode & ~bit, bit, u, v, faces, z, 0.0, clock)
        return event_of(DETACHMENT, stop), t, v, after
    return LIMIT, t, v, Motion(mode, 0, u, v, faces, z, age + t, clock)


@inlined
def advance_bumpers(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next contact or detachment, or for the time `limit` if that comes first."""
    if motion.mode == FLIGHT:
        return fly(plan, motion, limit)
    return press(plan, motion, main_stop(motion.mode), limit)


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
