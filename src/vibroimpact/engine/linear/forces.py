"""What pulls and presses the mass, per unit mass."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import value
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import RIGHT, Motion


@kernel
def isolator_force(plan: Vector, u: float, v: float, z: float) -> float:
    """What the isolator pulls back with."""
    force: float = plan[par.STIFFNESS] * u + plan[par.DAMPING] * v
    return force


@kernel
def springs(plan: Vector, motion: Motion) -> float:
    """Its stiffness."""
    stiffness: float = plan[par.STIFFNESS]
    return stiffness


@kernel
def acceleration_of(plan: Vector, motion: Motion) -> float:
    """Acceleration ü relative to the base, from the forces of the isolator and pressed bumpers."""
    s, c = motion.clock
    a: float = plan[par.LOAD] - plan[par.STIFFNESS] * motion.u - plan[par.DAMPING] * motion.v
    a -= value(plan, s, c)
    for side in range(1, 3):
        at = par.BUMPER + par.WIDTH * (side - 1)
        if motion.mode & side and plan[at + par.KIND] == par.KELVIN_VOIGT:
            sign = 1.0 if side == RIGHT else -1.0
            deformation = motion.right if side == RIGHT else motion.left
            a -= sign * plan[at + par.BUMPER_STIFFNESS] * deformation
            a -= plan[at + par.BUMPER_DAMPING] * motion.v
    return a


@kernel
def face(plan: Vector, motion: Motion, side: int) -> float:
    """How far the stop on a side is deformed (m)."""
    return motion.right if side == RIGHT else motion.left


@kernel
def stop_push(plan: Vector, motion: Motion, side: int) -> float:
    """What a pressed bumper pushes with, away from it."""
    at = par.BUMPER + par.WIDTH * (side - 1)
    closing = motion.v if side == RIGHT else -motion.v
    push: float = plan[at + par.BUMPER_STIFFNESS] * face(plan, motion, side)
    push += plan[at + par.BUMPER_DAMPING] * closing
    return push


@kernel
def stop_power(plan: Vector, motion: Motion, side: int) -> float:
    """What a pressed bumper loses, per unit mass and time."""
    damping: float = plan[par.BUMPER + par.WIDTH * (side - 1) + par.BUMPER_DAMPING]
    return damping * motion.v * motion.v


@kernel
def unkept(plan: Vector, before: Motion, after: Motion, side: int) -> float:
    """What a stop loses besides: no bumper has anything that its dashpot does not take."""
    return 0.0


@kernel
def isolator_power(plan: Vector, motion: Motion) -> float:
    """What the isolator loses, per unit mass and time."""
    damping: float = plan[par.DAMPING]
    return damping * motion.v * motion.v


@kernel
def rest_level(plan: Vector, motion: Motion, side: int) -> float:
    """What presses a resting mass on the rigid stop of a side, but for what shakes it."""
    s, c = motion.clock
    push: float = acceleration_of(plan, motion) + value(plan, s, c)
    return push if side == RIGHT else -push
