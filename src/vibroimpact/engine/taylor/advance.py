"""From one event to the next under curved laws, a Taylor step at a time.

On each step every event that may come is asked for: a free stop that is touched, a bumper that
lets go, and what ends a branch of the isolator's law. What the sizes of a series' coefficients
exclude costs a sum; the rest is searched as between tables (`linear.roots`), in three parts: about
the step's beginning, its middle and its end, so that what has just happened there has no noise.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.advance import Ended, bumpers
from vibroimpact.engine.linear.evaluate import relaxed
from vibroimpact.engine.linear.flight import leave
from vibroimpact.engine.linear.layout import RATE
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root
from vibroimpact.engine.linear.stops import impact, rest, rigid, settle
from vibroimpact.engine.linear.tables import overlapping, resting
from vibroimpact.engine.linear.walk import ABOVE, BELOW
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import (
    BOTH,
    DETACHED,
    LEFT,
    LIMIT,
    RELEASED,
    RIGHT,
    SETTLING,
    TURNED,
    Motion,
)
from vibroimpact.engine.taylor.frame import Frame, branch_of, frame_of, way_of
from vibroimpact.engine.taylor.layout import ASKED, DEGREE, HEADER, X, Z
from vibroimpact.engine.taylor.pieces import PIECES, begun, motion_at, placed, push_series, shifted


DETACHED_LEFT, YIELDS, UNBENT = 16, 17, 18
"""Events of a step besides those of a stretch."""


class Found(NamedTuple):
    """The earliest event so far: what, where in the step (its length is 1), and at which level."""

    event: int
    y: float
    level: float


@kernel
def spread(plan: Vector, series: int) -> float:
    """How far a series may go from its first coefficient, over the step."""
    total = 0.0
    for n in range(1, DEGREE + 1):
        total += abs(plan[series + n])
    return total


@kernel
def first_in_step(
    plan: Vector, series: int, clearance: Clearance, launched: bool, released: bool, first: float
) -> float:
    """The first root on the step, a share of it, or NONE.

    `launched` says that the clearance vanishes at the step's beginning by construction, `first`
    behind which share no root is asked for.
    """
    offset, sign, memory, rate, double = clearance
    room = workspace()
    pace = rate / PIECES  # per piece
    for part in range(3):
        low = 0.0 if part == 0 else -0.5
        high = 0.0 if part == 2 else 0.5
        if part and first < 0.5 * part - 0.25:
            return NONE
        shifted(plan, series, 2 * part, room)
        left = memory
        if memory > 0.0 and part:
            left = relaxed(memory, rate, 0.5 * part - 0.25)
        if part == 0 and launched:
            way = ABOVE if sign < 0.0 else BELOW
            y = leave(room, way, released, left, pace, high)
        else:
            y = first_root(room, Clearance(offset, sign, left, pace, False), low, high)
        if y != NONE:
            return (part + y) / PIECES
    return NONE


@kernel
def watch(
    plan: Vector,
    found: Found,
    event: int,
    series: int,
    reach: float,
    clearance: Clearance,
    launched: bool,
    released: bool,
) -> Found:
    """Take one event into account, whose series goes no farther than `reach`."""
    if not launched:
        start = clearance.offset + clearance.sign * plan[series]
        if start - reach > 0.0:
            return found
    y = first_in_step(plan, series, clearance, launched, released, found.y)
    return Found(event, y, clearance.offset) if y < found.y else found


@kernel
def search(plan: Vector, motion: Motion, frame: Frame, length: float) -> Found:
    """The earliest event of the step in hand."""
    mode, fresh, _, v, right, left, z, _, _ = motion
    found = Found(LIMIT, NONE, 0.0)
    gap_r, gap_l, rate_r, rate_l = bumpers(plan)
    reach = spread(plan, X)
    for side in range(1, 3):
        kind = plan[par.BUMPER + par.WIDTH * (side - 1) + par.KIND]
        if kind == par.ABSENT:
            continue
        memory = right if side == RIGHT else left
        rate = (rate_r if side == RIGHT else rate_l) * length
        just = fresh & BOTH == side
        if mode & side:
            if kind == par.KELVIN_VOIGT:
                found = lets_go(plan, found, mode, side, just, length)
            continue
        if mode and not overlapping(plan):
            continue
        level, sign = gap_r if side == RIGHT else gap_l, -1.0 if side == RIGHT else 1.0
        if mode:
            # Seen from the pressed side, the other stop lies below.
            level, sign = gap_r + gap_l, 1.0
        clearance = Clearance(level, sign, memory, rate, False)
        found = watch(plan, found, side, X, reach, clearance, just, fresh & RELEASED != 0)
    if plan[par.HYSTERETIC] != 0.0 or plan[par.DRAG] != 1.0:
        found = turns(plan, found, motion, frame)
    return found


@kernel
def lets_go(plan: Vector, found: Found, mode: int, side: int, fresh: bool, length: float) -> Found:
    """Take the detachment from a pressed bumper into account."""
    push_series(plan, mode, side)
    if fresh:
        plan[ASKED] = max(plan[ASKED], 0.0)
    clearance = Clearance(0.0, 1.0, 0.0, 0.0, False)
    event = DETACHED if side == RIGHT else DETACHED_LEFT
    return watch(plan, found, event, ASKED, spread(plan, ASKED), clearance, False, False)


@kernel
def turns(plan: Vector, found: Found, motion: Motion, frame: Frame) -> Found:
    """Take the end of the isolator's branch into account: u̇ or z changes sign, or z its limit."""
    way = way_of(plan, motion)
    ways = frame.sign * way
    for n in range(DEGREE):
        plan[ASKED + n] = (n + 1) * plan[X + n + 1]
    plan[ASKED + DEGREE] = 0.0
    if motion.v == 0.0:
        plan[ASKED] = 0.0
    clearance = Clearance(0.0, ways, 0.0, 0.0, False)
    found = watch(plan, found, TURNED, ASKED, spread(plan, ASKED), clearance, False, False)
    if plan[par.HYSTERETIC] == 0.0:
        return found
    z, limit = motion.z, plan[par.YIELD]
    if limit < math.inf:
        if abs(z) < limit or way * z < 0.0:
            clearance = Clearance(limit, -ways, 0.0, 0.0, False)
            found = watch(plan, found, YIELDS, Z, spread(plan, Z), clearance, False, False)
    elif plan[par.KNEE] != 0.0 or int(plan[par.SHARPNESS]) % 2 == 0:
        side = math.copysign(1.0, z) if z != 0.0 else way
        clearance = Clearance(0.0, frame.sign * side, 0.0, 0.0, False)
        found = watch(plan, found, UNBENT, Z, spread(plan, Z), clearance, False, False)
    return found


