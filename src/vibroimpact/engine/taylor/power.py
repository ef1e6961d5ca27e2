"""Power of stop and isolator forces, and the level at which friction rests."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import value
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import Motion, facing
from vibroimpact.engine.stops import kelvin_voigt
from vibroimpact.engine.stops.curved import curved_stop, depth_of, spring
from vibroimpact.engine.taylor.mode_forces import (
    branch_of,
    own_force,
    stop_push,
    without_friction,
)


@kernel
def stop_power(plan: Vector, motion: Motion, stop: int) -> float:
    """What a stop that pushes loses, per unit mass and time: what it takes and does not keep."""
    closing = facing(stop) * motion.v
    if not curved_stop(plan, stop):
        return kelvin_voigt.power(plan, stop, closing)
    push = stop_push(plan, motion, stop)
    if push == 0.0:
        return 0.0
    lost: float = (push - spring(plan, stop, depth_of(plan, motion, stop))) * closing
    return lost


@kernel
def isolator_power(plan: Vector, motion: Motion) -> float:
    """What the isolator loses, per unit mass and time.

    Drag, friction, and of the spring that yields in series what it does not keep.
    """
    v = motion.v
    if v == 0.0:
        return 0.0
    power = plan[par.DAMPING] * abs(v) ** (plan[par.DRAG] + 1.0) + plan[par.FRICTION] * abs(v)
    if plan[par.OWN] != 0.0:
        power += v * (own_force(plan, motion.u, v)[0] - own_force(plan, motion.u, 0.0)[0])
    if plan[par.HYSTERETIC] != 0.0:
        branch = branch_of(plan, motion, 1.0)
        kept = (branch.slope - branch.bend * motion.z ** int(plan[par.SHARPNESS])) / plan[par.SLOPE]
        power += plan[par.HYSTERETIC] * motion.z * v * (1.0 - kept)
    return power  # type: ignore[no-any-return]


@kernel
def rest_level(plan: Vector, motion: Motion, stop: int) -> float:
    """What presses a resting mass on the rigid stop of a side, but for what shakes it.

    Friction holds first.
    """
    s, c = motion.clock
    push: float = without_friction(plan, motion) + value(plan, s, c)
    pressed: float = facing(stop) * push - plan[par.FRICTION]
    return pressed
