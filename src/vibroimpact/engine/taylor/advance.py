"""From one event to the next under curved laws, a Taylor step at a time.

On each step every event that may come is looked for (`series.events`), without what just was.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import (
    CENTRED,
    CONTACT,
    DETACHMENT,
    EASED,
    GIVEN_UP,
    LACKS,
    LIMIT,
    NEITHER,
    TURN,
    YIELD,
    event_of,
    kind_of,
    stop_of,
)
from vibroimpact.engine.forcing.dispatch import change_rate, release_time, stepped, turned, value
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.motion import RELEASED, SLIPS, Ended, Motion, changed, facing
from vibroimpact.engine.series.events import state_near
from vibroimpact.engine.series.layout import LACKING, OVERFLOWED
from vibroimpact.engine.series.step_control import write_header
from vibroimpact.engine.state import SETTLING
from vibroimpact.engine.stops.curved import curved_stop
from vibroimpact.engine.stops.kelvin_voigt import comes_back, rate_of, relaxed_faces
from vibroimpact.engine.stops.places import gap_of, place_at
from vibroimpact.engine.stops.rigid import rigid
from vibroimpact.engine.stops.rigid_events import impact, rest, settle
from vibroimpact.engine.taylor.mode_forces import (
    creeps,
    frame_of,
    grip,
    idle,
    rounding,
    stands,
    stuck,
    without_friction,
)
from vibroimpact.engine.taylor.pieces import at_coordinate, coordinate
from vibroimpact.engine.taylor.root_steps import MOST, pressed_for, root_of
from vibroimpact.engine.taylor.step_events import (
    ends_of,
    search,
)
from vibroimpact.engine.taylor.step_setup import NOT_YET, ahead_of, branched, stepped_on, varies


@not_inlined
def with_relaxed_stops(plan: Vector, motion: Motion, t: float) -> Motion:
    """The same motion with the stops that it does not touch relaxed for t seconds."""
    mode, fresh, u, v, faces, z, age, clock = motion
    faces = relaxed_faces(plan, mode, faces, t)
    return Motion(mode, fresh, u, v, faces, z, age + t, clock)


@kernel
def held(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Held by friction until the forces exceed it, or a free bumper comes back to the mass."""
    mode, _, u, _, faces, z, age, clock = motion
    s, c = clock
    # `still` − A_t is what friction holds against.
    still = without_friction(plan, motion) + value(plan, s, c)
    event, t, slips, most = LIMIT, limit, 0, grip(plan)
    if idle(plan, motion):
        most = max(most, rounding(plan, motion))
    after = turned(plan, s, c, limit)
    for way in range(2):
        sign = -1.0 if way == 0 else 1.0  # to the right where −A_t exceeds a level
        free, s1, c1 = release_time(plan, sign, most + sign * still, s, c, t)
        if free < t:
            event, t, after = TURN, free, (s1, c1)
            slips = SLIPS << way
    for stop in range(2):
        memory, rate = faces[stop], rate_of(plan, stop)
        depth = facing(stop) * u - gap_of(plan, stop)
        if not mode >> stop & 1 and memory > 0.0 and depth > 0.0 and rate < math.inf:
            meets = comes_back(memory, depth, rate)
            if meets < t:
                event, t, after = event_of(CONTACT, stop), meets, turned(plan, s, c, meets)
    faces = relaxed_faces(plan, mode, faces, t)
    if kind_of(event) == CONTACT:
        stop = stop_of(event)
        bit = 1 << stop
        faces = changed(faces, stop, max(facing(stop) * u - gap_of(plan, stop), 0.0))
        return event, t, 0.0, Motion(mode | bit, bit, u, 0.0, faces, z, 0.0, after)
    fresh = slips if event == TURN else 0
    if not mode and event == TURN:  # away from what it touches, at first without acceleration
        stop = 1 if slips == SLIPS else 0
        if facing(stop) * u >= gap_of(plan, stop) + faces[stop]:
            fresh |= 1 << stop | RELEASED
    return event, t, 0.0, Motion(mode, fresh, u, 0.0, faces, z, age + t, after)


@kernel
def motion_after_event(plan: Vector, event: int, here: Motion, t: float) -> Ended:
    """The motion just after the event, exactly there."""
    mode, _, u, v, faces, z, _, clock = here
    kind, stop = kind_of(event), stop_of(event)
    bit = 1 << stop
    if kind == CONTACT:
        if not mode:  # else the pressed bumper's deformation is the primary quantity
            u = place_at(plan, stop, faces[stop])
        if curved_stop(plan, stop):
            faces = changed(faces, stop, abs(v))
        after = Motion(mode | bit, bit, u, v, faces, z, 0.0, clock)
        return event, t, v, after
    if kind == DETACHMENT:
        if curved_stop(plan, stop) or plan[par.stop_at(stop) + par.BUMPER_DAMPING] == 0.0:
            faces = changed(faces, stop, 0.0)
            u = place_at(plan, stop, 0.0)
        after = Motion(mode & ~bit, bit, u, v, faces, z, 0.0, clock)
        return event, t, v, after
    arrival = v
    if kind == TURN:
        v = 0.0
    elif kind == EASED:
        pass
    elif kind == CENTRED:
        u = 0.0
        for stop in range(2):
            if mode >> stop & 1 and plan[par.stop_at(stop) + par.KIND] == par.KELVIN_VOIGT:
                faces = changed(faces, stop, -gap_of(plan, stop))
    elif kind == YIELD:
        z = math.copysign(plan[par.YIELD], z)
    else:
        z = 0.0
    return TURN, t, arrival, Motion(mode, 0, u, v, faces, z, 0.0, clock)


