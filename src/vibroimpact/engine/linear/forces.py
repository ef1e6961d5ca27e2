"""What pulls and presses the mass, per unit mass."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import value
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import Motion, facing
from vibroimpact.engine.stops import kelvin_voigt


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
    for stop in range(2):
        at = par.stop_at(stop)
        if motion.mode >> stop & 1 and plan[at + par.KIND] == par.KELVIN_VOIGT:
            a = kelvin_voigt.slowed(plan, stop, a, motion.faces[stop], motion.v)
    return a


@kernel
def stop_deformation(plan: Vector, motion: Motion, stop: int) -> float:
    """How far a stop is deformed (m)."""
    return motion.faces[stop]


@kernel
def stop_push(plan: Vector, motion: Motion, stop: int) -> float:
    """What a pressed bumper pushes with, away from it."""
    return kelvin_voigt.push(plan, stop, motion.faces[stop], facing(stop) * motion.v)


@kernel
def stop_power(plan: Vector, motion: Motion, stop: int) -> float:
    """What a pressed bumper loses, per unit mass and time."""
    return kelvin_voigt.power(plan, stop, motion.v)


@kernel
def unreturned_energy(plan: Vector, before: Motion, after: Motion, stop: int) -> float:
    """What a stop loses besides: no bumper has anything that its dashpot does not take."""
    return 0.0


@kernel
def isolator_power(plan: Vector, motion: Motion) -> float:
    """What the isolator loses, per unit mass and time."""
    damping: float = plan[par.DAMPING]
    return damping * motion.v * motion.v


@kernel
def rest_level(plan: Vector, motion: Motion, stop: int) -> float:
    """What presses a resting mass on the rigid stop of a side, but for what shakes it."""
    s, c = motion.clock
    push: float = acceleration_of(plan, motion) + value(plan, s, c)
    return facing(stop) * push
