"""A mode's own coordinate, and which analytic piece of each law holds there.

In flight the coordinate is the displacement; pressed on one side it is that stop's deformation,
measured towards the stop, as between tables: what is pressed on the left is seen in the mirror,
isolator included, since every law is odd.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import value
from vibroimpact.engine.jit import Vector, inlined, kernel, not_inlined
from vibroimpact.engine.linear.layout import MOST
from vibroimpact.engine.motion import (
    BOTH,
    RELEASED,
    RIGHT,
    SLIPPED,
    SLIPS,
    Motion,
    direction,
    facing,
    main_stop,
)
from vibroimpact.engine.series.kernels import Slot, run
from vibroimpact.engine.series.layout import OWN_FORCE
from vibroimpact.engine.series.values import Branch, Frame
from vibroimpact.engine.stops import kelvin_voigt
from vibroimpact.engine.stops.curved import curved_stop, depth_of, own_push, push_of, stop_force
from vibroimpact.engine.stops.rigid import resting
from vibroimpact.engine.taylor.plan import motion_rate

_OWN = int(Slot.OWN)

_CREEP = 2.0**-36
"""Of a velocity: what a strong drag leaves of it where the forces on the mass change their sign."""

_ROUNDING = 1e-15
"""Of forces that balance, as a share of what shakes the mass."""


@kernel
def frame_of(plan: Vector, mode: int) -> Frame:
    """The coordinate of a mode, with the springs and dashpots that act in it."""
    k, c = plan[par.STIFFNESS], plan[par.DAMPING]
    if plan[par.DRAG] != 1.0:
        c = 0.0
    if not mode:
        return Frame(1.0, 0.0, k, c, plan[par.LOAD])
    sign, at = direction(mode), par.stop_at(main_stop(mode))
    offset = plan[at + par.GAP]
    load = sign * plan[par.LOAD] - k * offset
    if plan[at + par.KIND] == par.KELVIN_VOIGT:
        k += plan[at + par.BUMPER_STIFFNESS]
        c += plan[at + par.BUMPER_DAMPING]
    if mode == BOTH:
        other = par.stop_at(1)
        if plan[other + par.KIND] == par.KELVIN_VOIGT:
            k += plan[other + par.BUMPER_STIFFNESS]
            c += plan[other + par.BUMPER_DAMPING]
            load -= plan[other + par.BUMPER_STIFFNESS] * (offset + plan[other + par.GAP])
    return Frame(sign, offset, k, c, load)


@kernel
def isolator_force(plan: Vector, u: float, v: float, z: float) -> float:
    """What the isolator pulls back with but for friction, per unit mass (m/s²)."""
    squared = u * u
    force = (plan[par.STIFFNESS] + (plan[par.CUBIC] + plan[par.QUINTIC] * squared) * squared) * u
    if plan[par.SINH] != 0.0:
        force += 2.0 * plan[par.SINH] * math.sinh(plan[par.SINH_RATE] * u)
    if plan[par.DRAG] == 1.0:
        force += plan[par.DAMPING] * v
    elif v != 0.0:
        force += math.copysign(plan[par.DAMPING] * abs(v) ** plan[par.DRAG], v)
    if plan[par.OWN] != 0.0:
        force += own_force(plan, u, v)[0]
    total: float = force + plan[par.HYSTERETIC] * z
    return total


@not_inlined
def own_force(plan: Vector, u: float, v: float) -> tuple[float, float, float]:
    """What an isolator's own formula pulls back with, and its slopes by u and u̇, per unit mass."""
    way, side = math.copysign(1.0, v), math.copysign(1.0, u)
    run(plan, _OWN, u, v, 0.0, side, way, 0.0, 0.0)
    return plan[OWN_FORCE], plan[OWN_FORCE + 1], plan[OWN_FORCE + 2]


@kernel
def springs(plan: Vector, motion: Motion) -> float:
    """A bound on its tangent stiffness here, per unit mass."""
    return stiffness_at(plan, motion.u)


@inlined
def stiffness_at(plan: Vector, u: float) -> float:
    """A bound on its tangent stiffness at a displacement, per unit mass."""
    squared = u * u
    k: float = plan[par.STIFFNESS] + plan[par.HYSTERETIC]
    k += 3.0 * abs(plan[par.CUBIC]) * squared + 5.0 * abs(plan[par.QUINTIC]) * squared * squared
    if plan[par.SINH] != 0.0:
        rate = plan[par.SINH_RATE]
        k += 2.0 * abs(plan[par.SINH] * rate) * math.cosh(rate * u)
    if plan[par.OWN] != 0.0:
        k += abs(own_force(plan, u, 0.0)[1])
    return max(k, 0.0)


