"""From one event to the next under curved laws, a leap or a Taylor step at a time.

Where a leap does not know the forces or is not sure, a step is taken (`leaps`). On each step every
event that may come is asked for. What the sizes of a series' coefficients exclude costs a sum; the
rest is searched (`linear.roots`) about the beginning, middle and end, without what just was.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import change_rate, let_go, turned, value
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
    GIVEN_UP,
    LEFT,
    LIMIT,
    RELEASED,
    RIGHT,
    SETTLING,
    SLIPS_LEFT,
    SLIPS_RIGHT,
    TURNED,
    Motion,
)
from vibroimpact.engine.taylor.frame import (
    Frame,
    balanced,
    creeps,
    curved_stop,
    grip,
    idle,
    push_of,
    rounding,
    steep,
    stuck,
    way_of,
    without_friction,
)
from vibroimpact.engine.taylor.laws import EVEN
from vibroimpact.engine.taylor.layout import ASKED, DEGREE, HEADER, X, Z
from vibroimpact.engine.taylor.leaps import (
    DETACHED_LEFT,
    EASED,
    NO_LEAP,
    UNBENT,
    YIELDS,
    leap_on,
    leaps,
)
from vibroimpact.engine.taylor.pieces import (
    PIECES,
    begun,
    facing_of,
    motion_at,
    push_series,
    shifted,
    velocity_series,
)
from vibroimpact.engine.taylor.press import press_on, presses
from vibroimpact.engine.taylor.step import headed, spread

_MOST = 50_000
"""Steps to one event, far more than any needs whose rates are those of the rig. A stop that is
met all but without speed may have a dissipation beyond all bounds, and is given up."""

_AT_ONCE = 1e-6
"""Of a phase whose length is known: what ends it sooner is rounding."""


class Found(NamedTuple):
    """The earliest event so far: what, and where in the step (its length is 1)."""

    event: int
    y: float


@kernel
def first_in_step(
    plan: Vector, series: int, clearance: Clearance, launched: bool, released: bool, first: float
) -> float:
    """The first root on the step, a share of it, or NONE.

    `launched` says that the clearance vanishes at the step's beginning by construction, `first`
    behind which share no root is asked for.
    """
    offset, sign, memory, rate, _ = clearance
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
    return Found(event, y) if y < found.y else found


@kernel
def search(plan: Vector, motion: Motion, frame: Frame, length: float) -> Found:
    """The earliest event of the step in hand."""
    mode, fresh, _, _, right, left, _, _, _ = motion
    found = Found(LIMIT, NONE)
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
                push_series(plan, mode, side)
                found = lets_go(plan, found, side, just)
            elif kind != par.RIGID:
                found = eases(plan, found, mode, side, memory)
                depth_series(plan, mode, side)
                found = lets_go(plan, found, side, just)
            continue
        if mode and not overlapping(plan):
            continue
        level, sign = gap_r if side == RIGHT else gap_l, -1.0 if side == RIGHT else 1.0
        if mode:
            # Seen from the pressed side, the other stop lies below.
            level, sign = gap_r + gap_l, 1.0
        if curved_stop(plan, side):
            memory = 0.0
        clearance = Clearance(level, sign, memory, rate, False)
        found = watch(plan, found, side, X, reach, clearance, just, fresh & RELEASED != 0)
    return turns(plan, found, motion, frame)


@kernel
def lets_go(plan: Vector, found: Found, side: int, fresh: bool) -> Found:
    """Take the detachment into account: where what is asked, a force or a depth, falls to 0."""
    if fresh:
        plan[ASKED] = max(plan[ASKED], 0.0)
    clearance = Clearance(0.0, 1.0, 0.0, 0.0, False)
    event = DETACHED if side == RIGHT else DETACHED_LEFT
    return watch(plan, found, event, ASKED, spread(plan, ASKED), clearance, False, False)


@kernel
def depth_series(plan: Vector, mode: int, side: int) -> None:
    """Write the deformation of a pressed stop over the step to ASKED."""
    facing = facing_of(mode, side)
    for n in range(DEGREE + 1):
        plan[ASKED + n] = facing * plan[X + n]
    if facing < 0.0:
        left = par.BUMPER + par.WIDTH
        plan[ASKED] -= plan[par.BUMPER + par.GAP] + plan[left + par.GAP]


@kernel
def eases(plan: Vector, found: Found, mode: int, side: int, speed: float) -> Found:
    """Take the moment into account at which 1 + χ δ′ changes sign: a stop does not pull."""
    facing = facing_of(mode, side)
    chi = push_of(plan, side, 0.0, speed).dissipation
    if chi == 0.0:
        return found
    velocity_series(plan, chi * facing * (plan[HEADER + RATE] / PIECES))
    plan[ASKED] += 1.0
    bend = 1.0 if plan[ASKED] > EVEN or (plan[ASKED] > -EVEN and plan[ASKED + 1] > 0.0) else -1.0
    if abs(plan[ASKED]) <= EVEN:
        plan[ASKED] = 0.0
    clearance = Clearance(0.0, bend, 0.0, 0.0, False)
    return watch(plan, found, EASED, ASKED, spread(plan, ASKED), clearance, False, False)


@kernel
def turns(plan: Vector, found: Found, motion: Motion, frame: Frame) -> Found:
    """Take the end of a branch into account: u̇ or z changes sign, or z reaches its limit."""
    hysteretic = plan[par.HYSTERETIC] != 0.0
    if not (
        hysteretic
        or plan[par.DRAG] != 1.0
        or plan[par.FRICTION] != 0.0
        or (motion.mode & RIGHT and plan[par.BUMPER + par.KIND] == par.JANKOWSKI)
        or (motion.mode & LEFT and plan[par.BUMPER + par.WIDTH + par.KIND] == par.JANKOWSKI)
    ):
        return found
    way = way_of(plan, motion)
    ways = frame.sign * way
    velocity_series(plan, 1.0)
    if motion.v == 0.0:
        plan[ASKED] = 0.0
        slips = motion.fresh & (SLIPS_RIGHT | SLIPS_LEFT | RELEASED)
        if (slips and not steep(plan)) or balanced(plan, motion):
            plan[ASKED + 1] = 0.0
    clearance = Clearance(0.0, ways, 0.0, 0.0, False)
    found = watch(plan, found, TURNED, ASKED, spread(plan, ASKED), clearance, False, False)
    if not hysteretic:
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
def held(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Held by friction until the forces exceed it, or a free bumper comes back to the mass."""
    mode, _, u, _, right, left, z, age, clock = motion
    gap_r, gap_l, rate_r, rate_l = bumpers(plan)
    s, c = clock
    # `still` − A_t is what friction holds against.
    still = without_friction(plan, motion) + value(plan, s, c)
    event, t, slips, most = LIMIT, limit, 0, grip(plan)
    if idle(plan, motion):
        most = max(most, rounding(plan, motion))
    after = turned(plan, s, c, limit)
    for way in range(2):
        sign = -1.0 if way == 0 else 1.0  # to the right where −A_t exceeds a level
        free, s1, c1 = let_go(plan, sign, most + sign * still, s, c, t)
        if free < t:
            event, t, after = TURNED, free, (s1, c1)
            slips = SLIPS_RIGHT if way == 0 else SLIPS_LEFT
    for side in range(1, 3):
        memory, rate = (right, rate_r) if side == RIGHT else (left, rate_l)
        gap, reach = (gap_r, u) if side == RIGHT else (gap_l, -u)
        depth = reach - gap
        if not mode & side and memory > 0.0 and depth > 0.0 and rate < math.inf:
            meets = math.log(memory / depth) / rate if memory > depth else 0.0
            if meets < t:
                event, t, after = side, meets, turned(plan, s, c, meets)
    if not mode & RIGHT:
        right = max(u - gap_r, 0.0) if event == RIGHT else relaxed(right, rate_r, t)
    if not mode & LEFT:
        left = max(-u - gap_l, 0.0) if event == LEFT else relaxed(left, rate_l, t)
    if event in (RIGHT, LEFT):
        return event, t, 0.0, Motion(mode | event, event, u, 0.0, right, left, z, 0.0, after)
    fresh = slips if event == TURNED else 0
    if not mode and event == TURNED:  # away from what it touches, at first without acceleration
        if slips == SLIPS_LEFT and u >= gap_r + right:
            fresh |= RIGHT | RELEASED
        elif slips == SLIPS_RIGHT and -u >= gap_l + left:
            fresh |= LEFT | RELEASED
    return event, t, 0.0, Motion(mode, fresh, u, 0.0, right, left, z, age + t, after)


