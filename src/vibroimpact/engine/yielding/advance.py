"""From one event to the next for an isolator that yields or slides, by tables.

Between two turns friction is a constant load, and so is the force of what has yielded; until it
yields it is a spring about another place. The motion is then that of linear laws.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import (
    CONTACT,
    DETACHMENT,
    LIMIT,
    TURN,
    YIELD,
    event_of,
    kind_of,
    stop_of,
)
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import Row
from vibroimpact.engine.motion import (
    BOTH,
    RELEASED,
    SLIPPED,
    Ended,
    Motion,
    changed,
    direction,
    main_stop,
)
from vibroimpact.engine.state import SETTLING
from vibroimpact.engine.stops.kelvin_voigt import rate_of, relaxed_faces
from vibroimpact.engine.stops.places import gap_of, place_at
from vibroimpact.engine.stops.rigid import rigid
from vibroimpact.engine.stops.rigid_events import impact, settle
from vibroimpact.engine.taylor.advance import still
from vibroimpact.engine.taylor.mode_forces import stands, way_of
from vibroimpact.engine.yielding.layout import ELASTIC, MOVES_LEFT, MOVES_RIGHT
from vibroimpact.engine.yielding.monotone_motion import (
    AHEAD,
    BEGUN,
    FROM_AHEAD,
    FROM_BEHIND,
    LANDED,
    SOFTLY,
    MotionLimits,
)
from vibroimpact.engine.yielding.plan import table_of
from vibroimpact.engine.yielding.table_walk import follow_leg


@kernel
def advance_yielding(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next event, or for the time `limit` if that comes first."""
    mode, fresh, u, v, faces, z, age, clock = motion
    if fresh & SETTLING:
        return settle(plan, motion, limit)
    if stands(plan, motion):
        return still(plan, motion, limit)
    way = way_of(plan, motion)
    # In the mode's coordinate; `about` is the place about which its tables have the motion.
    sign, pressed = direction(mode), main_stop(mode)
    at = par.stop_at(pressed)
    x = u
    stiffness, damping = 0.0, 0.0
    if mode:
        x = faces[pressed]
        stiffness, damping = plan[at + par.BUMPER_STIFFNESS], plan[at + par.BUMPER_DAMPING]
    hysteretic = plan[par.HYSTERETIC]
    branch = MOVES_RIGHT if way > 0.0 else MOVES_LEFT
    yields, about = math.inf, 0.0
    elastic = hysteretic != 0.0 and not (abs(z) >= plan[par.YIELD] and way * z > 0.0)
    slack = u - z  # where the element that yields would be relaxed
    ways = sign * way
    if elastic:
        branch = ELASTIC
        about = sign * hysteretic * slack / (plan[par.STIFFNESS] + hysteretic + stiffness)
    # Where it is, and from there how far to go: what is touched is touched without a rounding.
    here = ways * (x - about)
    if elastic:
        yields = here + (plan[par.YIELD] - way * z)
    stop, behind = math.inf, -math.inf
    memory, rate, behind_memory, behind_rate = 0.0, 0.0, 0.0, 0.0
    push_x, push_v, push_0 = 0.0, 0.0, 0.0
    start = BEGUN
    if fresh & (RELEASED | SLIPPED):
        start |= SOFTLY
    ahead = 0 if way > 0.0 else 1
    if not mode:
        far, back = gap_of(plan, ahead) - way * u, gap_of(plan, 1 - ahead) + way * u
        stop, memory, rate = here + far, faces[ahead], rate_of(plan, ahead)
        behind, behind_memory = here - back, faces[1 - ahead]
        behind_rate = rate_of(plan, 1 - ahead)
        if fresh & BOTH:
            start |= FROM_AHEAD if fresh & BOTH == 1 << ahead else FROM_BEHIND
    elif ways < 0.0:
        push_x, push_v, push_0 = -stiffness, -damping, stiffness * about
        if fresh & BOTH:
            start |= LANDED
    leg = MotionLimits(
        ways,
        stop,
        yields,
        memory,
        rate,
        behind,
        behind_memory,
        behind_rate,
        push_x,
        push_v,
        push_0,
    )
    row = Row(x - about, sign * v, sign * clock[0], sign * clock[1])
    end, t, row = follow_leg(plan, table_of(branch, mode), leg, row, start, limit)
    x, v, s, c = row
    x += about
    v, clock = sign * v, (sign * s, sign * c)
    kind = kind_of(end)
    if kind == DETACHMENT and damping == 0.0:
        x = 0.0
    faces = relaxed_faces(plan, mode, faces, t)
    u = x
    if mode:
        faces = changed(faces, pressed, x)
        u = place_at(plan, pressed, x)
    met = ahead if stop_of(end) == AHEAD else 1 - ahead
    if kind == CONTACT:
        u = place_at(plan, met, faces[met])
    if elastic:
        z = u - slack
    if kind == CONTACT:
        bit = 1 << met
        after = Motion(bit, bit, u, v, faces, z, 0.0, clock)
        if rigid(plan, met):
            return impact(plan, met, t, v, after)
        return event_of(CONTACT, met), t, v, after
    if kind == LIMIT:
        return LIMIT, t, v, Motion(mode, 0, u, v, faces, z, age + t, clock)
    if kind == DETACHMENT:
        return event_of(DETACHMENT, pressed), t, v, Motion(0, mode, u, v, faces, z, 0.0, clock)
    arrival = v
    if kind == TURN:
        v = 0.0
    elif kind == YIELD:
        z = math.copysign(plan[par.YIELD], way)
    return TURN, t, arrival, Motion(mode, 0, u, v, faces, z, 0.0, clock)
