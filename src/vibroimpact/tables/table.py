"""A text table: its columns in the order of the file, whatever their arrangement, and its times.

A table has its values in columns. Without names of columns, it may also be one component whose
values continue from line to line, pairs of time and value that do so, or two long rows. The numbers
themselves and the stated count decide; where they do not, an error asks for a statement.
"""

from __future__ import annotations

import math
from collections import Counter
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.tables.column import Array, TableColumn
from vibroimpact.tables.file import File
from vibroimpact.tables.headings import Headings, column_headings, is_time, listed_units
from vibroimpact.tables.limits import few_columns
from vibroimpact.tables.rows import Heading, Rows, split_rows
from vibroimpact.tables.statements import StatedNumber, Statements, read_statements
from vibroimpact.tables.time_column import time_column, with_stamps
from vibroimpact.tables.times import counts_samples, rises, spacing, unit_since_1970
from vibroimpact.tables.units import Units, parted

Arrangement = Literal["columns", "lines", "pairs", "rows"]
_NO_UNITS = Units(None)
_FEW = 3
"""Fewest lines of which the last may be shorter because the values end there."""


class Table(NamedTuple):
    """A table and what the lines above it state."""

    file: File
    columns: tuple[TableColumn, ...]
    lines: NDArray[np.int64]
    """Line of each row, starting from 0. With another arrangement than columns, of each value."""
    statements: Statements
    headings: tuple[Heading, ...]
    """Lines above the table that do not name its columns, and all comments."""
    time: int | None
    """Number of the column of times, in s. None if there is none."""
    arrangement: Arrangement
    names_columns: bool
    notes: tuple[str, ...]
    """What was assumed."""
    stamps: int | None
    """Number of the column whose times were stamps with dates or times of day."""
    decimal: str

    def refused(self, row: int, why: str) -> InputError:
        """Return an error that states the line of a row."""
        return self.file.refused(int(self.lines[row]), why)


def read_table(file: File) -> Table:
    """Read the table in a text file.

    Raises
    ------
    InputError
        If the file has no table, if a row has another width, if a cell is not a number, or if it
        is not known how the values are arranged.
    """
    rows = split_rows(file)
    cells, lines = _without_empty_end(rows.cells), rows.lines
    announced = _announced(rows, cells, lines)
    used = len({at for at, _ in announced})
    cells, lines = cells[used:], lines[used:]
    width = Counter(map(len, cells)).most_common(1)[0][0]
    few_columns(width, file.path, file.what)
    head = _headings(rows, cells, width)
    # The line above a single column may state all of it, as a sentence.
    named = frozenset() if head is None or width == 1 else head.lines
    headings = tuple(h for h in (*rows.above, *rows.comments) if h.at not in named)
    statements = _with_announced(read_statements((h.at, h.text) for h in headings), announced)
    notes: tuple[str, ...] = ()
    numbers = [[rows.number(cell) for cell in row] for row in cells]
    has_names = head is not None and any(head.names)
    plain = all(one is not None and not math.isnan(one) for row in numbers for one in row)
    if plain and head is not None and width > 2 and _repeat(head.names):
        statements = statements._replace(hints=(*_units_of(head.units[1]), *statements.hints))
        has_names = False
    arrangement: Arrangement = "columns"
    if not has_names and plain:
        values = [[one for one in row if one is not None] for row in numbers]
        arrangement, notes = _arrangement(file, values, lines, statements)
        columns, places = _rearranged(values, lines, arrangement)
        units = head.units if head and arrangement == "columns" else [_NO_UNITS] * len(columns)
        table_columns = [
            TableColumn("", unit, each) for unit, each in zip(units, columns, strict=True)
        ]
    else:
        _check_widths(file, cells, lines, width)
        head = head or Headings([""] * width, [_NO_UNITS] * width, frozenset())
        listed = listed_units(headings, width)
        table_columns = [
            TableColumn(
                name,
                _with_listed(units, listed[i]) if listed else units,
                _values(file, name, [row[i] for row in cells], [row[i] for row in numbers], lines),
            )
            for i, (name, units) in enumerate(zip(head.names, head.units, strict=True))
        ]
        places = lines
    table_columns, stamps = with_stamps(file, table_columns, headings, lines)
    time = time_column(table_columns, statements.step, arrangement in ("pairs", "rows"))
    if time is not None and table_columns[time].units.unit is None and statements.time_unit is None:
        unit = unit_since_1970(np.asarray(table_columns[time].values, dtype=float))
        if unit:
            table_columns[time] = table_columns[time]._replace(units=Units(unit))
            notes = (*notes, f"its times are read in {unit} since 1970, as they are that large")
    return Table(
        file,
        tuple(table_columns),
        np.array(places),
        statements,
        headings,
        time if stamps is None else stamps,
        arrangement,
        has_names,
        notes,
        stamps,
        rows.decimal,
    )


