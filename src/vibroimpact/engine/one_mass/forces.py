# mypy: disable-error-code="empty-body"
"""What acts on the mass, and what it loses, whichever flow carries it."""

from __future__ import annotations

from vibroimpact.engine.dispatch import by_laws
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.linear import forces, tables
from vibroimpact.engine.motion import Motion
from vibroimpact.engine.taylor import laws, mode_forces, power
from vibroimpact.engine.taylor import plan as taylor


@by_laws(tables.stiff_rate, taylor.stiff_rate)
def stiff_rate(plan: Vector) -> float:
    """What makes a velocity of a displacement (1/s)."""


@by_laws(forces.acceleration_of, mode_forces.acceleration_of)
def acceleration_of(plan: Vector, motion: Motion) -> float:
    """ü from all forces."""


@by_laws(forces.isolator_force, mode_forces.isolator_force)
def isolator_force(plan: Vector, u: float, v: float, z: float) -> float:
    """What the isolator pulls back with but for friction, per unit mass."""


@by_laws(forces.springs, mode_forces.springs)
def springs(plan: Vector, motion: Motion) -> float:
    """A bound on the isolator's tangent stiffness, per unit mass; exact where laws are linear."""


@by_laws(forces.stop_deformation, mode_forces.stop_deformation)
def stop_deformation(plan: Vector, motion: Motion, stop: int) -> float:
    """How far a stop is deformed (m)."""


@by_laws(forces.stop_push, mode_forces.stop_push)
def stop_push(plan: Vector, motion: Motion, stop: int) -> float:
    """What a pressed stop pushes with, per unit mass, away from it."""


@by_laws(forces.stop_power, power.stop_power)
def stop_power(plan: Vector, motion: Motion, stop: int) -> float:
    """What a pressed stop loses, per unit mass and time."""


@by_laws(forces.isolator_power, power.isolator_power)
def isolator_power(plan: Vector, motion: Motion) -> float:
    """What the isolator loses, per unit mass and time."""


@by_laws(forces.unreturned_energy, laws.unreturned_energy)
def unreturned_energy(plan: Vector, before: Motion, after: Motion, stop: int) -> float:
    """What a stop loses that has ceased to push, per unit mass."""


@by_laws(forces.rest_level, power.rest_level)
def rest_level(plan: Vector, motion: Motion, stop: int) -> float:
    """What presses a resting mass on its rigid stop, but for what shakes it, per unit mass.

    Friction holds first.
    """
