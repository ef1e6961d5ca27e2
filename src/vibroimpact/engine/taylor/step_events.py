"""What may end a step under curved laws, and when it first does (`series.events`)."""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import (
    CENTRED,
    CONTACT,
    DETACHMENT,
    EASED,
    LIMIT,
    TURN,
    UNBENT,
    YIELD,
    event_of,
)
from vibroimpact.engine.jit import Vector, inlined, kernel, not_inlined
from vibroimpact.engine.linear.roots import NONE, Clearance
from vibroimpact.engine.motion import BOTH, RELEASED, SLIPPED, Motion, facing
from vibroimpact.engine.series.events import (
    FIXED,
    NEVER,
    Ends,
    FreeFace,
    Line,
    first_in_step,
    first_zero,
    met,
    searched,
)
from vibroimpact.engine.series.kernels import ASKS, CALM, STRIDE, Slot, run
from vibroimpact.engine.series.layout import (
    ASKED,
    DEGREE,
    F_A,
    F_BEND,
    F_BEND_Z,
    F_JERK,
    F_R,
    F_V,
    F_X,
    F_Z,
    FOUND,
    NAMES,
    NUMBERS,
    SLOT,
    X,
    Z,
)
from vibroimpact.engine.series.values import Frame
from vibroimpact.engine.stops.curved import EVEN, curved_stop, push_of
from vibroimpact.engine.stops.kelvin_voigt import rate_of
from vibroimpact.engine.stops.places import gap_of, overlapping, total_gap
from vibroimpact.engine.taylor.mode_forces import balanced, steep
from vibroimpact.engine.taylor.pieces import facing_of
from vibroimpact.law_numbers import ABSOLUTE_X

SIDE, WAY = NUMBERS + NAMES.index("side"), NUMBERS + NAMES.index("way")
_OWN, _STOP = int(Slot.OWN), int(Slot.STOP)
_BOTH, _OTHER = int(Slot.BOTH), int(Slot.OTHER)

_FADED = 1e-18
"""A bumper's memory, as a share of the displacement, that does not move where it is met."""


class FirstEvent(NamedTuple):
    """The earliest event so far: what, and when (in units of time)."""

    event: int
    t: float


@inlined
def earlier(first: FirstEvent, event: int, t: float) -> FirstEvent:
    """The earlier of two events."""
    return FirstEvent(event, t) if t < first.t else first


@inlined
def ends_of(plan: Vector, h: float, x: float, v: float, z: float, hysteretic: bool) -> Ends:
    """What is known of both ends of the step in hand."""
    z1, r, r1, bend_z = 0.0, 0.0, 0.0, 0.0
    if hysteretic:
        z1, r, r1 = plan[FOUND + F_Z], plan[Z + 1], plan[FOUND + F_R]
        bend_z = plan[FOUND + F_BEND_Z]
    return Ends(
        h,
        x,
        v,
        2.0 * plan[X + 2],
        z,
        r,
        plan[FOUND + F_X],
        plan[FOUND + F_V],
        plan[FOUND + F_A],
        z1,
        r1,
        plan[FOUND + F_BEND],
        plan[FOUND + F_JERK],
        bend_z,
    )


@inlined
def parts(plan: Vector, motion: Motion, stop: int, ends: Ends, unit: float) -> float:
    """When the force of a pressed Kelvin-Voigt bumper falls to zero."""
    at = par.stop_at(stop)
    k, c = plan[at + par.BUMPER_STIFFNESS], plan[at + par.BUMPER_DAMPING] / unit
    level = 0.0
    if facing_of(motion.mode, stop) < 0.0:
        k, c = -k, -c
        level = k * total_gap(plan)
    g = level + k * ends.x + c * ends.v
    if motion.fresh & BOTH == 1 << stop:
        g = max(g, 0.0)
    return first_zero(plan, Line(level, k, c, 0.0), ends, g)


@kernel
def earlier_release(
    plan: Vector, motion: Motion, stop: int, ends: Ends, unit: float, first: FirstEvent
) -> FirstEvent:
    """Take the end of a push into account: a depth falls to 0, or 1 + χ δ′ changes sign."""
    facing = facing_of(motion.mode, stop)
    level = 0.0
    if facing < 0.0:
        level = -total_gap(plan)
    if plan[par.stop_at(stop) + par.KIND] == par.FORMULA:
        first = own_eases(plan, stop, level, facing, ends, first)
    memory = motion.faces[stop]
    chi = push_of(plan, stop, 0.0, memory).dissipation * facing / unit
    if chi != 0.0:
        g = 1.0 + chi * ends.v
        bend = 1.0 if g > EVEN or (g > -EVEN and chi * ends.a > 0.0) else -1.0
        if abs(g) <= EVEN:
            g = 0.0
        line = Line(bend, 0.0, bend * chi, 0.0)
        first = earlier(first, EASED, first_zero(plan, line, ends, bend * g))
    g = level + facing * ends.x
    if motion.fresh & BOTH == 1 << stop:
        g = max(g, 0.0)
    event = event_of(DETACHMENT, stop)
    return earlier(first, event, first_zero(plan, Line(level, facing, 0.0, 0.0), ends, g))


