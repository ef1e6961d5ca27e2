"""A rigid stop: it returns the mass by its law of rebound, or the mass rests on it."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import IMPACT, event_of
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import LEFT, RIGHT, Stretch, facing
from vibroimpact.engine.stops.places import gap_of
from vibroimpact.engine.stops.rebound import Rebound, rebound


@kernel
def rigid(plan: Vector, stop: int) -> bool:
    """Whether a stop is rigid."""
    return bool(plan[par.stop_at(stop) + par.KIND] == par.RIGID)


@kernel
def rebound_at(plan: Vector, stop: int, v: float) -> Rebound:
    """What a rigid stop makes of a velocity."""
    law: Rebound = rebound(plan, par.stop_at(stop) + par.REBOUND, abs(v))
    return law


@kernel
def resting(plan: Vector, mode: int) -> bool:
    """Whether a rigid stop holds the mass in this mode."""
    return bool((mode & RIGHT and rigid(plan, 0)) or (mode & LEFT and rigid(plan, 1)))


@kernel
def nearest_possible(plan: Vector, stop: int, mode: int, u: float, v: float) -> tuple[float, bool]:
    """The displacement of a mass that no rigid stop lets through, and whether it rests there."""
    sign = facing(stop)
    reach = sign * u - gap_of(plan, stop)
    if reach > 0.0:
        u = sign * gap_of(plan, stop)
    return u, bool(mode >> stop & 1 and reach >= 0.0 and v == 0.0)


@kernel
def struck(stretch: Stretch, stop: int) -> float:
    """How much an impact on a rigid stop changes the velocity (m/s); 0 without one."""
    if stretch.event != event_of(IMPACT, stop):
        return 0.0
    return abs(stretch.arrival - stretch.after.v)
