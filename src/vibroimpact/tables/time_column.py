"""The column of times of a table, which may be stamps with dates and times of day."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from vibroimpact.tables.column import TableColumn
from vibroimpact.tables.file import File
from vibroimpact.tables.headings import is_index, is_time
from vibroimpact.tables.rows import Heading
from vibroimpact.tables.statements import StatedNumber, same
from vibroimpact.tables.times import (
    IN_A_SECOND,
    rises,
    seconds_since_start,
    spacing,
    stamp,
    stated_order,
)
from vibroimpact.tables.units import Units


def with_stamps(
    file: File, columns: list[TableColumn], headings: Sequence[Heading], lines: list[int]
) -> tuple[list[TableColumn], int | None]:
    """Return columns in which dates and times of day are times in s, and the number of the column.

    A column of dates beside one of times of day is joined with it.
    """
    stamps_of = {}
    for i, column in enumerate(columns):
        if not column.is_numeric:
            read = [stamp(str(cell)) for cell in column.values]
            if all(read):
                stamps_of[i] = [one for one in read if one]
    clocks = [i for i, read in stamps_of.items() if all(one.seconds is not None for one in read)]
    if not clocks:
        return columns, None
    at = clocks[0]
    stamps = stamps_of[at]
    days = [i for i, read in stamps_of.items() if all(one.seconds is None for one in read)]
    first = str(columns[at].values[0])
    if days and stamps[0].date is None:
        stamps = [
            one._replace(date=day.date, year_first=day.year_first)
            for one, day in zip(stamps, stamps_of[days[0]], strict=True)
        ]
        first = f"{columns[days[0]].values[0]} {first}"
    else:
        days = []
    named = [columns[i].name for i in (*days[:1], at)]
    times = seconds_since_start(stamps, stated_order([*named, *(h.text for h in headings)]))
    if times is None:
        raise file.refused(
            lines[0],
            f"{first!r} begins dates that do not exist in one order of day and month; write dates "
            "as 2024-05-31, or pass step= (--step)",
        )
    joined = TableColumn(columns[at].name or "time", Units("s"), times)
    kept = [joined if i == at else one for i, one in enumerate(columns) if i not in days[:1]]
    return kept, next(i for i, c in enumerate(kept) if c is joined)


_OTHER_AXES = re.compile(r"f(?:req(?:uency)?)?|hz|period", re.IGNORECASE)


def time_column(
    columns: list[TableColumn], step: StatedNumber | None, is_first: bool
) -> int | None:
    """Return the number of the column of times: one that the header names, or that rises evenly.

    If `is_first`, the arrangement of the table has its times in the first column.
    """
    if len(columns) < 2:
        return None
    if is_first:
        return 0
    numeric = [i for i, column in enumerate(columns) if column.is_numeric]
    for i in numeric:
        if columns[i].name and is_time(columns[i].name):
            return i
    if numeric and not columns[numeric[0]].name and _may_be_times(columns[numeric[0]]):
        first = numeric[0]
    else:
        first = -1
    even = [i for i in numeric if _may_be_times(columns[i]) and _is_even(columns[i])]
    # The numbers of the rows are even, too; they are the times of a step of 1 s, if of any.
    others = [i for i in even if not columns[i].is_row_number]
    if others and (first < 0 or columns[first].is_row_number):
        return others[0]
    if first < 0 and even and even[0] == numeric[0]:
        first = even[0]
    if first < 0 or not columns[first].is_row_number:
        return None if first < 0 else first
    is_step = step is None or same(step.value, 1.0)
    return first if is_step and not is_index(columns[first].name) else None


def _may_be_times(column: TableColumn) -> bool:
    unit = column.units.unit
    is_other = bool(_OTHER_AXES.fullmatch(column.name.partition("(")[0].strip()))
    return (
        (unit is None or unit in IN_A_SECOND)
        and not is_other
        and rises(np.asarray(column.values, dtype=float))
    )


def _is_even(column: TableColumn) -> bool:
    return spacing(np.asarray(column.values, dtype=float)).step is not None