@kernel
def happened(plan: Vector, event: int, here: Motion, t: float) -> Ended:
    """The motion just behind the event, exactly there."""
    mode, _, u, v, right, left, z, _, clock = here
    gap_r, gap_l, _, _ = bumpers(plan)
    if event in (RIGHT, LEFT):
        if not mode:  # else the pressed bumper's deformation is the primary quantity
            u = gap_r + right if event == RIGHT else -(gap_l + left)
        if curved_stop(plan, event):
            if event == RIGHT:
                right = abs(v)
            else:
                left = abs(v)
        after = Motion(mode | event, event, u, v, right, left, z, 0.0, clock)
        return event, t, v, after
    if event in (DETACHED, DETACHED_LEFT):
        side = RIGHT if event == DETACHED else LEFT
        damped = plan[par.BUMPER + par.WIDTH * (side - 1) + par.BUMPER_DAMPING] != 0.0
        if curved_stop(plan, side) or not damped:
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
    elif event == EASED:
        pass
    elif event == YIELDS:
        z = math.copysign(plan[par.YIELD], z)
    else:
        z = 0.0
    return TURNED, t, arrival, Motion(mode, 0, u, v, right, left, z, 0.0, clock)


@kernel
def still(plan: Vector, motion: Motion, limit: float) -> Ended:
    """At rest on a rigid stop, or held by friction, until something lets go of the mass."""
    headed(plan, 0.25 / change_rate(plan), False)  # by which several harmonics find their way
    if stuck(plan, motion) or idle(plan, motion):
        return held(plan, motion, limit)
    return rest(plan, motion, limit)