@kernel
def still(plan: Vector, motion: Motion, limit: float) -> Ended:
    """At rest on a rigid stop, or held by friction, until something lets go of the mass."""
    write_header(plan, 0.25 / change_rate(plan), False)  # by which several harmonics find their way
    if stuck(plan, motion) or idle(plan, motion):
        return held(plan, motion, limit)
    return rest(plan, motion, limit)


@not_inlined
def advance_without_steps(plan: Vector, motion: Motion, limit: float) -> Ended:
    """A motion that is not followed by steps: it settles, stands still, or is given up."""
    if motion.fresh & SETTLING:
        return settle(plan, motion, limit)
    if stands(plan, motion):
        return still(plan, motion, limit)
    return abandoned(plan, motion, 0.0)


@kernel
def advance_taylor(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next event, or for the time `limit` if that comes first."""
    if motion.fresh & SETTLING or stands(plan, motion) or plan[LACKING] != 0.0:
        return advance_without_steps(plan, motion, limit)
    mode, _, _, _, faces, _, age, _ = motion
    frame = frame_of(plan, mode)
    sign = frame.sign
    hysteretic = plan[par.HYSTERETIC] != 0.0
    matters, anew = branched(plan, motion), varies(plan, mode)
    here, there = motion, True
    t = 0.0
    x, z, clock = coordinate(plan, motion), sign * motion.z, motion.clock
    v, ahead = 0.0, NOT_YET
    root = root_of(plan, motion) if anew else 0
    event = GIVEN_UP
    for _ in range(MOST):
        if anew or t == 0.0:
            if root:
                event, step, here = pressed_for(plan, here, frame, root, limit - t, t == 0.0)
                t += step
                if event != NEITHER:
                    break
            x, z, clock = coordinate(plan, here), sign * here.z, here.clock
            if anew and creeps(plan, here):
                event = TURN
                break
            ahead = ahead_of(plan, here, frame, x, limit - t, matters, anew)
            v = sign * here.v * ahead.unit
        h, after = stepped_on(plan, clock, x, v, z, ahead, (limit - t) * ahead.per_unit)
        if plan[LACKING] != 0.0:
            event = LACKS
            break
        ends = ends_of(plan, h, x, v, z, hysteretic)
        ways = ahead.way if matters else 0.0
        first = search(plan, here, frame, ways, ends, ahead.unit, t * ahead.per_unit)
        step = h * ahead.unit
        event = first.event
        if event != LIMIT:
            x, v, z1 = state_near(plan, first.t, h, hysteretic)
            z = z1 if hysteretic else z
            step = first.t * ahead.unit
            after = stepped(plan, clock[0], clock[1], step)
        else:
            x, v = ends.x1, ends.v1
            z = ends.z1 if hysteretic else z
        clock = after
        speed = sign * v * ahead.per_unit
        here, there = Motion(mode, 0, 0.0, speed, faces, sign * z, age, clock), False
        t += step
        if event != LIMIT or not t < limit:
            break
        event = GIVEN_UP
        if anew:
            here, there = at_coordinate(plan, here, x), True
    # One way out for all: each call that returns a motion needs memory, which is cleared first.
    return stretch_end(plan, event, here, x, there, t, limit)


@not_inlined
def abandoned(plan: Vector, here: Motion, t: float) -> Ended:
    """Give the motion up; where the terms of its series left the range of numbers, so did it."""
    mode, fresh, u, v, faces, z, age, clock = here
    if plan[LACKING] == OVERFLOWED:
        u = math.inf
    return GIVEN_UP, t, v, Motion(mode, fresh, u, v, faces, z, age, clock)


@not_inlined
def stretch_end(
    plan: Vector, event: int, here: Motion, x: float, there: bool, t: float, limit: float
) -> Ended:
    """What a stretch ends with; the mass is where the coordinate x says, if not there already."""
    here = with_relaxed_stops(plan, here if there else at_coordinate(plan, here, x), t)
    if event == LACKS:
        return abandoned(plan, here, t)
    if event == GIVEN_UP:
        return GIVEN_UP, t, here.v, here
    if event == LIMIT:
        return LIMIT, limit, here.v, here
    event, t, arrival, after = motion_after_event(plan, event, here, t)
    if kind_of(event) == CONTACT and rigid(plan, stop_of(event)):
        return impact(plan, stop_of(event), t, arrival, after)
    return event, t, arrival, after