@kernel
def without_friction(plan: Vector, motion: Motion) -> float:
    """Acceleration ü relative to the base, from all forces but Coulomb's."""
    mode, _, u, v, faces, z, _, clock = motion
    a: float = plan[par.LOAD] - isolator_force(plan, u, v, z) - value(plan, clock[0], clock[1])
    for stop in range(2):
        if not mode >> stop & 1:
            continue
        at = par.stop_at(stop)
        sign = facing(stop)
        memory = faces[stop]
        if plan[at + par.KIND] == par.KELVIN_VOIGT:
            a = kelvin_voigt.slowed(plan, stop, a, memory, v)
        elif curved_stop(plan, stop):
            push = push_of(plan, stop, sign * v, memory)
            a -= sign * stop_force(plan, stop, push, sign * u - plan[at + par.GAP], sign * v)
    return a


@kernel
def creep(plan: Vector) -> float:
    """A velocity that leaves no trace: a share of those that the shaking makes (m/s)."""
    return _CREEP * plan[MOST] / motion_rate(plan)  # type: ignore[no-any-return]


@kernel
def steep(plan: Vector) -> bool:
    """Whether there is a drag of an exponent below 1: infinitely stiff where the mass stands."""
    return bool(plan[par.DRAG] < 1.0 and plan[par.DAMPING] != 0.0)


@kernel
def grip(plan: Vector) -> float:
    """Up to which force a mass that stands is held, per unit mass (m/s²).

    That of friction; and under less than what a steep drag pulls with at `creep` the mass would
    never be faster than that.
    """
    held: float = plan[par.FRICTION]
    if steep(plan):
        held += plan[par.DAMPING] * creep(plan) ** plan[par.DRAG]
    return held


@kernel
def stuck(plan: Vector, motion: Motion) -> bool:
    """Whether friction holds the mass, or a drag that no force overcomes."""
    if motion.v != 0.0 or motion.fresh & SLIPPED:
        return False
    if plan[par.FRICTION] == 0.0 and not steep(plan):
        return False
    return bool(abs(without_friction(plan, motion)) <= grip(plan))


@kernel
def rounding(plan: Vector, motion: Motion) -> float:
    """How far rounding may be from a balance of the forces on the mass, per unit mass (m/s²)."""
    size: float = plan[par.STIFFNESS] * abs(motion.u) + plan[par.HYSTERETIC] * abs(motion.z)
    size += abs(plan[par.LOAD]) + abs(value(plan, motion.clock[0], motion.clock[1]))
    for stop in range(2):
        if motion.mode >> stop & 1:
            size += stop_rounding(plan, motion, stop)
    return _ROUNDING * size


@kernel
def idle(plan: Vector, motion: Motion) -> bool:
    """Whether an isolator that yields has come to rest: it stands, and forces cancel to rounding.

    It may rest anywhere. Rounding alone would turn it again and again, without end.
    """
    if motion.v != 0.0 or plan[par.HYSTERETIC] == 0.0:
        return False
    if motion.fresh & (SLIPPED | RELEASED):
        return False
    return bool(abs(without_friction(plan, motion)) < rounding(plan, motion))


@inlined
def stands(plan: Vector, motion: Motion) -> bool:
    """Whether the mass stays: on a rigid stop, by friction, or at rest with balanced forces."""
    return resting(plan, motion.mode) or stuck(plan, motion) or idle(plan, motion)


@kernel
def creeps(plan: Vector, motion: Motion) -> bool:
    """Whether a drag is about to hold a mass that is slower than leaves a trace."""
    if not steep(plan) or motion.v == 0.0 or abs(motion.v) > creep(plan):
        return False
    mode, _, u, _, faces, z, age, clock = motion
    standing = Motion(mode, 0, u, 0.0, faces, z, age, clock)
    # By half of the drag's grip, or rounding would hold again what was just let go of.
    most = 0.5 * (plan[par.FRICTION] + grip(plan))
    return bool(abs(without_friction(plan, standing)) <= most)


