"""What happens at a rigid stop: impacts, chatter and rest."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import CONTACT, IMPACT, LIMIT, REST_ENDS, event_of, kind_of, stop_of
from vibroimpact.engine.forcing.dispatch import pace, release_time, turned, value
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import STEEPEST
from vibroimpact.engine.motion import (
    BOTH,
    RELEASED,
    RIGHT,
    Ended,
    Motion,
    Stretch,
    arrived,
    changed,
    facing,
    main_stop,
)
from vibroimpact.engine.one_mass.forces import acceleration_of, isolator_force, springs
from vibroimpact.engine.state import SETTLING
from vibroimpact.engine.stops.kelvin_voigt import comes_back, rate_of, relaxed, relaxed_faces
from vibroimpact.engine.stops.places import gap_of, overlapping, place_at, total_gap
from vibroimpact.engine.stops.rigid import rebound_at, rigid

_CHATTERED = 1e-6
"""A chatter is completed where its rest lasts for less than this share of the time in which the
force that presses the mass could change: the end of the geometric series is then right to 1e-12
of that time, and the rest that follows does not depend on it."""

_GRAIN = 2.0**-49
"""Returns no higher than this share of the displacement are lost in its rounding where each is cut
in two at its top: they would go on for ever."""


@kernel
def impact(plan: Vector, stop: int, t: float, arrival: float, motion: Motion) -> Ended:
    """What follows when the mass meets a rigid stop: u̇ → −e u̇, or rest."""
    mode, _, _, v, faces, z, _, clock = motion
    event, bit = event_of(IMPACT, stop), 1 << stop
    u = place_at(plan, stop, 0.0)  # which from a pressed bumper's face is rounded
    v = -rebound_at(plan, stop, v).restitution * v
    bounced = Motion(mode & ~bit, bit, u, v, faces, z, 0.0, clock)
    push = facing(stop) * acceleration_of(plan, bounced)  # towards the stop
    onward = rebound_at(plan, stop, v).onward
    if not push > 0.0 or onward >= 1.0:
        return event, t, arrival, bounced
    rest = chatter(v, onward, push)
    # How fast the push may change meanwhile, and the rig's own rates.
    change = plan[par.DAMPING] * push + plan[STEEPEST]
    stiffness = springs(plan, bounced)
    change += stiffness * abs(v)
    rate = pace(plan) + math.sqrt(stiffness) + plan[par.DAMPING]
    for other in range(2):
        at = par.stop_at(other)
        if plan[at + par.KIND] == par.KELVIN_VOIGT and mode >> other & 1:
            rate += math.sqrt(plan[at + par.BUMPER_STIFFNESS]) + plan[at + par.BUMPER_DAMPING]
            change += plan[at + par.BUMPER_STIFFNESS] * abs(v)
            change += plan[at + par.BUMPER_DAMPING] * push
    size = abs(u) + abs(z)  # by which a yielding isolator's displacement is moved in its tables
    lost = plan[par.CURVED] != 0.0 and v * v < 2.0 * push * _GRAIN * size
    if (rest * rate > _CHATTERED or rest * change > _CHATTERED * push) and not lost:
        return event, t, arrival, bounced
    last = Motion(bounced.mode, bit | SETTLING, u, v, faces, z, 0.0, clock)
    return event, t, arrival, last


@kernel
def chatter(v: float, restitution: float, push: float) -> float:
    """How long impacts go on behind a return with v, pressed so hard: a geometric series (s)."""
    return 2.0 * abs(v) / (push * (1.0 - restitution))


@kernel
def settle(plan: Vector, motion: Motion, limit: float) -> Ended:
    """What is left of a chatter, and the rest to which it leads."""
    mode, fresh, _, v, faces, z, _, clock = motion
    bit = fresh & BOTH
    stop = main_stop(bit)
    push = acceleration_of(plan, motion) * facing(stop)
    t = min(chatter(v, rebound_at(plan, stop, v).onward, push), limit)
    faces = changed(relaxed_faces(plan, mode, faces, t), stop, 0.0)
    u = place_at(plan, stop, 0.0)
    clock = turned(plan, clock[0], clock[1], t)
    event = event_of(IMPACT, stop)
    return event, t, 0.0, Motion(mode | bit, bit, u, 0.0, faces, z, 0.0, clock)


@kernel
def rest(plan: Vector, motion: Motion, limit: float) -> Ended:
    """At rest on a rigid stop until the force lets go of the mass, or a bumper reaches it."""
    mode, _, u, _, faces, z, age, clock = motion
    stop = 0 if mode & RIGHT and rigid(plan, 0) else 1
    other = 1 - stop
    sign, here, there = facing(stop), 1 << stop, 1 << other
    facing_stop = par.stop_at(other)
    # It is pressed by `level` − A_t, as seen from this stop.
    level = sign * (plan[par.LOAD] - isolator_force(plan, sign * gap_of(plan, stop), 0.0, z))
    if mode & there:
        level += plan[facing_stop + par.BUMPER_STIFFNESS] * faces[other]
    s, c = clock
    pulled = sign * value(plan, s, c) > level  # let go at once, and not with zero acceleration
    event, t = LIMIT, limit
    free, s, c = release_time(plan, sign, level, s, c, limit)
    if free < math.inf:
        event, t = event_of(REST_ENDS, stop), free
    met = mode & there
    if overlapping(plan) and not met and plan[facing_stop + par.KIND] != par.ABSENT:
        # The free bumper comes back to where the mass rests.
        meets = comes_back(faces[other], -total_gap(plan), rate_of(plan, other))
        if meets < t:
            event, t = event_of(CONTACT, other), meets
    kind = kind_of(event)
    clock = (s, c) if kind == REST_ENDS else turned(plan, clock[0], clock[1], t)
    if kind == CONTACT:
        faces = changed(faces, other, -total_gap(plan))
        return event, t, 0.0, Motion(BOTH, there, u, 0.0, faces, z, 0.0, clock)
    if not met:
        faces = changed(faces, other, relaxed(faces[other], rate_of(plan, other), t))
    if kind == REST_ENDS:
        fresh = here if pulled else here | RELEASED
        return event, t, 0.0, Motion(mode & ~here, fresh, u, 0.0, faces, z, 0.0, clock)
    return event, t, 0.0, Motion(mode, 0, u, 0.0, faces, z, age + t, clock)


@kernel
def impact_depth(plan: Vector, stretch: Stretch) -> float:
    """Depth to which an impact would go without its stop; infinite where it would not turn."""
    after, stop = stretch.after, stop_of(stretch.event)
    if kind_of(stretch.event) != IMPACT or after.mode >> stop & 1:
        return math.inf
    met = arrived(stretch.before.mode, stretch.arrival, after)
    back = -facing(stop) * acceleration_of(plan, met)
    if not back > 0.0:
        return math.inf
    depth: float = stretch.arrival * stretch.arrival / (2.0 * back)
    return depth
