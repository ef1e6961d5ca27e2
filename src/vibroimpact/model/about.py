"""The source of a record, and values of the caller that replace statements in its file."""

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
from vibroimpact.records.doubts import of_end, of_times
from vibroimpact.records.read import read_channel
from vibroimpact.tables.decimal_mark import Decimal

NO_UNIT = "the unit m/s² was assumed, because the file states no unit"
"""Note if neither the file nor the user states a unit."""


class About(NamedTuple):
    """The source of a record, and its changes."""

    source: str = ""
    """The file."""
    format: str = ""
    station: str = ""
    component: str = ""
    unit: str = ""
    """Unit of the values in the file."""
    notes: tuple[str, ...] = ()
    """Assumptions, doubts and changes, in their order."""


def read_values(
    path: Path | str,
    component: str | int | None,
    unit: str | None,
    step: float | str | None,
    decimal: Decimal | None,
) -> tuple[NDArray[np.float64], float, Quantity, About]:
    """Return the values in a file (SI units), their step (s), their quantity and their source.

    Raises
    ------
    InputError
        As in `vibroimpact.Record.read`.
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
            none = f"has no step in {found.where}" if found.where else "has no times"
            raise InputError(
                f"step: missing, but {path!r} {none}; pass the time between two samples, such as "
                '"10 ms"'
            )
        return found.step
    spacing = to_si(step, TIME, "step", above=0.0)
    if found.uneven:
        notes.append(f"the step {pretty(spacing, TIME)} replaces the uneven times in the file")
    elif found.step is not None and not math.isclose(found.step, spacing, rel_tol=1e-9):
        notes.append(
            f"the step {pretty(spacing, TIME)} replaces the step in the file, {found.step:g} s"
        )
    return spacing


def _unit(
    found: Channel, unit: str | None, path: str, notes: list[str]
) -> tuple[str, float, Quantity]:
    """The unit of the values, its size in SI units and its quantity."""
    taken = unit or found.unit
    if taken is None:
        if found.unclear:
            raise InputError(
                f"unit: missing, and the values in {path!r} are {found.unclear}, not "
                "accelerations; pass the unit of displacements, or convert velocities to "
                'accelerations; for counts or volts, pass unit="m/s^2" (--unit) and the factor to '
                "Record.scaled (--scale)"
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
                f"record: {path!r} states two units{of}, {taken!r} and {other!r}; pass the unit of "
                "the values as unit= (--unit)"
            )
    if unit is None and found.of_name and not _same(found.of_name, factor, quantity):
        notes.append(
            f"the values are read in {taken}, although the name of the column states "
            f"{found.of_name}"
        )
    if unit is not None and found.unit is not None and not _same(found.unit, factor, quantity):
        notes.append(f"the unit {unit} replaces the unit in the file, {found.unit}")
    return taken, factor, quantity


def _same(unit: str, factor: float, quantity: Quantity) -> bool:
    """Whether a unit of a file has this size."""
    try:
        return to_si(f"1 {unit}", quantity, "unit") == factor
    except InputError:
        return False
