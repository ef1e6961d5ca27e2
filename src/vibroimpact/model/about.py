"""Where a record comes from, and what a caller states instead of the file."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError, in_one_line
from vibroimpact.model.quantities import ACCELERATION, LENGTH, TIME, Quantity
from vibroimpact.model.units import one_of, pretty, to_si
from vibroimpact.records.channel import Channel
from vibroimpact.records.commas import Decimal
from vibroimpact.records.doubts import of_end, of_times
from vibroimpact.records.read import read_channel

NO_UNIT = "unit m/s², because the file states none"
"""What is noted where neither file nor user says a unit."""


class About(NamedTuple):
    """Where a record comes from, and what was done to it."""

    source: str = ""
    """The file."""
    format: str = ""
    station: str = ""
    component: str = ""
    unit: str = ""
    """Of the file's values."""
    notes: tuple[str, ...] = ()
    """Assumptions and changes, in order."""


def read_values(
    path: Path | str,
    component: str | int | None,
    unit: str | None,
    step: float | str | None,
    decimal: Decimal | None,
) -> tuple[NDArray[np.float64], float, Quantity, About]:
    """Read the values of a file in SI units, their step (s), what they are and where they are from.

    Raises
    ------
    InputError
        As of `vibroimpact.Record.read`.
    """
    form, found, _ = read_channel(path, component, decimal)
    notes = list(found.notes)
    spacing = _spacing(found, step, str(path), notes)
    taken, factor, quantity = _unit(found, unit, str(path), notes)
    notes += of_end(found.values)
    notes += of_times(spacing, len(found.values))
    about = About(in_one_line(str(path)), form, found.station, found.component, taken, tuple(notes))
    return found.values * factor, spacing, quantity, about


def _spacing(found: Channel, step: Any, path: str, notes: list[str]) -> float:
    """The time between samples (s): the argument, or the value in the file."""
    if step is None:
        if found.uneven:
            raise InputError(f"record: {path!r}, {found.uneven}")
        if found.step is None:
            none = f"has none in {found.where}" if found.where else "has no times"
            raise InputError(f"step: missing, and {path!r} {none}; a time is accepted")
        return found.step
    spacing = to_si(step, TIME, "step", above=0.0)
    if found.uneven:
        notes.append(f"step {pretty(spacing, TIME)}, not the file's uneven times")
    elif found.step is not None and not math.isclose(found.step, spacing, rel_tol=1e-9):
        notes.append(f"step {pretty(spacing, TIME)}, not the file's {found.step:g} s")
    return spacing


def _unit(
    found: Channel, unit: str | None, path: str, notes: list[str]
) -> tuple[str, float, Quantity]:
    """The unit of the values, its size in SI units and its quantity."""
    taken = unit or found.unit
    if taken is None:
        if found.unclear:
            raise InputError(
                f"unit: missing, and {path!r} has {found.unclear}; give the unit of an "
                'acceleration, such as "m/s^2", then scale the values with Record.scaled or '
                "--scale"
            )
        taken = "m/s^2"
        notes.append(NO_UNIT)
    try:
        factor, quantity = one_of(f"1 {taken}", [ACCELERATION, LENGTH], "unit")
    except InputError as error:
        if unit is not None:
            raise
        raise InputError(f"record: {path!r}: {error}") from None
    for other in () if unit else found.others:
        if not _same(other, factor, quantity):
            of = f" of {found.component!r}" if found.component else ""
            raise InputError(
                f"record: {path!r} states the units {taken!r} and {other!r}{of}; unit= (--unit), "
                "with the unit of the values, is accepted"
            )
    if unit is None and found.of_name and not _same(found.of_name, factor, quantity):
        notes.append(f"read in {taken}, although its name states {found.of_name}")
    if unit is not None and found.unit is not None and not _same(found.unit, factor, quantity):
        notes.append(f"unit {unit}, not the file's {found.unit}")
    return taken, factor, quantity


def _same(unit: str, factor: float, quantity: Quantity) -> bool:
    """Whether a unit of a file has this size."""
    try:
        return to_si(f"1 {unit}", quantity, "unit") == factor
    except InputError:
        return False
