"""LabVIEW's measurement files (``.lvm``): lines of ``key, value``, then columns of numbers.

The header states the separator, the decimal mark, and the number of columns of times. The header of
each segment states the unit, the first time and the step of each channel.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.records.channel import Channel, Format
from vibroimpact.tables.file import File
from vibroimpact.tables.times import spacing
from vibroimpact.tables.units import spelled, units_of

_MARKS = {"tab": "\t", "comma": ",", "space": " ", "semicolon": ";"}
_END = "***end_of_header***"
_COMMENT = "comment"
_X = "x_value"


class Signal(NamedTuple):
    """One channel of a segment."""

    name: str
    times: NDArray[np.float64]
    """Times of the values (s), or their values on another axis."""
    step: float | None
    """Step in s. None if the header does not state it."""
    values: NDArray[np.float64]
    axis: str = "time"
    """Name of the axis, if it is not the time."""
    label: str | None = None
    """Unit of the values. None if the header does not state it."""


def recognises(file: File) -> bool:
    """Return whether a file has this format: its first line names it."""
    return bool(file.lines) and file.lines[0].lower().startswith("labview measurement")


def segments(file: File) -> list[list[Signal]]:
    """Read the channels of each segment.

    Raises
    ------
    InputError
        If a header has no end, or if a line is not a row of numbers.
    """
    about: dict[str, list[str]] = {}
    mark, decimal = "\t", "."
    at = 0
    while at < len(file.lines) and "separator" not in about:
        line = file.lines[at]
        if line.lower().startswith("separator"):
            word = line[len("separator") :].strip(" \t,;").lower()
            mark = _MARKS.get(word, "\t")
            about["separator"] = [word]
        at += 1
    at = _header(file, 1, mark, about)
    decimal = (about.get("decimal_separator") or ["."])[0] or "."
    all_segments = []
    while True:
        while at < len(file.lines) and not file.lines[at].strip():
            at += 1
        if at >= len(file.lines):
            break
        own = dict(about)
        if not _names(file.lines[at], mark):
            at = _header(file, at, mark, own)
        signals, at = _segment(file, at, mark, decimal, own)
        all_segments.append(signals)
    return all_segments


def _cells(line: str, mark: str) -> list[str]:
    return [cell.strip() for cell in line.split(mark)]


def _names(line: str, mark: str) -> bool:
    """Whether a line names columns."""
    return _cells(line, mark)[0].lower() == _X


def _header(file: File, at: int, mark: str, about: dict[str, list[str]]) -> int:
    """Read lines of keys; return the line after them."""
    first = at
    while at < len(file.lines):
        key, *values = _cells(file.lines[at], mark)
        at += 1
        if key.lower() == _END:
            return at
        if key:
            about[key.lower()] = values
    raise file.refused(first, "the header has no end; '***End_of_Header***' is expected")


def _segment(
    file: File, at: int, mark: str, decimal: str, about: dict[str, list[str]]
) -> tuple[list[Signal], int]:
    if at >= len(file.lines) or not _names(file.lines[at], mark):
        raise file.refused(
            min(at, len(file.lines) - 1), "there are no column names; X_Value is expected"
        )
    names = _cells(file.lines[at], mark)
    above = at
    at += 1
    columns: list[list[float]] = [[] for _ in names]
    while at < len(file.lines) and file.lines[at].strip():
        cells = _cells(file.lines[at], mark)
        if cells[0].lower() in ("channels", _X):
            break  # the next segment
        for name, cell, column in zip(names, cells, columns, strict=False):
            if name.lower() != _COMMENT:
                column.append(_number(file, at, cell, decimal))
        at += 1
    times: list[float] = []
    signals: list[Signal] = []
    for name, column in zip(names, columns, strict=True):
        if name.lower() == _X:
            times = column
        elif name and name.lower() != _COMMENT:
            signals.append(_signal(file, above, name, times, column, about, len(signals), decimal))
    return signals, at


def _signal(
    file: File,
    above: int,
    name: str,
    times: list[float],
    values: list[float],
    about: dict[str, list[str]],
    number: int,
    decimal: str,
) -> Signal:
    def channel_field(key: str) -> str:
        listed = about.get(key, [])
        return listed[number] if number < len(listed) else ""

    unit = channel_field("y_unit_label") or None
    y = np.array(values)
    known = np.isfinite(y)
    count = int(np.flatnonzero(known)[-1]) + 1 if known.any() else 0
    step = _number(file, above, channel_field("delta_x"), decimal)
    first = _number(file, above, channel_field("x0"), decimal)
    x = np.array(times[:count])
    if len(x) < count or not np.isfinite(x).all():
        start = first if np.isfinite(first) else 0.0
        x = start + step * np.arange(count)
    stated = float(step) if step > 0.0 else None
    axis = channel_field("x_dimension").lower() or "time"
    return Signal(name, x, stated, y[:count], axis, spelled(unit) if unit else None)


def _number(file: File, at: int, cell: str, decimal: str) -> float:
    """A cell; NaN where it is empty."""
    if not cell:
        return float("nan")
    try:
        return float(cell.replace(decimal, "."))
    except ValueError:
        raise file.refused(at, f"{cell[:40]!r} is not a number; write a number") from None


def read(file: File) -> list[Channel]:
    """Read the channels of a file that has one segment."""
    all_segments = segments(file)
    if len(all_segments) != 1:
        raise file.refused(
            0, f"the file has {len(all_segments)} segments; use a file with one segment"
        )
    channels = []
    for signal in all_segments[0]:
        if signal.axis != "time":
            message = f"{signal.name!r} is a function of {signal.axis!r}; use values over time"
            raise file.refused(0, message)
        step = signal.step
        if step is None and len(signal.times) > 1 and (even := spacing(signal.times)).is_exact:
            step = even.step
        if not np.isfinite(signal.values).all():
            raise file.refused(0, f"{signal.name!r} has missing values; use a complete record")
        unit, other, of_name = units_of(signal.name, signal.label)
        channels.append(
            Channel(
                signal.values,
                step,
                unit,
                component=signal.name,
                where="its header",
                others=(other,) if other else (),
                of_name=of_name,
            )
        )
    return channels


FORMAT = Format("LabVIEW", recognises, read)
