"""What an event does to small disturbances of a motion (see `tangent`)."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine import saltation
from vibroimpact.engine.event import IMPACT, kind_of, stop_of
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import LEFT, RIGHT, Motion, arrived
from vibroimpact.engine.one_mass.forces import acceleration_of
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.engine.stops.rigid import rebound_at

DISTURBANCE = ONE_MASS.total
"""Components: displacement, velocity, right and left bumper, signed as in the paper (eq. 3), and
what the isolator remembers."""

MEMORY = ONE_MASS.of_point.memory()


@kernel
def tie(mode: int, q: Vector, at: int) -> None:
    """A pressed bumper's disturbance is that of the displacement."""
    if mode & RIGHT:
        q[at + 2] = q[at]
    if mode & LEFT:
        q[at + 3] = q[at]


@kernel
def meet(plan: Vector, event: int, arrival: float, after: Motion, q: Vector, rows: int) -> None:
    """Let disturbances (rows of q) meet a rigid stop, or one of a spring and a dashpot."""
    number = stop_of(event)
    stop = par.stop_at(number)
    if kind_of(event) != IMPACT:
        for i in range(rows):
            at = i * DISTURBANCE
            saltation.contact(q, at, at + 2 + number, plan[stop + par.BUMPER_DAMPING])
        return
    mode = after.mode
    before = acceleration_of(plan, arrived(mode, arrival, after))
    behind = acceleration_of(plan, after)
    for i in range(rows):
        at = i * DISTURBANCE
        if mode >> number & 1:
            saltation.rest(q, at)
        else:
            saltation.impact(q, at, rebound_at(plan, number, arrival), arrival, before, behind)
        tie(mode, q, at)


@kernel
def contraction(plan: Vector, event: int, arrival: float, after: Motion) -> float:
    """Minus the logarithm of the area that an event leaves of (u, u̇): e r′ at an impact."""
    if kind_of(event) != IMPACT:
        return 0.0
    stop = stop_of(event)
    e, order, _ = rebound_at(plan, stop, arrival)
    if after.mode >> stop & 1 or e == 0.0:
        return math.inf
    return -2.0 * math.log(e) - math.log(order)
