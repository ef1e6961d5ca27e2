"""Units and scales that a file states next to its channels are assigned to the channels.

This applies to all file formats. ``unit`` and ``scale`` belong to the only channel. ``u_unit``
belongs to ``u``. If it is not clear which channel or what quantity is meant, the channels get a
doubt.
"""

from __future__ import annotations

from collections.abc import Iterable

from vibroimpact.errors import shown
from vibroimpact.measurements.channel_attributes import Kind, kind_of, known, one, words_in
from vibroimpact.measurements.columns import ChannelColumn, Columns
from vibroimpact.measurements.file_entries import with_unit
from vibroimpact.measurements.names import AXES, QUANTITIES, alike, meaning
from vibroimpact.measurements.sampling import is_rate, is_sampling

_NUMBERS = "fiub"


def agreed(*units: str | None) -> tuple[str | None, str]:
    """Return the unit that several statements have in common, and a doubt if they differ."""
    stated = [unit for unit in units if known(unit)]
    for other in stated[1:]:
        if not alike(str(stated[0]), str(other)):
            return stated[0], f"the units {stated[0]!r} and {other!r}"
    return (stated[0] if stated else None), ""


def doubtful(column: ChannelColumn, doubt: str) -> ChannelColumn:
    """Return a column with one more doubt."""
    parts = dict.fromkeys(part for part in (*column.doubt.split("; "), doubt) if part)
    return column._replace(doubt="; ".join(parts))


def completed(table: Columns) -> Columns:
    """Return a table to whose channels the stated units and scales have been applied."""
    columns = list(table.columns)
    said = dict(table.said)
    for name in table.said:
        kind, about = kind_of(name)
        if kind is None:
            continue
        text = said.pop(name)
        number = next((key for key in said if _plain(key) == about and about), None)
        if "unit" in kind and number is not None:
            said[number] = with_unit(said[number], text)
            continue
        if kind == "time_unit" and not _named(columns, about):
            steps = [key for key in said if is_sampling(key)]
            if steps and not any(_is_time(column) for column in columns):
                said |= {key: with_unit(said[key], text) for key in steps if not is_rate(key)}
                continue
        columns = _assigned(columns, kind, name, about, text)
    columns = _listed(columns)
    scaled = [
        new
        for new, old in zip(columns, table.columns, strict=True)
        if (new.scale, new.offset) != (old.scale, old.offset)
    ]
    notes = tuple(
        f"the values of {c.name!r} were multiplied by {1.0 if c.scale is None else c.scale:g}"
        f"{f', and {c.offset:g} was added' if c.offset else ''}, as the file states"
        for c in scaled
    )
    return table._replace(
        columns=tuple(map(_applied, columns)), said=said, notes=table.notes + notes
    )


def _listed(columns: list[ChannelColumn]) -> list[ChannelColumn]:
    """Add a doubt to columns if another column lists units or scales without naming channels.

    A list with the length of the channels, such as a gain over frequency, is a channel.
    """
    with_doubts = columns
    longest = max((len(column.values) for column in columns), default=0)
    for column in columns:
        kind, _ = kind_of(column.name)
        words = column.values.dtype.kind not in _NUMBERS + "c"
        units = kind in ("unit", "time_unit")
        if kind is None or units != words or (not words and len(column.values) == longest):
            continue
        some = ", ".join(str(value) for value in column.values[:4])
        doubt = f"{column.name} = {shown(some)}, which does not state the channel of each value"
        with_doubts = [
            doubtful(other, doubt)
            if other.name != column.name and (other.unit is None if units else is_channel(other))
            else other
            for other in with_doubts
        ]
    return with_doubts


def _assigned(
    columns: list[ChannelColumn], kind: Kind, name: str, about: str, text: str
) -> list[ChannelColumn]:
    """Assign a stated unit, scale or offset to the columns that it refers to."""
    free = [c for c in columns if is_channel(c) and ("unit" not in kind or c.unit is None)]
    meant = _named(columns, about)
    if not meant and about and "unit" in kind:
        spoken = meaning(about)
        quantity = QUANTITIES.get(spoken.variable) if spoken else None
        if kind == "time_unit":
            quantity = AXES["time"]
        meant = [c for c in columns if quantity and c.unit is None and _quantity(c) is quantity]
    if not meant and not about and len(free) == 1:
        meant = free
    if meant:
        return [_with(c, kind, name, text) if _in(c, meant) else c for c in columns]
    if not doubted(kind, text):
        return columns
    which = (
        "which belongs to one channel, but there are several"
        if not about
        else (f"but there is no channel {about!r}")
    )
    return [doubtful(c, f"{name} = {shown(text)}, {which}") if _in(c, free) else c for c in columns]


def doubted(kind: Kind, text: str) -> bool:
    """Return whether a statement has any content, even if it is invalid."""
    read, doubt = one(kind, text, text)
    return bool(doubt) or (read is not None and read not in (1.0 if kind == "scale" else 0.0,))


def _with(column: ChannelColumn, kind: Kind, name: str, text: str) -> ChannelColumn:
    """Return a column with a stated unit, scale or offset."""
    read, doubt = one(kind, text, text)
    if doubt:
        return doubtful(column, f"{name} = {shown(text)}, which {doubt}")
    if read is None:
        return column
    if isinstance(read, str):
        unit, doubt = agreed(column.unit, read)
        return doubtful(column._replace(unit=unit), doubt)
    already = column.scale if kind == "scale" else column.offset
    if already is not None:
        return doubtful(column, f"{name} = {shown(text)} in addition to the {kind} {already:g}")
    return column._replace(scale=read) if kind == "scale" else column._replace(offset=read)


def _applied(column: ChannelColumn) -> ChannelColumn:
    """Return a column with its scale and offset applied to its values."""
    scale = 1.0 if column.scale is None else column.scale
    offset = column.offset or 0.0
    if scale == 1.0 and offset == 0.0:
        return column._replace(scale=None, offset=None)
    if column.values.dtype.kind not in _NUMBERS + "c":
        return doubtful(
            column._replace(scale=None, offset=None), "a scale for a column that is not numeric"
        )
    values = column.values * scale + offset
    return column._replace(values=values, scale=None, offset=None)


def _in(column: ChannelColumn, some: Iterable[ChannelColumn]) -> bool:
    return any(column is other for other in some)


def _named(columns: list[ChannelColumn], about: str) -> list[ChannelColumn]:
    return [column for column in columns if about and _plain(column.name) == about]


def _plain(name: str) -> str:
    return "".join(words_in(name))


def _quantity(column: ChannelColumn) -> object:
    column_meaning = meaning(column.name)
    return QUANTITIES.get(column_meaning.variable) if column_meaning else None


def _is_time(column: ChannelColumn) -> bool:
    return _quantity(column) is AXES["time"]


def is_channel(column: ChannelColumn) -> bool:
    """Return whether a column holds numbers other than a time, a frequency or a direction."""
    column_meaning = meaning(column.name)
    other = column_meaning is not None and column_meaning.variable in (*AXES, "direction")
    return column.values.dtype.kind in _NUMBERS and not other