@kernel
def acceleration_of(plan: Vector, motion: Motion) -> float:
    """Acceleration ü relative to the base, from all forces."""
    if stuck(plan, motion):
        return 0.0
    a = without_friction(plan, motion)
    if plan[par.FRICTION] == 0.0:
        return a
    return a - plan[par.FRICTION] * way_of(plan, motion)  # type: ignore[no-any-return]


@not_inlined
def way_of(plan: Vector, motion: Motion) -> float:
    """The sign of u̇, now or at once: where it is zero, that of ü, and then that of −A_t′."""
    if motion.v != 0.0:
        return math.copysign(1.0, motion.v)
    if motion.fresh & RELEASED:  # ü is zero but for rounding
        return -1.0 if motion.fresh & RIGHT else 1.0
    if motion.fresh & SLIPPED:
        return 1.0 if motion.fresh & SLIPS else -1.0
    a = -changes(plan, motion) if balanced(plan, motion) else without_friction(plan, motion)
    return math.copysign(1.0, a)


@kernel
def changes(plan: Vector, motion: Motion) -> float:
    """How much the base's acceleration changes in a moment; only its sign is of use."""
    s, c = motion.clock
    before: float = value(plan, s, c)
    after: float = value(plan, s + 1e-8 * c, c - 1e-8 * s)
    return after - before


@kernel
def balanced(plan: Vector, motion: Motion) -> bool:
    """Whether the forces but for friction are zero to rounding.

    A stiff stop turns the rounding of a displacement into a force, which counts. While the shaking
    changes, its own rounding counts, too.
    """
    if changes(plan, motion) == 0.0:
        return bool(abs(without_friction(plan, motion)) <= rounding(plan, motion))
    size: float = plan[MOST] + abs(plan[par.LOAD])
    for stop in range(2):
        if motion.mode >> stop & 1 and curved_stop(plan, stop):
            size += stop_rounding(plan, motion, stop)
    return bool(abs(without_friction(plan, motion)) <= _ROUNDING * size)


@kernel
def stop_rounding(plan: Vector, motion: Motion, stop: int) -> float:
    """Force of a pressed stop, of which its deformation's rounding is the same share (m/s²)."""
    at = par.stop_at(stop)
    slope: float = plan[at + par.BUMPER_STIFFNESS]
    if plan[at + par.KIND] == par.FORMULA:
        slope = abs(own_push(plan, stop, depth_of(plan, motion, stop), 0.0)[1])
    elif curved_stop(plan, stop):
        exponent = plan[at + par.EXPONENT]
        slope *= exponent * depth_of(plan, motion, stop) ** (exponent - 1.0)
    size: float = max(abs(motion.u), abs(plan[at + par.GAP]))
    return slope * size


@not_inlined
def branch_of(plan: Vector, motion: Motion, sign: float) -> Branch:
    """The branch of the law, in the frame with this sign."""
    way = way_of(plan, motion)
    z = motion.z
    there = sign * (math.copysign(1.0, motion.u) if motion.u != 0.0 else way)
    if plan[par.HYSTERETIC] == 0.0:
        return Branch(0.0, 0.0, sign * way, there)
    if abs(z) >= plan[par.YIELD] and way * z > 0.0:
        return Branch(0.0, 0.0, sign * way, there)
    side = math.copysign(1.0, z) if z != 0.0 else way
    if int(plan[par.SHARPNESS]) % 2 == 1:
        # |z|ⁿ = s_z zⁿ; the frame turns z, and zⁿ with it.
        bend = sign * (plan[par.KNEE] * side + plan[par.TURNING] * way)
    else:
        bend = plan[par.KNEE] + plan[par.TURNING] * way * side
    return Branch(plan[par.SLOPE], bend, sign * way, there)


@kernel
def stop_deformation(plan: Vector, motion: Motion, stop: int) -> float:
    """How far a stop is deformed (m)."""
    if curved_stop(plan, stop):
        return depth_of(plan, motion, stop)
    return motion.faces[stop]


@kernel
def stop_push(plan: Vector, motion: Motion, stop: int) -> float:
    """What a pressed stop pushes with, away from it, per unit mass (m/s²)."""
    closing = facing(stop) * motion.v
    memory = motion.faces[stop]
    if curved_stop(plan, stop):
        law = push_of(plan, stop, closing, memory)
        return stop_force(plan, stop, law, depth_of(plan, motion, stop), closing)
    return kelvin_voigt.push(plan, stop, memory, closing)
