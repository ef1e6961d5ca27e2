"""An assembly with what shakes it as the engine's vector."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.assembly import layout
from vibroimpact.engine.assembly.plan import (
    Forcing,
    Stop,
    base_motion,
    make_vector,
    partners,
    record_motion,
)
from vibroimpact.engine.state import LARGEST
from vibroimpact.errors import InputError
from vibroimpact.model import Assembly, Bumper, Periodic, Record, Repeated, RigidStop
from vibroimpact.model.assembly import numbers

_Array = NDArray[np.float64]


def check_laws(assembly: Assembly) -> None:
    """Raise an error if a law of the assembly is none that the flow of several masses has.

    Raises
    ------
    InputError
        If a link is curved, a stop is neither a `Bumper` nor a `RigidStop`, or there are too many.
    """
    for name, link in assembly.links.items():
        if not link.law.linear:
            raise InputError(
                f"links.{name}: an Assembly may have linear links so far, not a "
                f"{type(link.law).__name__}; use Isolator(stiffness, damping)"
            )
    for name, stop in assembly.stops.items():
        if not isinstance(stop.law, Bumper | RigidStop):
            raise InputError(
                f"stops.{name}: an Assembly may have bumpers and rigid stops so far, "
                f"not a {type(stop.law).__name__}; use Bumper(stiffness, damping, gap) or "
                "RigidStop(restitution, gap)"
            )
    if len(assembly.stops) > layout.MOST_STOPS:
        raise InputError(
            f"stops: {len(assembly.stops)} stops; at most {layout.MOST_STOPS} are possible"
        )


def check_size(assembly: Assembly) -> None:
    """Raise an error if an assembly has more parts than the engine's maps have room for.

    Raises
    ------
    InputError
        If so; `simulate` has no such limit.
    """
    parts = 2 * len(assembly.names) + len(assembly.stops)
    if parts > LARGEST:
        raise InputError(
            f"rig: {len(assembly.names)} masses and {len(assembly.stops)} stops; twice the number "
            f"of masses plus the number of stops is at most {LARGEST} here; use simulate"
        )


def assembly_numbers(
    assembly: Assembly, shaking: Repeated | Record, *, tables: bool = False
) -> _Array:
    """Return an assembly that is shaken as the engine's vector.

    With `tables`, contact modes that come again are faster, and a motion that is computed in parts
    may differ in its last digits.
    """
    check_laws(assembly)
    of = numbers(assembly)
    stops = _stops(assembly)
    forcing = _forcing(assembly, shaking, of.mass, of.influence)
    return make_vector(
        of.mass, of.damping, of.stiffness, stops, forcing, of.force, tables, of.influence
    )


def _stops(assembly: Assembly) -> list[Stop]:
    return [
        Stop(
            part.left,
            part.right,
            part.gap,
            part.values.get("stiffness", 0.0),
            part.values.get("damping", 0.0),
            part.values.get("restitution") if part.kind == RigidStop.kind else None,
        )
        for part in numbers(assembly).stops
    ]


def assembly_partners(assembly: Assembly) -> list[int]:
    """Return of each stop the one that is its mirror image, −1 if there is none."""
    return [int(other) for other in partners(_stops(assembly))]


def _forcing(
    assembly: Assembly, shaking: Repeated | Record, mass: _Array, influence: _Array
) -> Forcing:
    if isinstance(shaking, Record):
        return record_motion(mass, influence, shaking.step)
    harmonics = [(1.0, 0.0)]
    if isinstance(shaking, Periodic):
        sizes = [one / shaking.amplitude for one in shaking.amplitudes]
        harmonics = list(zip(sizes, shaking.phases, strict=True))
    power = 2 if shaking.grows_with_frequency else 0
    sign = -1.0 if shaking.of == "displacement" else 1.0
    # A displacement or an unbalance of harmonic n grows as (n ω)².
    scaled = [
        (sign * size * float(order) ** power, turn)
        for order, (size, turn) in enumerate(harmonics, 1)
    ]
    if shaking.moves_base:
        return base_motion(mass, influence, scaled)._replace(power=power)
    columns = [size * part for size, turn in scaled for part in (math.cos(turn), math.sin(turn))]
    on = assembly.names.index(shaking.on or assembly.names[0])
    return Forcing(np.outer(np.eye(len(assembly.names))[on], columns), power)