def _headings(rows: Rows, cells: list[list[str]], width: int) -> Headings | None:
    """Return the names of the columns. They may leave out that of the times, the first column."""
    head = column_headings(rows.above, width, rows.delimiter)
    if head is not None or width < 3:
        return head
    head = column_headings(rows.above, width - 1, rows.delimiter)
    if head is not None and any(map(is_time, head.names)):
        return None  # the missing name may be any
    first = [rows.number(row[0]) if row else None for row in cells]
    times = np.array([math.nan if one is None else one for one in first])
    if head is None or not any(head.names) or not rises(times):
        return None
    return Headings(["time", *head.names], [_NO_UNITS, *head.units], head.lines)


def _with_listed(units: Units, listed: str) -> Units:
    """Return the units of a column with that of a list of units above the table."""
    if units.unit is None:
        return Units(listed)
    return units if units.other else units._replace(other=listed)


def _repeat(names: list[str]) -> bool:
    """Return whether names are those of a time and a value, again and again."""
    again = len(names) % 2 == 0 and all(name == names[i % 2] for i, name in enumerate(names))
    return again and is_time(names[0]) and not is_time(names[1])


def _units_of(units: Units) -> tuple[str, ...]:
    return (units.unit,) if units.unit else ()


def _without_empty_end(cells: list[list[str]]) -> list[list[str]]:
    """Rows without an empty last cell, if each row ends with a separator."""
    while all(len(row) > 1 and not row[-1] for row in cells):
        cells = [row[:-1] for row in cells]
    return cells


def _announced(rows: Rows, cells: list[list[str]], lines: list[int]) -> list[tuple[int, float]]:
    """Lines and numbers of the count and the step that stand above the values, without words."""
    numbers = [[rows.number(cell) for cell in row] for row in cells[:3]]
    if len(cells) < 2 or any(one is None for row in numbers for one in row):
        return []
    first = [one for one in numbers[0] if one is not None]
    if len(cells) == 2 and (len(cells[1]) <= 2 or len(cells[1]) not in first):
        return []
    width = Counter(map(len, cells[1:])).most_common(1)[0][0]
    left = len(cells) - 1
    if len(first) == 1 == width:
        # A value that is exactly the number of values after it, and after it a step.
        second = numbers[1][0] or 0.0
        if first[0] == left - 1 > 10 and 0.0 < second <= 0.1:
            return [(lines[0], first[0]), (lines[1], second)]
        return [(lines[0], first[0])] if first[0] == left > 10 else []
    if len(first) not in (1, 2) or not any(one > 1.0 and one == round(one) for one in first):
        return []
    if len(first) == 2 == width:
        after = [rows.number(row[0]) if row else None for row in cells[1:]]
        times = np.array([math.nan if one is None else one for one in after])
        if first[0] != left or not rises(times) or rises(np.r_[first[0], times]):
            return []
    elif len(first) == width:
        return []
    return [(lines[0], one) for one in first]


def _with_announced(stated: Statements, announced: list[tuple[int, float]]) -> Statements:
    """Statements with a count and a step that stand above the values without words."""
    if not announced:
        return stated
    count = max(range(len(announced)), key=lambda i: announced[i][1] == round(announced[i][1]))
    at, value = announced[count]
    counts = (StatedNumber(value, at, f"{value:g}"), *stated.counts)
    steps = [StatedNumber(one, where, f"{one:g}") for where, one in announced if one != value]
    return stated._replace(counts=counts, steps=(*steps, *stated.steps))


