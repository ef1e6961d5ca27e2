"""An assembly with what shakes it as the engine's vector."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.assembly import layout
from vibroimpact.engine.assembly.curved.laws import link_rows, stop_law
from vibroimpact.engine.assembly.curved.layout import BILINEAR, HYSTERETIC
from vibroimpact.engine.assembly.plan import (
    Drift,
    Forcing,
    Stop,
    base_motion,
    bits,
    make_vector,
    partners,
    record_motion,
)
from vibroimpact.engine.state import LARGEST, MOST_PARTS
from vibroimpact.errors import InputError
from vibroimpact.law_numbers import MemoryStop, OwnStop, PowerLaw
from vibroimpact.model import (
    Assembly,
    Periodic,
    Record,
    Repeated,
)
from vibroimpact.model.assembly import numbers
from vibroimpact.model.assembly.numbers import PartNumbers

_Array = NDArray[np.float64]


def check_laws(assembly: Assembly) -> None:
    """Raise an error if an assembly has more parts than a motion of the engine has room for."""
    rows = _rows(assembly)
    stops, curved = len(assembly.stops), len(rows) - len(assembly.stops)
    if (count := bits(rows)) > layout.MOST_STOPS:
        raise InputError(
            f"stops: {stops} stops and {curved} curved parts of links need {count} "
            f"bits of a contact mode; at most {layout.MOST_STOPS} are possible (one for each stop "
            "and each curved part, two more for each part that has branches)"
        )
    if (parts := 2 * len(assembly.names) + len(rows)) > MOST_PARTS:
        raise InputError(
            f"masses: a state of {len(assembly.names)} masses, {stops} stops and {curved} curved "
            f"parts of links has {parts} numbers (two for each mass); at most {MOST_PARTS} are "
            "possible, so reduce the number of masses"
        )


def check_size(assembly: Assembly) -> None:
    """Raise an error if an assembly has more parts than the engine's maps have room for.

    `simulate` has no such limit.
    """
    links = len(link_parts(assembly))
    parts = 2 * len(assembly.names) + len(assembly.stops) + links
    if parts > LARGEST:
        more = f" and {links} curved parts of links" if links else ""
        raise InputError(
            f"rig: {len(assembly.names)} masses, {len(assembly.stops)} stops{more}; twice the "
            f"number of masses plus the number of all others is at most {LARGEST} here; use "
            "simulate"
        )


_TABLE_MASSES = 20
"""Up to which tables follow a motion faster than power series."""


def assembly_numbers(
    assembly: Assembly,
    shaking: Repeated | Record,
    *,
    tables: bool | None = None,
    drifts: Sequence[Drift] | None = None,
) -> _Array:
    """Return an assembly that is shaken as the engine's vector.

    With `tables`, contact modes that come again are faster; default: for up to 20 masses. This
    depends on the assembly alone, so that a motion has the same digits in parts of whole cycles.
    Default of `drifts`: those of the links.
    """
    check_laws(assembly)
    of = numbers(assembly)
    stops = _rows(assembly)
    damping, stiffness = of.damping.copy(), of.stiffness.copy()
    for part in of.links:
        k, c, law = part.law.engine_numbers()
        w = assembly.closing(assembly.links[part.name])
        stiffness += k * np.outer(w, w)
        if law.drag == 1.0:
            damping += c * np.outer(w, w)
    forcing = _forcing(assembly, shaking, of.mass, of.influence)
    pairs = _drifts(assembly) if drifts is None else drifts
    if tables is None:
        tables = len(of.mass) <= _TABLE_MASSES
    return make_vector(
        of.mass, damping, stiffness, stops, forcing, of.force, tables, of.influence, pairs
    )


def _drifts(assembly: Assembly) -> list[Drift]:
    """Return the drift of each link, with its dashpot as far as that is linear."""
    dashpots = {}
    for part in numbers(assembly).links:
        _, damping, law = part.law.engine_numbers()
        dashpots[part.name] = damping if law.drag == 1.0 else 0.0
    drifts = []
    for name, link in assembly.links.items():
        damping = link.law.damping if link.law.linear else dashpots[name]  # type: ignore[union-attr]
        drifts.append(Drift(*assembly.ends(link), damping))
    return drifts


def _rows(assembly: Assembly) -> list[Stop]:
    """Return the stops, then the curved parts of links."""
    of = numbers(assembly)
    rows = [_stop(part) for part in of.stops]
    for part in of.links:
        _, damping, law = part.law.engine_numbers()
        rows += [
            Stop(part.left, part.right, 0.0, behaviour=behaviour, law=row)
            for behaviour, row in link_rows(law, damping)
        ]
    return rows


def link_parts(assembly: Assembly) -> list[tuple[str, bool]]:
    """Return of each curved part of a link the link's name, and whether it remembers."""
    remember = (HYSTERETIC, BILINEAR)
    parts = []
    for part in numbers(assembly).links:
        _, damping, law = part.law.engine_numbers()
        rows = link_rows(law, damping)
        parts += [(part.name, behaviour in remember) for behaviour, _ in rows]
    return parts


def _stop(part: PartNumbers) -> Stop:
    made = part.law.engine_numbers()
    if part.law.rigid:
        return Stop(part.left, part.right, part.gap, wall=made)
    if isinstance(made, PowerLaw | OwnStop | MemoryStop):
        behaviour, row = stop_law(made)
        return Stop(part.left, part.right, part.gap, behaviour=behaviour, law=row)
    stiffness, damping, _ = made
    return Stop(part.left, part.right, part.gap, stiffness, damping)


def assembly_partners(assembly: Assembly) -> list[int]:
    """Return of each stop the one that is its mirror image, −1 if there is none."""
    return [int(other) for other in partners(_rows(assembly))][: len(assembly.stops)]


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
