"""From one event to the next, for any stops: rigid ones, and bumpers that overlap.

Each stop that is touched may let go, each that is free may be touched: every one is asked in
turn, and only for the time until the earliest of those asked before.
"""

from __future__ import annotations

import math

from vibroimpact.engine.event import CONTACT, LIMIT, event_of, kind_of, stop_of
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.advance import fly, press
from vibroimpact.engine.linear.flight import flight
from vibroimpact.engine.linear.layout import Row
from vibroimpact.engine.linear.table_search import BELOW, WITHIN, Bounds
from vibroimpact.engine.motion import BOTH, RELEASED, Ended, Motion, facing, main_stop
from vibroimpact.engine.state import FLIGHT, SETTLING
from vibroimpact.engine.stops.kelvin_voigt import rate_of
from vibroimpact.engine.stops.places import overlapping, place_at, total_gap
from vibroimpact.engine.stops.rigid import resting, rigid
from vibroimpact.engine.stops.rigid_events import impact, rest, settle


@kernel
def approach(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Pressed on one side, free of the other until that is touched as well."""
    mode, fresh, _, v, faces, z, age, clock = motion
    stop = main_stop(mode)
    other = 1 - stop
    sign, there = facing(stop), 1 << other
    s, c = clock
    # Seen from the pressed stop, the other one lies below.
    way, t, row, _, free = flight(
        plan,
        mode,
        Row(faces[stop], sign * v, sign * s, sign * c),
        Bounds(math.inf, -total_gap(plan), 0.0, faces[other], math.inf, rate_of(plan, other)),
        BELOW if fresh & BOTH == there else WITHIN,
        fresh & RELEASED != 0,
        limit,
        age,
    )
    x, v, s, c = row
    v, clock = sign * v, (sign * s, sign * c)
    faces = (x, free) if stop == 0 else (free, x)
    u = place_at(plan, stop, x)
    if way == WITHIN:
        return LIMIT, t, v, Motion(mode, 0, u, v, faces, z, age + t, clock)
    return event_of(CONTACT, other), t, v, Motion(BOTH, there, u, v, faces, z, 0.0, clock)


@kernel
def advance_any(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next event, or for the time `limit` if that comes first."""
    mode = motion.mode
    if motion.fresh & SETTLING:
        return settle(plan, motion, limit)
    if resting(plan, mode):
        return rest(plan, motion, limit)
    if mode == FLIGHT:
        event, t, arrival, after = fly(plan, motion, limit)
    else:
        event, t, arrival, after = LIMIT, limit, motion.v, motion
        for stop in range(2):
            if mode >> stop & 1:
                one = press(plan, motion, stop, t)
                if one[0] != LIMIT or event == LIMIT:
                    event, t, arrival, after = one
        if mode != BOTH and overlapping(plan):
            one = approach(plan, motion, t)
            if one[0] != LIMIT:
                event, t, arrival, after = one
    if kind_of(event) == CONTACT and rigid(plan, stop_of(event)):
        return impact(plan, stop_of(event), t, arrival, after)
    return event, t, arrival, after
