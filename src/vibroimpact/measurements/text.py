"""Text tables of measurements: CSV and similar formats, with named columns.

Lines above the table may contain ``amplitude = 0.05 g`` or ``amplitude; 0.05 g``.
"""

from __future__ import annotations

import re

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements.channel_attributes import kind_of
from vibroimpact.measurements.columns import ChannelColumn, Columns
from vibroimpact.measurements.file_entries import with_unit
from vibroimpact.measurements.names import QUANTITIES, meaning
from vibroimpact.measurements.scaling import agreed, doubtful
from vibroimpact.model.quantities import ACCELERATION
from vibroimpact.tables.checks import check_count, sampling
from vibroimpact.tables.file import File
from vibroimpact.tables.headings import entry, listed_units
from vibroimpact.tables.rows import Heading, cut_heading
from vibroimpact.tables.table import Table, read_table
from vibroimpact.tables.times import IN_A_SECOND
from vibroimpact.tables.units import is_acceleration, parted, unit_of

_COMMA = re.compile(r"[+-]?\d+,\d+(?![\d,.])")
_OF_VALUES = {"", "amplitude", "acceleration", "acc", "accel", "data", "value", "values"}
"""What a stated unit of acceleration may be of, apart from one channel."""


def read(file: File) -> list[Columns]:
    """Read the table of a text file.

    Raises
    ------
    InputError
        If the file has no table of numbers, if its columns have no names, if a row has another
        number of columns, or if a stated count or step contradicts the values.
    """
    table = read_table(file)
    if not table.names_columns:
        raise InputError(
            f"measurement: {file.path!r} does not name its {len(table.columns)} columns; add a "
            "first line such as 'frequency (Hz), direction, displacement excursion (mm)'"
        )
    said = _entries(table)
    columns = []
    for i, column in enumerate(table.columns):
        bare, own = parted(column.name)
        if i == table.stamps and _variable(bare) != "time":
            bare = "time"
        of_name = unit_of(column.name)
        below = None if own or column.units.unit == of_name else column.units.unit
        unit, doubt = agreed(own, below, column.units.other)
        columns.append(ChannelColumn(bare, unit, column.values, doubt=doubt))
    columns, said = _in_stated_unit(table, columns, said)
    channels = Columns(file.path, tuple(columns), said, table.lines + 1, table.notes)
    return [_sampled(table, channels)]


def _variable(name: str) -> str | None:
    known = meaning(name)
    return known.variable if known else None


def _entries(table: Table) -> dict[str, str]:
    """The entries above and beside the table, by their names. Comments take precedence.

    Counts and durations of time histories, which are compared with the values, are left out, and a
    list of units, which the columns have.
    """
    stated = table.statements
    of_time = all(_variable(parted(one.name)[0]) != "frequency" for one in table.columns)
    checked = {one.line for one in (*stated.counts, *stated.durations) if of_time}
    said: dict[str, str] = {}
    for line in sorted(table.headings, key=lambda one: not one.is_comment):
        pair = _said(line, table.decimal)
        if pair is None or line.at in checked or listed_units([line], len(table.columns)):
            continue
        if line.is_comment:
            said[pair[0]] = pair[1]
        else:
            said.setdefault(*pair)
    return said


def _said(line: Heading, decimal: str) -> tuple[str, str] | None:
    """The name and the value of an entry."""
    text = line.text
    if not line.is_comment:
        for mark in (";", "\t", ","):
            cells = [cell for cell in cut_heading(text, mark) if cell]
            if mark in text and len(cells) == 2 and (pair := entry("; ".join(cells))):
                text = "; ".join(cells)
                break
    pair = entry(text)
    if pair is None:
        return None
    name, unit = parted(pair[0])
    return name, with_unit(_pointed(pair[1], decimal), unit)


def _pointed(text: str, decimal: str) -> str:
    """Return a number with a decimal point. With comma-separated columns, 1,000 is kept."""
    match = _COMMA.match(text)
    if not match or (decimal == "." and re.fullmatch(r"[+-]?[1-9]\d*,\d{3}", match[0])):
        return text
    return match[0].replace(",", ".") + text[match.end() :]


