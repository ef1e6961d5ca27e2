"""From one event to the next for an isolator that yields or slides, by tables.

Between two turns friction is a constant load, and so is the force of what has yielded; until it
yields it is a spring about another place. The motion is then that of linear laws.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.advance import Ended, bumpers
from vibroimpact.engine.linear.evaluate import relaxed
from vibroimpact.engine.linear.stops import impact, rigid, settle
from vibroimpact.engine.motion import (
    BOTH,
    DETACHED,
    LEFT,
    RELEASED,
    RIGHT,
    SETTLING,
    SLIPS_LEFT,
    SLIPS_RIGHT,
    TURNED,
    Motion,
    Row,
)
from vibroimpact.engine.motion import LIMIT as NOTHING
from vibroimpact.engine.taylor.advance import still
from vibroimpact.engine.taylor.frame import stands, way_of
from vibroimpact.engine.yielding.layout import ELASTIC, MOVES_LEFT, MOVES_RIGHT
from vibroimpact.engine.yielding.leg import (
    BEGUN,
    BEHIND,
    FROM_AHEAD,
    FROM_BEHIND,
    LANDED,
    LIMIT,
    PARTS,
    SOFTLY,
    STOPS,
    TURNS,
    YIELDS,
    Leg,
)
from vibroimpact.engine.yielding.plan import table_of
from vibroimpact.engine.yielding.walk import go


@kernel
def advance_yielding(plan: Vector, motion: Motion, limit: float) -> Ended:
    """Go on to the next event, or for the time `limit` if that comes first."""
    mode, fresh, u, v, right, left, z, age, clock = motion
    if fresh & SETTLING:
        return settle(plan, motion, limit)
    if stands(plan, motion):
        return still(plan, motion, limit)
    way = way_of(plan, motion)
    gap_r, gap_l, rate_r, rate_l = bumpers(plan)
    # In the mode's coordinate; `about` is the place about which its tables have the motion.
    sign = -1.0 if mode == LEFT else 1.0
    side = LEFT if mode == LEFT else RIGHT
    at = par.BUMPER + par.WIDTH * (side - 1)
    x = u
    stiffness, damping = 0.0, 0.0
    if mode:
        x = left if mode == LEFT else right
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
    if fresh & (RELEASED | SLIPS_RIGHT | SLIPS_LEFT):
        start |= SOFTLY
    ahead = RIGHT if way > 0.0 else LEFT
    if not mode:
        if way > 0.0:
            stop, memory, rate = here + (gap_r - u), right, rate_r
            behind, behind_memory, behind_rate = here - (gap_l + u), left, rate_l
        else:
            stop, memory, rate = here + (gap_l + u), left, rate_l
            behind, behind_memory, behind_rate = here - (gap_r - u), right, rate_r
        if fresh & BOTH:
            start |= FROM_AHEAD if fresh & BOTH == ahead else FROM_BEHIND
    elif ways < 0.0:
        push_x, push_v, push_0 = -stiffness, -damping, stiffness * about
        if fresh & BOTH:
            start |= LANDED
    leg = Leg(
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
    end, t, row = go(plan, table_of(branch, mode), leg, row, start, limit)
    x, v, s, c = row
    x += about
    v, clock = sign * v, (sign * s, sign * c)
    if end == PARTS and damping == 0.0:
        x = 0.0
    if mode != RIGHT:
        right = relaxed(right, rate_r, t)
    if mode != LEFT:
        left = relaxed(left, rate_l, t)
    if mode == RIGHT:
        right, u = x, gap_r + x
    elif mode == LEFT:
        left, u = x, -(gap_l + x)
    else:
        u = x
    event = NOTHING
    if end in (STOPS, BEHIND):
        event = ahead if end == STOPS else BOTH - ahead
        u = gap_r + right if event == RIGHT else -(gap_l + left)
    if elastic:
        z = u - slack
    if event != NOTHING:
        after = Motion(event, event, u, v, right, left, z, 0.0, clock)
        if rigid(plan, event):
            return impact(plan, event, t, v, after)
        return event, t, v, after
    if end == LIMIT:
        return NOTHING, t, v, Motion(mode, 0, u, v, right, left, z, age + t, clock)
    if end == PARTS:
        return DETACHED, t, v, Motion(mode & ~side, side, u, v, right, left, z, 0.0, clock)
    arrival = v
    if end == TURNS:
        v = 0.0
    elif end == YIELDS:
        z = math.copysign(plan[par.YIELD], way)
    return TURNED, t, arrival, Motion(mode, 0, u, v, right, left, z, 0.0, clock)