@kernel
def advance_taylor(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next event, or for the time `limit` if that comes first."""
    if motion.fresh & SETTLING:
        return settle(plan, motion, limit)
    if resting(plan, motion.mode) or stuck(plan, motion) or idle(plan, motion):
        return still(plan, motion, limit)
    t = 0.0
    here = motion
    hint = math.inf
    for _ in range(_MOST):
        if creeps(plan, here):
            return happened(plan, TURNED, here, t)
        pressing = presses(plan, here)
        if pressing or leaps(plan, here):
            if pressing:
                leap = press_on(plan, here, limit - t, hint)
            else:
                leap = leap_on(plan, here, limit - t, hint)
            if leap.event != NO_LEAP:
                here, hint = leap.motion, leap.next
                if leap.event != LIMIT:
                    event, t, arrival, after = happened(plan, leap.event, here, t + leap.t)
                    if event in (RIGHT, LEFT) and rigid(plan, event):
                        return impact(plan, event, t, arrival, after, limit)
                    return event, t, arrival, after
                if not t + leap.t < limit:
                    return LIMIT, limit, here.v, here
                t += leap.t
                continue
        frame, length = begun(plan, here, limit - t)
        found = search(plan, here, frame, length)
        if found.event != LIMIT:
            here = motion_at(plan, here, frame, found.y)
            t += found.y * length
            event, t, arrival, after = happened(plan, found.event, here, t)
            if event in (RIGHT, LEFT) and rigid(plan, event):
                return impact(plan, event, t, arrival, after, limit)
            return event, t, arrival, after
        here = motion_at(plan, here, frame, 1.0)
        if not t + length < limit:
            return LIMIT, limit, here.v, here
        t += length
    return GIVEN_UP, t, here.v, here


@kernel
def smooth(plan: Vector, motion: Motion, limit: float) -> tuple[float, Motion]:
    """How long a motion follows one piece of its laws, stops left out, and what is behind it."""
    event, t, _, after = advance_taylor(plan, motion, limit)
    if event == TURNED:
        return t, after
    if event != LIMIT and t < _AT_ONCE * limit:
        # It begins without a force, and the rounding of its time has it part at once.
        frame, length = begun(plan, motion, _AT_ONCE * limit)
        return length, motion_at(plan, motion, frame, 1.0)
    return limit, after
