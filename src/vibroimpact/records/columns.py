"""Records as text tables: values alone, or with times, in any arrangement of `tables.table`."""

from __future__ import annotations

import numpy as np

from vibroimpact.records.channel import Channel, Format
from vibroimpact.tables.checks import check_count, sampling
from vibroimpact.tables.column import TableColumn
from vibroimpact.tables.file import File
from vibroimpact.tables.headings import is_index
from vibroimpact.tables.statements import StatedPeak, Statements
from vibroimpact.tables.table import Table, read_table
from vibroimpact.tables.units import is_acceleration, parted


def read(file: File) -> list[Channel]:
    """Read the columns of a file, except for times, numbers of rows and words."""
    table = read_table(file)
    values = _components(table)
    if not values:
        raise file.refused(
            int(table.lines[0]), "no column has values; pass a file with accelerations"
        )
    rows = len(table.lines)
    check_count(file, table.statements, (rows, rows * len(values), rows * len(table.columns)))
    time = None if table.time is None else table.columns[table.time].units
    timing = sampling(table, time.unit if time else None)
    problem = timing.uneven
    if timing.contradiction:
        problem = f"{timing.contradiction}, or pass step= (--step)"
    if _only_counts(table):
        problem = (
            "its times only count the rows (0, 1, 2, ...); pass step= (--step), such as '5 ms'"
        )
    others = (time.other, time.of_name) if time else ()
    if time and any(one and one != time.unit for one in others):
        other = next(one for one in others if one and one != time.unit)
        problem = (
            f"its times are in {time.unit!r} and in {other!r}; use one unit, or pass step= "
            "(--step), which replaces the times"
        )
    return [
        _channel(table, column, len(values))._replace(
            step=timing.step,
            notes=(*table.notes, *_left_out(table), *([timing.note] if timing.note else [])),
            no_step=problem,
        )
        for column in values
    ]


def _only_counts(table: Table) -> bool:
    """Return whether the times are numbers of rows, and nothing in the file states their unit."""
    if table.time is None or not table.columns[table.time].is_row_number:
        return False
    units, stated = table.columns[table.time].units, table.statements
    steps = units.unit or stated.time_unit or stated.step or stated.durations
    return not steps


def _components(table: Table) -> list[int]:
    """Numbers of the columns that may be components."""
    times = None if table.time is None else table.columns[table.time]
    numeric = [
        i
        for i, one in enumerate(table.columns)
        if one.is_numeric and i != table.time and not np.isnan(one.values.astype(float)).all()
    ]
    repeats = [
        i
        for i in numeric
        if times is not None and np.array_equal(table.columns[i].values, times.values)
    ]
    counted = times is not None or table.statements.step is not None
    rows = [
        i
        for i in numeric
        if table.columns[i].is_row_number
        and len(numeric) > 1
        and (is_index(table.columns[i].name) or (counted and i == 0))
    ]
    return [i for i in numeric if i not in repeats and i not in rows]


def _left_out(table: Table) -> tuple[str, ...]:
    words = [one.name or str(i + 1) for i, one in enumerate(table.columns) if not one.is_numeric]
    return (f"columns of words were left out: {', '.join(words)}",) if words else ()


def _channel(table: Table, at: int, count: int) -> Channel:
    """The component in a column, with the units that the file states for it."""
    column = table.columns[at]
    stated = table.statements
    own = column.units.unit
    general = own or next(iter(stated.units), None)
    above: tuple[str, ...]
    if general is None:
        general, above = next(iter(stated.hints), None), stated.hints
    else:
        above = tuple(unit for unit in stated.units if is_acceleration(unit))
    name = parted(column.name)[0] if count > 1 or len(table.columns) > 2 else ""
    unnamed = sum(not one.name for one in table.columns[:at]) - (table.time == 0)
    return Channel(
        np.asarray(column.values, dtype=float),
        None,
        general,
        component=name or (str(unnamed + 1) if count > 1 else ""),
        others=(*above, *([column.units.other] if column.units.other else [])),
        of_name=column.units.of_name,
        peaks=_peaks(stated, column, count),
        damage=_missing(table, column),
    )


def _peaks(stated: Statements, column: TableColumn, count: int) -> tuple[StatedPeak, ...]:
    """Peaks that the file states of a component. Of several, a peak must name it."""
    name = parted(column.name)[0].lower()
    return tuple(one for one in stated.peaks if count == 1 or one.channel.lower() == name != "")


def _missing(table: Table, column: TableColumn) -> str:
    gone = np.flatnonzero(~np.isfinite(np.asarray(column.values, dtype=float)))
    if not len(gone):
        return ""
    row = int(gone[0])
    of = f", column {parted(column.name)[0]!r}" if column.name else ""
    fault = "a value is missing" if np.isnan(column.values[row]) else "inf is not finite"
    return f"line {int(table.lines[row]) + 1}{of}: {fault}; replace it by a finite number"


FORMAT = Format("columns", lambda file: True, read)