@not_inlined
def own_eases(
    plan: Vector, stop: int, level: float, facing: float, ends: Ends, first: FirstEvent
) -> FirstEvent:
    """Take the moment into account at which a stop's own formula changes its sign."""
    way = facing * plan[WAY]
    run(plan, _OWN + STRIDE * (stop + 1) + ASKS, level, facing, 0.0, 0.0, ends.h, way, 0.0)
    slot = int(plan[SLOT]) % CALM
    pushes = slot == _BOTH or slot == _STOP + STRIDE * stop
    if stop == 1 and slot == _OTHER:
        pushes = True
    spread = 0.0
    for n in range(DEGREE + 1):
        if not pushes:
            plan[ASKED + n] = -plan[ASKED + n]
        spread += abs(plan[ASKED + n])
    # It is on this side of 0 by construction: what is not is rounding.
    plan[ASKED] = max(plan[ASKED], 0.0)
    if 2.0 * plan[ASKED] > spread:
        return first
    y = first_in_step(plan, Clearance(0.0, 1.0, 0.0, 0.0, False), False, False)
    return earlier(first, EASED, y * ends.h) if y != NONE else first


@kernel
def starts_still(plan: Vector, motion: Motion) -> bool:
    """Whether a motion starts without velocity and, but for rounding, without acceleration."""
    if motion.v != 0.0:
        return False
    slips = motion.fresh & (SLIPPED | RELEASED)
    return bool((slips and not steep(plan)) or balanced(plan, motion))


@kernel
def turns(
    plan: Vector,
    motion: Motion,
    ways: float,
    sign: float,
    ends: Ends,
    since: float,
    first: FirstEvent,
) -> FirstEvent:
    """Take the end of a branch into account: u̇ or z changes sign, or z reaches its limit."""
    line = Line(0.0, 0.0, ways, 0.0)
    if motion.v == 0.0 and since == 0.0:
        if starts_still(plan, motion):
            t = searched(plan, line, FIXED, 0.0, True, ends.h)
        else:
            t = first_zero(plan, line, ends, 0.0)
        first = earlier(first, TURN, t)
    else:
        first = earlier(first, TURN, first_zero(plan, line, ends, ways * ends.v))
    if plan[par.HYSTERETIC] == 0.0:
        return first
    z, limit = motion.z, plan[par.YIELD]
    way = ways * sign
    if limit < math.inf:
        if abs(z) < limit or way * z < 0.0:
            line = Line(limit, 0.0, 0.0, -ways)
            first = earlier(first, YIELD, first_zero(plan, line, ends, limit - way * z))
    elif plan[par.KNEE] != 0.0 or int(plan[par.SHARPNESS]) % 2 == 0:
        side = math.copysign(1.0, z) if z != 0.0 else way
        line = Line(0.0, 0.0, 0.0, sign * side)
        first = earlier(first, UNBENT, first_zero(plan, line, ends, abs(z)))
    return first


@kernel
def passes_centre(
    plan: Vector, motion: Motion, offset: float, ends: Ends, since: float, first: FirstEvent
) -> FirstEvent:
    """Take the moment into account at which u changes its sign."""
    side = plan[SIDE]
    line = Line(side * offset, side, 0.0, 0.0)
    if motion.u == 0.0 and motion.v == 0.0 and since == 0.0:
        return earlier(first, CENTRED, searched(plan, line, FIXED, 0.0, True, ends.h))
    g = max(side * (offset + ends.x), 0.0)
    return earlier(first, CENTRED, first_zero(plan, line, ends, g))


@inlined
def search(
    plan: Vector, motion: Motion, frame: Frame, ways: float, ends: Ends, unit: float, since: float
) -> FirstEvent:
    """The earliest event of the step in hand; free stops are as they were a time before."""
    mode, fresh = motion.mode, motion.fresh
    first = FirstEvent(LIMIT, NEVER)
    for stop in range(2):
        kind = plan[par.stop_at(stop) + par.KIND]
        if kind == par.ABSENT:
            continue
        if mode >> stop & 1:
            event = event_of(DETACHMENT, stop)
            if kind == par.KELVIN_VOIGT:
                first = earlier(first, event, parts(plan, motion, stop, ends, unit))
            elif kind != par.RIGID:
                first = earlier_release(plan, motion, stop, ends, unit, first)
            continue
        if mode and not overlapping(plan):
            continue
        # Seen from a pressed stop, the other stop lies below.
        level = total_gap(plan) if mode else gap_of(plan, stop)
        sign = 1.0 if mode else -facing(stop)
        memory = motion.faces[stop]
        if curved_stop(plan, stop):
            memory = 0.0
        rate = rate_of(plan, stop) * unit
        just = fresh & BOTH == 1 << stop
        free = FreeFace(memory, rate, since, just, just and fresh & RELEASED != 0)
        size = abs(level) + abs(ends.x)
        t = met(plan, level, sign, free, ends, _FADED * size)
        first = earlier(first, event_of(CONTACT, stop), t)
    if ways != 0.0:
        first = turns(plan, motion, ways, frame.sign, ends, since, first)
    if int(plan[par.OWN + par.OWN_FLAGS]) & ABSOLUTE_X:
        first = passes_centre(plan, motion, frame.offset, ends, since, first)
    return first
