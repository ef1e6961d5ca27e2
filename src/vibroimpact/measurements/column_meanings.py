"""Meanings of the columns of a table, their values in SI units, and what is missing of them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from vibroimpact.errors import InputError, alternatives, shown, unknown
from vibroimpact.measurements.columns import Array, Columns
from vibroimpact.measurements.names import (
    AXES,
    CURVES,
    HISTORIES,
    QUANTITIES,
    Meaning,
    in_si,
    meaning,
    missing_unit,
    size_of,
)


def known_columns(
    table: Columns, columns: Mapping[str, str], units: Mapping[str, str]
) -> tuple[dict[int, Meaning], list[str], list[str]]:
    """Return the meaning of each column, by its number.

    The lists contain the columns that are not understood, and those whose quantity another column
    holds.
    """
    names = [column.name for column in table.columns]
    chosen = {}
    accepted = [*AXES, "direction", *CURVES, *HISTORIES]
    for variable, name in columns.items():
        bare, way = variable, None
        for end in ("forward", "backward"):
            if variable.endswith(f"_{end}"):
                bare, way = variable.removesuffix(f"_{end}"), end
        if bare not in accepted:
            raise InputError(f"columns: {unknown(variable, accepted)}")
        if name not in names:
            raise InputError(
                f"columns[{variable!r}]: {shown(name)} is not a column of {table.path!r}; use "
                f"{alternatives(names)}"
            )
        chosen[names.index(name)] = Meaning(bare, way)  # type: ignore[arg-type]
    for key in units:
        if key not in accepted and key not in names:
            raise InputError(
                f"units: {key!r} is neither a variable nor a column of {table.path!r}; use one of "
                f"its columns: {', '.join(names)}"
            )
    meanings: dict[int, Meaning] = {}
    left: list[str] = []
    repeated: list[str] = []
    for i, column in enumerate(table.columns):
        said = chosen.get(i) or meaning(column.name, column.unit)
        if said is None:
            left.append(column.name)
        elif i not in chosen and _is_repeated(said, chosen, meanings):
            repeated.append(column.name)
        elif said.variable != "direction" and column.values.dtype.kind not in "fiub":
            kind = " (complex numbers)" if column.values.dtype.kind == "c" else ""
            left.append(f"{column.name}{kind}")
        else:
            meanings[i] = said
    return meanings, left, repeated


def converted(
    table: Columns,
    meanings: Mapping[int, Meaning],
    used: set[str],
    units: Mapping[str, str],
    notes: list[str],
) -> dict[int, tuple[Meaning, Array]]:
    """Return the values of the used columns in SI units.

    Raises
    ------
    InputError
        If a unit is not stated or not clear, or if a value is not finite.
    """
    si_columns: dict[int, tuple[Meaning, Array]] = {}
    missing: dict[str, str] = {}
    for i, said in meanings.items():
        column = table.columns[i]
        if said.variable not in used:
            continue
        if said.variable == "direction":
            si_columns[i] = (said, np.empty(0))
            continue
        unit = units.get(said.variable) or units.get(column.name)
        if column.doubt and unit is None:
            raise InputError(
                f"measurement: {table.path!r}, column {column.name!r}: the file states "
                f"{column.doubt}; pass the unit that the values in the file have, as "
                f"units={{{column.name!r}: UNIT}} (--units)"
            )
        if usual := missing_unit(column, said, unit):
            missing[column.name] = usual
            continue
        values, note = in_si(column, said, unit, table.path)
        for row in np.flatnonzero(np.isinf(values))[:1]:
            raise InputError(
                f"measurement: {table.path!r}, {table.row(int(row))}, column {column.name!r}: "
                f"{values[row]} is not finite; correct it, or leave the cell empty if the value is "
                "missing"
            )
        if note:
            notes.append(note)
        si_columns[i] = (said, values)
    if missing:
        pairs = ", ".join(f"{name!r}: {unit!r}" for name, unit in missing.items())
        typed = " ".join(f"--units {name!r} {unit}" for name, unit in missing.items())
        raise InputError(
            f"measurement: {table.path!r} states no unit of {', '.join(map(repr, missing))}; pass "
            f"it, such as units={{{pairs}}} ({typed})"
        )
    return si_columns


def missing_columns(table: Columns, known: Mapping[int, Meaning], left: list[str]) -> str:
    """Describe how each column is read, what is missing, and how the user can specify it."""
    names = [column.name for column in table.columns]
    read = {names[i]: reading.variable for i, reading in known.items()}
    variables = set(read.values())
    moving = [name for name, reading in read.items() if reading in HISTORIES]
    if variables & set(CURVES):
        missing, wanted, listed = "the frequency is", ["frequency"], []
    elif "frequency" in variables:
        missing, listed = "the measured quantity is", list(CURVES)
        wanted = ["displacement_excursion"]
    elif "time" in variables:
        missing, wanted, listed = "the measured quantity is", ["displacement"], list(HISTORIES)
    elif moving:
        missing, wanted, listed = "the time, or a sampling rate fs, is", ["time"], []
    else:
        missing = "the frequency or the time, and the measured quantity, are"
        wanted, listed = ["frequency", "displacement_excursion"], []
    units = {column.name: column.unit for column in table.columns}
    fitting = [(key, name) for name in left for key in _of_unit(units[name], listed)]
    first = []
    if len(wanted) == 1 and fitting:
        wanted, first = [fitting[0][0]], [fitting[0][1]]
    spare = [*first, *left, *(moving if "frequency" in variables else []), *["NAME"] * len(wanted)]
    phrases = [f"{name!r} is read as {reading}" for name, reading in read.items()]
    phrases += [f"{name!r} is not understood" for name in left]
    pairs = list(zip(wanted, spare, strict=False))
    said = ", ".join(f"{key!r}: {name!r}" for key, name in pairs)
    typed = " ".join(f"--columns {key.replace('_', '-')} {name!r}" for key, name in pairs)
    accepted = f"; accepted quantities: {', '.join(listed)}" if listed else ""
    return (
        f": {', '.join(phrases)}; {missing} missing, so name the column"
        f"{'s' if len(pairs) > 1 else ''} as in columns={{{said}}} ({typed}){accepted}"
    )


def _of_unit(unit: str | None, variables: list[str]) -> list[str]:
    """The quantities among some that are measured in a unit."""
    return [key for key in variables if unit and size_of(unit, QUANTITIES[key]) is not None]


def _is_repeated(
    said: Meaning, chosen: Mapping[int, Meaning], meanings: Mapping[int, Meaning]
) -> bool:
    """Return whether another column holds the same quantity."""
    others = [*chosen.values(), *meanings.values()]
    return any((one.variable, one.direction) == (said.variable, said.direction) for one in others)