def _in_stated_unit(
    table: Table, columns: list[ChannelColumn], said: dict[str, str]
) -> tuple[list[ChannelColumn], dict[str, str]]:
    """Give channels without a unit the unit of acceleration that a line states of the values."""
    stated = [unit for unit in (*table.statements.units, *table.statements.hints)
              if is_acceleration(unit)]  # fmt: skip
    used = [
        key
        for key, text in said.items()
        if kind_of(key)[0] == "unit" and kind_of(key)[1] in _OF_VALUES
        and kind_of(key)[1] not in said and is_acceleration(text.partition(" ")[0].strip(".,;"))
    ]  # fmt: skip
    if not stated:
        return columns, said
    with_units = [
        _in_unit(one, stated) if one.unit is None else _compared(one, table.statements.units)
        for one in columns
    ]
    if not any(one is not each for one, each in zip(with_units, columns, strict=True)):
        return columns, said
    return with_units, {key: text for key, text in said.items() if key not in used}


def _in_unit(column: ChannelColumn, stated: list[str]) -> ChannelColumn:
    """Return a column without a unit, with the stated one if it may hold accelerations."""
    if not _may_accelerate(column, stated[0]):
        return column
    unit, doubt = agreed(*stated)
    return column._replace(unit=unit, doubt=doubt)


def _compared(column: ChannelColumn, stated: tuple[str, ...]) -> ChannelColumn:
    """Return a column with a unit, and with a doubt if another one is stated of accelerations."""
    of_acceleration = _quantity(column.name, column.unit) is ACCELERATION
    _, doubt = agreed(column.unit, *filter(is_acceleration, stated))
    return doubtful(column, doubt) if doubt and of_acceleration else column


def _quantity(name: str, unit: str | None) -> object:
    known = meaning(name, unit)
    return QUANTITIES.get(known.variable) if known else None


def _may_accelerate(column: ChannelColumn, unit: str) -> bool:
    """Return whether a column without a unit may hold accelerations in this unit."""
    known = meaning(column.name, unit)
    quantity = QUANTITIES.get(known.variable) if known else ACCELERATION
    is_free = column.unit is None and (known is None or known.unit is None)
    return is_free and column.values.dtype.kind == "f" and quantity is ACCELERATION


def _sampled(table: Table, channels: Columns) -> Columns:
    """Check the stated count and step of a time history, and use the step if there are no times."""
    axes = {known.variable: i for i, c in enumerate(channels.columns) if (known := meaning(c.name))}
    stated = table.statements
    if "frequency" in axes or ("time" not in axes and stated.step is None):
        return channels
    at = axes.get("time")
    unit = None if at is None else channels.columns[at].unit or unit_of(table.columns[at].name)
    if unit is not None and unit not in IN_A_SECOND:
        return channels
    if at is not None and not table.columns[at].is_numeric:
        return channels
    rows = len(table.lines)
    check_count(table.file, stated, (rows, rows * (len(channels.columns) - (at is not None))))
    if at is not None and not np.isfinite(channels.columns[at].values).all():
        return channels
    if at is not None and rows < 2:
        return channels
    if at is not None and at == table.stamps and stated.step is None:
        again = np.flatnonzero(np.diff(channels.columns[at].values) == 0.0)
        if len(again):
            raise table.refused(
                int(again[0]) + 1,
                "its time is that of the line above, as times are rounded; state the sampling rate "
                "above the table, such as '# fs = 200 Hz'",
            )
    step = sampling(table._replace(time=at), unit)
    if step.contradiction:
        raise InputError(f"measurement: {channels.path!r}, {step.contradiction}")
    if at is None and step.step is not None:
        columns = tuple(one._replace(step=step.step) for one in channels.columns)
        return channels._replace(columns=columns)
    if at is not None and step.step is not None and "stated step" in step.note:
        times = channels.columns[at].values[0] / IN_A_SECOND[unit or "s"]
        even = ChannelColumn("time", "s", times + step.step * np.arange(rows))
        columns = tuple(even if i == at else one for i, one in enumerate(channels.columns))
        return channels._replace(columns=columns, notes=(*channels.notes, step.note))
    return channels
