"""From one event to the next, for any stops: rigid ones, and bumpers that overlap.

Each stop that is touched may let go, each that is free may be touched: every one is asked in
turn, and only for the time until the earliest of those asked before.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import acceleration_of, isolator_force, springs
from vibroimpact.engine.forcing.dispatch import let_go, pace, turned, value
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.advance import Ended, bumpers, fly, press
from vibroimpact.engine.linear.evaluate import comes_back, relaxed
from vibroimpact.engine.linear.flight import flight
from vibroimpact.engine.linear.layout import STEEPEST
from vibroimpact.engine.linear.table_search import BELOW, WITHIN, Bounds
from vibroimpact.engine.linear.tables import overlapping, resting
from vibroimpact.engine.motion import (
    BOTH,
    DETACHED,
    FLIGHT,
    LEFT,
    LIMIT,
    RELEASED,
    RIGHT,
    SETTLING,
    Motion,
    Row,
)

_CHATTERED = 1e-6
"""A chatter is completed where its rest lasts for less than this share of the time in which the
force that presses the mass could change: the end of the geometric series is then right to 1e-12
of that time, and the rest that follows does not depend on it."""

_GRAIN = 2.0**-49
"""Returns no higher than this share of the displacement are lost in its rounding where each is cut
in two at its top: they would go on for ever."""


@kernel
def rigid(plan: Vector, side: int) -> bool:
    """Whether the stop on this side is a rigid one."""
    return bool(plan[par.BUMPER + par.WIDTH * (side - 1) + par.KIND] == par.RIGID)


@kernel
def impact(plan: Vector, event: int, t: float, arrival: float, motion: Motion) -> Ended:
    """What follows when the mass meets a rigid stop: u̇ → −e u̇, or rest."""
    mode, _, u, v, right, left, z, _, clock = motion
    side = event
    sign = 1.0 if side == RIGHT else -1.0
    at = par.BUMPER + par.WIDTH * (side - 1)
    restitution = plan[at + par.RESTITUTION]
    u = sign * plan[at + par.GAP]  # which from a pressed bumper's face is rounded
    v = -restitution * v
    bounced = Motion(mode & ~side, side, u, v, right, left, z, 0.0, clock)
    push = sign * acceleration_of(plan, bounced)  # towards the stop
    if not push > 0.0 or restitution >= 1.0:
        return event, t, arrival, bounced
    rest = chatter(v, restitution, push)
    # How fast the push may change meanwhile, and the rig's own rates.
    change = plan[par.DAMPING] * push + plan[STEEPEST]
    stiffness = springs(plan, bounced)
    change += stiffness * abs(v)
    rate = pace(plan) + math.sqrt(stiffness) + plan[par.DAMPING]
    for other in range(2):
        stop = par.BUMPER + par.WIDTH * other
        if plan[stop + par.KIND] == par.KELVIN_VOIGT and mode & (other + 1):
            rate += math.sqrt(plan[stop + par.BUMPER_STIFFNESS]) + plan[stop + par.BUMPER_DAMPING]
            change += plan[stop + par.BUMPER_STIFFNESS] * abs(v)
            change += plan[stop + par.BUMPER_DAMPING] * push
    size = abs(u) + abs(z)  # by which a yielding isolator's displacement is moved in its tables
    lost = plan[par.CURVED] != 0.0 and v * v < 2.0 * push * _GRAIN * size
    if (rest * rate > _CHATTERED or rest * change > _CHATTERED * push) and not lost:
        return event, t, arrival, bounced
    last = Motion(bounced.mode, side | SETTLING, u, v, right, left, z, 0.0, clock)
    return event, t, arrival, last


@kernel
def chatter(v: float, restitution: float, push: float) -> float:
    """How long impacts go on behind a return with v, pressed so hard: a geometric series (s)."""
    return 2.0 * abs(v) / (push * (1.0 - restitution))


@kernel
def settle(plan: Vector, motion: Motion, limit: float) -> Ended:
    """What is left of a chatter, and the rest to which it leads."""
    mode, fresh, u, v, right, left, z, _, clock = motion
    side = fresh & BOTH
    at = par.BUMPER + par.WIDTH * (side - 1)
    push = acceleration_of(plan, motion) * (1.0 if side == RIGHT else -1.0)
    t = min(chatter(v, plan[at + par.RESTITUTION], push), limit)
    gap_r, gap_l, rate_r, rate_l = bumpers(plan)
    right = right if mode & RIGHT else relaxed(right, rate_r, t)
    left = left if mode & LEFT else relaxed(left, rate_l, t)
    if side == RIGHT:
        u, right = gap_r, 0.0
    else:
        u, left = -gap_l, 0.0
    clock = turned(plan, clock[0], clock[1], t)
    return side, t, 0.0, Motion(mode | side, side, u, 0.0, right, left, z, 0.0, clock)


@kernel
def rest(plan: Vector, motion: Motion, limit: float) -> Ended:
    """At rest on a rigid stop until the force lets go of the mass, or a bumper reaches it."""
    mode, _, u, _, right, left, z, age, clock = motion
    side = RIGHT if mode & RIGHT and rigid(plan, RIGHT) else LEFT
    sign = 1.0 if side == RIGHT else -1.0
    gap_r, gap_l, rate_r, rate_l = bumpers(plan)
    at = par.BUMPER + par.WIDTH * (side - 1)
    other = BOTH - side
    facing = par.BUMPER + par.WIDTH * (other - 1)
    # It is pressed by `level` − A_t, as seen from this side.
    level = sign * (plan[par.LOAD] - isolator_force(plan, sign * plan[at + par.GAP], 0.0, z))
    if mode & other:
        level += plan[facing + par.BUMPER_STIFFNESS] * (left if side == RIGHT else right)
    s, c = clock
    pulled = sign * value(plan, s, c) > level  # let go at once, and not with zero acceleration
    event, t = LIMIT, limit
    free, s, c = let_go(plan, sign, level, s, c, limit)
    if free < math.inf:
        event, t = DETACHED, free
    if overlapping(plan) and not mode & other and plan[facing + par.KIND] != par.ABSENT:
        # The free bumper comes back to where the mass rests.
        deformation = left if side == RIGHT else right
        rate = rate_l if side == RIGHT else rate_r
        pressed = -(gap_r + gap_l)
        meets = comes_back(deformation, pressed, rate)
        if meets < t:
            event, t = other, meets
    clock = (s, c) if event == DETACHED else turned(plan, clock[0], clock[1], t)
    if mode & other:
        pass
    elif event == other:
        if side == RIGHT:
            left = -(gap_r + gap_l)
        else:
            right = -(gap_r + gap_l)
    elif side == RIGHT:
        left = relaxed(left, rate_l, t)
    else:
        right = relaxed(right, rate_r, t)
    if event == DETACHED:
        fresh = side if pulled else side | RELEASED
        return event, t, 0.0, Motion(mode & ~side, fresh, u, 0.0, right, left, z, 0.0, clock)
    if event == other:
        return event, t, 0.0, Motion(BOTH, other, u, 0.0, right, left, z, 0.0, clock)
    return event, t, 0.0, Motion(mode, 0, u, 0.0, right, left, z, age + t, clock)


@kernel
def approach(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Pressed on one side, free of the other until that is touched as well."""
    mode, fresh, _, v, right, left, z, age, clock = motion
    gap_r, gap_l, rate_r, rate_l = bumpers(plan)
    sign = 1.0 if mode == RIGHT else -1.0
    x, free = (right, left) if mode == RIGHT else (left, right)
    rate = rate_l if mode == RIGHT else rate_r
    other = BOTH - mode
    s, c = clock
    # Seen from the pressed side, the other stop lies below.
    way, t, row, _, free = flight(
        plan,
        mode,
        Row(x, sign * v, sign * s, sign * c),
        Bounds(math.inf, -(gap_r + gap_l), 0.0, free, math.inf, rate),
        BELOW if fresh & BOTH == other else WITHIN,
        fresh & RELEASED != 0,
        limit,
        age,
    )
    x, v, s, c = row
    v, clock = sign * v, (sign * s, sign * c)
    right, left = (x, free) if mode == RIGHT else (free, x)
    u = gap_r + x if mode == RIGHT else -(gap_l + x)
    if way == WITHIN:
        return LIMIT, t, v, Motion(mode, 0, u, v, right, left, z, age + t, clock)
    return other, t, v, Motion(BOTH, other, u, v, right, left, z, 0.0, clock)


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
        for side in range(1, 3):
            if mode & side:
                one = press(plan, motion, side, t)
                if one[0] != LIMIT or event == LIMIT:
                    event, t, arrival, after = one
        if mode != BOTH and overlapping(plan):
            one = approach(plan, motion, t)
            if one[0] != LIMIT:
                event, t, arrival, after = one
    if event in (RIGHT, LEFT) and rigid(plan, event):
        return impact(plan, event, t, arrival, after)
    return event, t, arrival, after