def _check_widths(file: File, cells: list[list[str]], lines: list[int], width: int) -> None:
    for at, row in zip(lines, cells, strict=True):
        if len(row) != width:
            message = f"the row has {len(row)} number{'' if len(row) == 1 else 's'}, but the "
            raise file.refused(at, f"{message}rows above have {width}; make all rows equally long")


def _values(
    file: File, name: str, cells: list[str], numbers: list[float | None], lines: list[int]
) -> Array | NDArray[np.str_]:
    """The values of a column: numbers, or words if most cells are none."""
    words = [i for i, number in enumerate(numbers) if number is None]
    if not words:
        return np.array(numbers, dtype=float)
    # A column of remarks may have empty cells.
    if len(words) >= 0.5 * sum(number is None or number == number for number in numbers):
        return np.array(cells)
    i = words[0]
    of = f", column {parted(name)[0]!r}" if name else ""
    raise InputError(
        f"{file.what}: {file.path!r}, line {lines[i] + 1}{of}: {cells[i][:40]!r} is not a number; "
        "correct it, or leave the cell empty if the value is missing"
    )


def _arrangement(
    file: File, values: list[list[float]], lines: list[int], stated: Statements
) -> tuple[Arrangement, tuple[str, ...]]:
    """Return how numbers without names are arranged, and what is noted of it.

    Raises
    ------
    InputError
        If neither the numbers nor a stated count show it.
    """
    widths = list(map(len, values))
    width = Counter(widths).most_common(1)[0][0]
    total = sum(widths)
    full = all(one == width for one in widths)
    regular = full or (all(one == width for one in widths[:-1]) and widths[-1] < width)
    if not regular or (full and width == 1):
        _check_widths(file, [[""] * one for one in widths], lines, widths[0])
        return "columns", ()
    if len(values) == 2 and full and width > 2 and rises(np.array(values[0])):
        return "rows", ()
    if len(values) == 1:
        return ("lines" if width > 2 else "columns"), ()
    flat = np.array([one for row in values for one in row])
    if width % 2 == 0 and width > 2 and len(flat) % 2 == 0 and (np.diff(flat[::2]) > 0.0).all():
        return "pairs", ()
    counts = {int(one.value) for one in stated.counts}
    if full and len(values) in counts:
        return "columns", ()
    if total in counts:
        return "lines", ()
    whole = np.array([row for row in values if len(row) == width]).T
    even = [i for i, column in enumerate(whole) if rises(column) and spacing(column).step]
    if rises(whole[0]) or any(not counts_samples(whole[i]) for i in even):
        _check_widths(file, [[""] * one for one in widths], lines, width)
        return "columns", ()
    if stated.counts:
        one = stated.counts[0]
        raise file.refused(
            one.line,
            f"the file announces {one.value:g} values, but {total} follow, in {len(values)} rows "
            f"of {width}; correct this number, or pass a complete file",
        )
    if not full and len(values) < _FEW:
        _check_widths(file, [[""] * one for one in widths], lines, width)
    if not full and file.ends_whole:
        return "lines", (
            f"the {width} values of each line were read one after the other, as one component of "
            f"{total} values, because the last line is shorter",
        )
    raise InputError(
        f"{file.what}: {file.path!r}: its rows of {width} numbers have neither names nor times: "
        f"are they {width} components, or one component of {total} values{_comma(file, lines)}? "
        f"State the number of values above them, such as 'NPTS = {total}', or name the columns"
    )


def _comma(file: File, lines: list[int]) -> str:
    """A hint if commas of the first row may be decimal commas."""
    row = file.lines[lines[0]]
    may_be = "," in row and "." not in row and file.decimal is None
    return ", or have they decimal commas (decimal=',', --decimal ,)" if may_be else ""


def _rearranged(
    values: list[list[float]], lines: list[int], arrangement: Arrangement
) -> tuple[list[Array], list[int]]:
    """Return the columns, and the line of each of their values."""
    if arrangement == "columns":
        return list(np.array(values).T), lines
    if arrangement == "rows":
        return list(np.array(values)), [lines[0]] * len(values[0])
    flat = np.array([one for row in values for one in row])
    places = [at for at, row in zip(lines, values, strict=True) for _ in row]
    if arrangement == "pairs":
        return [flat[::2], flat[1::2]], places[::2]
    return [flat], places