@kernel
def happened(plan: Vector, motion: Motion, found: Found, here: Motion, t: float) -> Ended:
    """The motion just behind the event, exactly there."""
    mode, _, u, v, right, left, z, _, clock = here
    gap_r, gap_l, _, _ = bumpers(plan)
    event = found.event
    if event in (RIGHT, LEFT):
        kind = plan[par.BUMPER + par.WIDTH * (event - 1) + par.KIND]
        if not mode:  # else the pressed bumper's deformation is the primary quantity
            u = gap_r + right if event == RIGHT else -(gap_l + left)
        if kind == par.POWER_LAW or kind == par.JANKOWSKI:
            if event == RIGHT:
                right = abs(v)
            else:
                left = abs(v)
        after = Motion(mode | event, event, u, v, right, left, z, 0.0, clock)
        return event, t, v, after
    if event in (DETACHED, DETACHED_LEFT):
        side = RIGHT if event == DETACHED else LEFT
        if plan[par.BUMPER + par.WIDTH * (side - 1) + par.BUMPER_DAMPING] == 0.0:
            if side == RIGHT:
                right = 0.0
            else:
                left = 0.0
            u = gap_r + right if side == RIGHT else -(gap_l + left)
        after = Motion(mode & ~side, side, u, v, right, left, z, 0.0, clock)
        return DETACHED, t, v, after
    arrival = v
    if event == TURNED:
        v = 0.0
    elif event == YIELDS:
        z = math.copysign(plan[par.YIELD], z)
    else:
        z = 0.0
    return TURNED, t, arrival, Motion(mode, 0, u, v, right, left, z, 0.0, clock)


@kernel
def advance_taylor(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next event, or for the time `limit` if that comes first."""
    if motion.fresh & SETTLING:
        return settle(plan, motion, limit)
    if resting(plan, motion.mode):
        return rest(plan, motion, limit)
    t = 0.0
    here = motion
    while True:
        frame, length = begun(plan, here, limit - t)
        found = search(plan, here, frame, length)
        if found.event != LIMIT:
            here = motion_at(plan, here, frame, found.y)
            t += found.y * length
            event, t, arrival, after = happened(plan, motion, found, here, t)
            if event in (RIGHT, LEFT) and rigid(plan, event):
                return impact(plan, event, t, arrival, after, limit)
            return event, t, arrival, after
        here = motion_at(plan, here, frame, 1.0)
        if not t + length < limit:
            return LIMIT, limit, here.v, here
        t += length
