"""Read measured data from files of common programs, with the variable names of this package."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.arguments import check_path, check_texts
from vibroimpact.datasets.description import describe
from vibroimpact.datasets.files import load
from vibroimpact.errors import InputError, printable, shown, warn_of_input
from vibroimpact.measurements import hdf5, lvm, mat, tdms, text, uff
from vibroimpact.measurements.column_meanings import converted, known_columns, missing_columns
from vibroimpact.measurements.columns import ChannelColumn, Columns
from vibroimpact.measurements.curves import curves
from vibroimpact.measurements.dropouts import doubt_marks
from vibroimpact.measurements.file_entries import shaking
from vibroimpact.measurements.histories import history
from vibroimpact.measurements.names import AXES, CURVES, HISTORIES, meaning
from vibroimpact.measurements.sampling import timed
from vibroimpact.measurements.scaling import completed, is_channel
from vibroimpact.model.public import public
from vibroimpact.tables.decimal_mark import Decimal, checked
from vibroimpact.tables.file import File
from vibroimpact.tables.limits import regular

_READERS = {
    ".mat": mat.read,
    ".h5": hdf5.read,
    ".hdf5": hdf5.read,
    ".hdf": hdf5.read,
    ".uff": uff.read,
    ".unv": uff.read,
    ".tdms": tdms.read,
}
CALL = "the call"
"""Source of an amplitude that is passed in the call."""
CREATED_BY = "vibroimpact.read_measurement"


@public
def read_measurement(
    path: Path | str,
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    direction: str | None = None,
    group: str | None = None,
    amplitude: float | str | None = None,
    frequency: float | str | None = None,
    decimal: str | None = None,
) -> xr.Dataset:
    """Read measured resonance curves or time histories from a file.

    Parameters
    ----------
    path
        The file. Accepted are text tables (CSV and similar formats, ``.lvm`` of LabVIEW), MATLAB
        (``.mat``), HDF5 (``.h5``), universal files (``.uff``, requires pyuff), TDMS
        (``.tdms``, requires npTDMS), and NetCDF files of this package.
    columns
        Names of the columns in the file, by variable, such as ``{"displacement_excursion": "Ed"}``.
        They are required only for columns whose names are not understood.
    units
        Units by variable or by column, such as ``{"displacement_excursion": "mm"}``. They replace
        the units in the file, and are required if the file states none. Times without a unit are in
        s, and frequencies in Hz.
    direction
        Sweep direction of curves, ``"forward"`` or ``"backward"``, if the file does not state it.
    group
        Name of the test. It is required if the file holds several tests.
    amplitude
        Peak base acceleration of the test (m/s², or a string such as ``"0.05 g"``). It replaces the
        value in the file (``amplitude = 0.05 g``, ``amplitude_g = 0.05``), and is required if that
        value has no unit.
    frequency
        Forcing frequency (Hz) of a time history. It replaces the value in the file.
    decimal
        Decimal mark of a text table, ``"."`` or ``","``. Default: detected from the table. If the
        table is ambiguous, the mark is required.

    Returns
    -------
    xarray.Dataset
        Curves have the dims ``direction`` and ``frequency``. If a frequency was measured more than
        once, they also have the dim ``repeat``. Time histories have the dim ``time``. The variables
        have the same names as in `sweep` and `simulate`, and SI units.

        The attribute ``notes`` lists the assumptions, and the columns and numbers that were left
        out, one per line. ``left_out`` names the columns that were not understood.
        ``amplitude_source`` states where the amplitude comes from.

    Raises
    ------
    InputError
        If the file cannot be read, if a column or a unit is ambiguous, if the unit of a quantity is
        not stated, or if a text table states a number of samples, a step or a duration that its
        values contradict.

    Warns
    -----
    InputWarning
        If assumptions were made, or if columns or numbers were left out.
    """
    file = check_path(path, "measurement")
    check_texts(columns, "columns", "Ed")
    check_texts(units, "units", "mm")
    if file.is_dir():
        raise InputError(f"measurement: {str(path)!r} is a folder; pass the path of a file")
    if not file.exists():
        raise InputError(f"measurement: {str(path)!r} does not exist; check the path of the file")
    regular(file, "measurement")
    if file.suffix.lower() == ".nc":
        return _checked(load(file)).assign_attrs(_stated(amplitude, frequency))
    columns = {variable: _clean(name) for variable, name in (columns or {}).items()}
    units = {_clean(name): unit for name, unit in (units or {}).items()}
    tables = [_cleaned(table) for table in _tables(file, checked(decimal))]
    tables = [completed(part) for table in tables for part in _runs(table)]
    tables = [_filled(table, set(columns.values())) for table in tables]
    tables = [part for table in tables if table.columns for part in timed(table)]
    notes: list[str] = []
    facts: list[str] = []
    table = _chosen(str(path), tables, group, set(columns.values()), notes)
    notes += table.notes
    meanings, left, repeated = known_columns(table, columns, units)
    for i in meanings:
        column = table.columns[i]
        if column.values.dtype.kind in "fiu":
            notes += doubt_marks(column.name, column.values.astype(float))
    variables = {column_meaning.variable for column_meaning in meanings.values()}
    if "frequency" in variables and variables & set(CURVES):
        known = converted(table, meanings, {"frequency", "direction", *CURVES}, units, notes)
        data, kind = curves(table, known, direction, notes, facts), "curves"
    elif "time" in variables and variables & set(HISTORIES):
        known = converted(table, meanings, {"time", *HISTORIES}, units, notes)
        data, kind = history(table, known, notes, facts), "history"
    else:
        raise InputError(
            f"measurement: {str(path)!r}{missing_columns(table, meanings, [*left, *repeated])}"
        )
    if repeated:
        notes.append(
            f"columns of a quantity that another column has were left out: {', '.join(repeated)}; "
            "columns= (--columns) selects the column of a quantity"
        )
    if left:
        notes.append(f"columns were not understood and were left out: {', '.join(left)}")
    data.attrs |= shaking(table, {"amplitude": amplitude, "frequency": frequency}, notes)
    if "amplitude" in data.attrs:
        data.attrs["amplitude_source"] = file.name if amplitude is None else CALL
    data.attrs |= {
        "source": _clean(file.name),
        "kind": kind,
        "notes": "\n".join([*facts, *notes]),
        "left_out": "\n".join([*left, *repeated]),
    }
    warn_of_input(f"measurement {str(path)!r}", notes)
    return describe(data, CREATED_BY)


def _tables(file: Path, decimal: Decimal | None) -> list[Columns]:
    """Read the tables of a file: by its ending, or by the first line of LabVIEW files."""
    reader = _READERS.get(file.suffix.lower())
    if reader is not None:
        return reader(file)
    opened = File(file, decimal, "measurement")
    tables = lvm.read(opened)
    return text.read(opened) if tables is None else tables


def _clean(name: str) -> str:
    """Return a name on one line, without control characters."""
    return " ".join(printable(name).split())


def _cleaned(table: Columns) -> Columns:
    """Return a table in which each text is one line without control characters."""
    return table._replace(
        columns=tuple(
            one._replace(name=_clean(one.name), unit=one.unit and _clean(one.unit))
            for one in table.columns
        ),
        said={_clean(key): _clean(text) for key, text in table.said.items()},
    )


def _filled(table: Columns, wanted: set[str]) -> Columns:
    """Return a table without empty channels, which would hide channels of the same meaning."""
    empty = [
        column
        for column in table.columns
        if column.name not in wanted and column.values.dtype.kind in "fiub"
        and np.isnan(column.values).all()
    ]  # fmt: skip
    kept = tuple(one for one in table.columns if not any(one is other for other in empty))
    if not empty or not any(map(is_channel, kept)):
        return table
    note = f"columns without values were left out: {', '.join(column.name for column in empty)}"
    return table._replace(columns=kept, notes=(*table.notes, note))


def is_measured(data: object) -> bool:
    """Return whether a dataset holds measured data."""
    return isinstance(data, xr.Dataset) and data.attrs.get("kind") in ("curves", "history")


def _stated(amplitude: object, frequency: object) -> dict[str, Any]:
    """Return attributes for the shaking that is passed in the call."""
    said = shaking(Columns("", (), {}), {"amplitude": amplitude, "frequency": frequency}, [])
    return {**said, **({"amplitude_source": CALL} if amplitude is not None else {})}


def _checked(data: xr.Dataset) -> xr.Dataset:
    if is_measured(data):
        return data
    if {"direction", "frequency"} <= set(data.dims) and set(data) & set(CURVES):
        kind = "curves"
    elif "time" in data.dims and set(data) & set(HISTORIES):
        kind = "history"
    else:
        raise InputError(
            "measurement: the dataset contains neither resonance curves nor a time history; pass "
            "the result of sweep, simulate or read_measurement"
        )
    return data.assign_attrs(kind=kind, notes="")


def as_measured(data: object, where: str = "data") -> xr.Dataset:
    """Accept a dataset of `read_measurement`, `sweep` or `simulate`, or the path of a file."""
    if isinstance(data, str | Path):
        return read_measurement(data)
    if isinstance(data, xr.Dataset):
        return _checked(data)
    raise InputError(
        f"{where}: an object of type {type(data).__name__} is not a measurement; pass the result "
        "of read_measurement, or the path of a file"
    )


def _runs(table: Columns) -> list[Columns]:
    """Split a table whose columns are called ``Run 1: Time`` and so on into its runs."""
    groups: dict[str, list[ChannelColumn]] = {}
    for column in table.columns:
        run, mark, name = column.name.partition(":")
        groups.setdefault(run.strip() if mark else "", []).append(
            column._replace(name=name.strip() if mark else column.name)
        )
    if len(groups) < 2:
        return [table]
    said = dict(table.said)
    return [
        table._replace(columns=tuple(group), said={**said, "group": run})
        for run, group in groups.items()
    ]


def _chosen(
    path: str, tables: list[Columns], group: str | None, wanted: set[str], notes: list[str]
) -> Columns:
    """Return the requested test, or the only test that has a time or a frequency."""
    if not tables:
        raise InputError(
            f"measurement: {path!r} contains no column of numbers; pass a file with measured values"
        )
    names = [table.said.get("group") or str(i + 1) for i, table in enumerate(tables)]
    if group is None and len(tables) == 1:
        return tables[0]
    usable = [i for i, table in enumerate(tables) if _has_axis(table, wanted)]
    if group is None and len(usable) == 1:
        others = [name for i, name in enumerate(names) if i != usable[0]]
        notes.append(f"tables without a time or a frequency were left out: {', '.join(others)}")
        return tables[usable[0]]
    if isinstance(group, str) and group in names:
        return tables[names.index(group)]
    choice = f"{shown(group)} is none of them" if group is not None else "none is chosen"
    raise InputError(
        f"group: {path!r} holds {len(tables)} tests, and {choice}; pass one of "
        f"{', '.join(map(repr, names))}"
    )


def _has_axis(table: Columns, wanted: set[str]) -> bool:
    """Return whether a table has a time, a frequency, or columns that were requested by name."""
    said = [meaning(column.name) for column in table.columns]
    known = any(one is not None and one.variable in AXES for one in said)
    return known or bool(wanted & {column.name for column in table.columns})
