"""A bumper of a spring and a dashpot, which pushes only: let go, its deformation relaxes."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.layout import FORGOTTEN, Row
from vibroimpact.engine.motion import LEFT, RIGHT, Motion, Pair, facing


@inlined
def rate_of(plan: Vector, stop: int) -> float:
    """Rate at which the free stop relaxes (1/s)."""
    return plan[par.stop_at(stop) + par.RATE]  # type: ignore[no-any-return]


@kernel
def complete(plan: Vector, stop: int) -> None:
    """Write the rate of a stop whose stiffness or damping has been varied."""
    at = par.stop_at(stop)
    if plan[at + par.KIND] == par.KELVIN_VOIGT and plan[at + par.BUMPER_DAMPING] > 0.0:
        plan[at + par.RATE] = plan[at + par.BUMPER_STIFFNESS] / plan[at + par.BUMPER_DAMPING]


@kernel
def push(plan: Vector, stop: int, deformation: float, closing: float) -> float:
    """What it pushes with while it is pressed, per unit mass (m/s²)."""
    at = par.stop_at(stop)
    force: float = plan[at + par.BUMPER_STIFFNESS] * deformation
    force += plan[at + par.BUMPER_DAMPING] * closing
    return force


@kernel
def slowed(plan: Vector, stop: int, a: float, deformation: float, v: float) -> float:
    """An acceleration of the mass with that of its push added (m/s²)."""
    at = par.stop_at(stop)
    a -= facing(stop) * plan[at + par.BUMPER_STIFFNESS] * deformation
    a -= plan[at + par.BUMPER_DAMPING] * v
    return a


@kernel
def power(plan: Vector, stop: int, speed: float) -> float:
    """What its dashpot takes while it is pressed, per unit mass."""
    damping: float = plan[par.stop_at(stop) + par.BUMPER_DAMPING]
    return damping * speed * speed


@kernel
def placed(
    plan: Vector, stop: int, mode: int, u: float, v: float, deformation: float
) -> tuple[float, bool]:
    """The deformation of a bumper beside a mass, and whether it is pressed."""
    at, sign = par.stop_at(stop), facing(stop)
    reach = sign * u - plan[at + par.GAP]
    pressed = False
    if mode >> stop & 1 or reach > deformation:
        force = push(plan, stop, reach, sign * v)
        deformation = max(reach, 0.0)
        pressed = bool(reach >= 0.0 and force >= 0.0)
    if plan[at + par.BUMPER_DAMPING] == 0.0 and not pressed:
        deformation = 0.0
    return deformation, pressed


@kernel
def relaxed(deformation: float, rate: float, t: float) -> float:
    """A free bumper's deformation after the time t."""
    if deformation > 0.0:
        x = rate * t
        return deformation * math.exp(-x) if x < FORGOTTEN else 0.0
    return 0.0


@kernel
def comes_back(deformation: float, depth: float, rate: float) -> float:
    """When a free bumper has relaxed to a depth above 0, and meets the mass that stands there."""
    return math.log(deformation / depth) / rate if deformation > depth else 0.0


@inlined
def relaxed_faces(plan: Vector, mode: int, faces: Pair, t: float) -> Pair:
    """Deformations of the stops after the time t, in which those that are not touched relax."""
    right, left = faces
    if not mode & RIGHT:
        right = relaxed(right, rate_of(plan, 0), t)
    if not mode & LEFT:
        left = relaxed(left, rate_of(plan, 1), t)
    return right, left


@inlined
def relieved(row: Row, damping: float) -> Row:
    """Where the force is zero; without a dashpot so is the deformation, exactly."""
    x, v, s, c = row
    return Row(0.0 if damping == 0.0 else x, v, s, c)


@kernel
def relaxed_loss(plan: Vector, stop: int, before: float, after: float) -> float:
    """What a free bumper loses that relaxes from one deformation to the other."""
    at = par.stop_at(stop)
    if plan[at + par.KIND] != par.KELVIN_VOIGT:
        return 0.0
    stiffness: float = plan[at + par.BUMPER_STIFFNESS]
    return 0.5 * stiffness * (before * before - after * after)


@kernel
def closing_speed(plan: Vector, stop: int, velocity: float, after: Motion) -> float:
    """How fast a stop and the mass approach each other; a free bumper relaxes towards the mass."""
    at = par.stop_at(stop)
    closing = facing(stop) * velocity
    if plan[at + par.KIND] == par.KELVIN_VOIGT and plan[at + par.BUMPER_DAMPING] > 0.0:
        rate = plan[at + par.BUMPER_STIFFNESS] / plan[at + par.BUMPER_DAMPING]
        closing += rate * after.faces[stop]
    return closing
