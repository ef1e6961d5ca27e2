"""Records as tables of numbers: values, or times and values, in columns or in two rows.

The numbers are separated by commas, semicolons or blanks. Commas within quotes, or together with
another separator, are decimal commas. Text after a ``#`` is ignored. The last line of words before
the numbers contains the names of the columns. Units are in brackets, at the end of a name, or in a
line below the names. A line before the numbers may contain ``dt = 0.01`` or ``units: cm/s^2``. Two
numbers above a single column are its length and its step. ``*** End Data ***`` ends a table.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.records.channel import Channel, Format
from vibroimpact.tables.decimal_mark import Decimal, decimal_mark, pointed
from vibroimpact.tables.file import File
from vibroimpact.tables.limits import few_columns
from vibroimpact.tables.units import (
    Units,
    are_units,
    is_acceleration,
    parted,
    stated_acceleration,
    stated_unit,
    unit_of,
    units_of,
)

_EVEN = 0.01
"""Largest deviation of a time, as a share of the step, that is not noted."""
_UNEVEN = 0.1
"""Largest deviation of times, as a share of the step, that count as even. It is noted."""
_ROUNDED = 0.25
"""Largest deviation of rounded times. A missing sample gives a deviation of 0.5."""
_STEP = re.compile(
    r"\b(?:dt|step|time step|sampling interval)\s*[=:]\s*"
    r"([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(s|sec|seconds|ms)?\s*$",
    re.IGNORECASE,
)
_END = re.compile(r"\W*end\W+(?:of\W+)?(?:the\W+)?(?:data|file|record)\W*", re.IGNORECASE)
_WORD = re.compile(r"[^\s(\[]+(?:\s*(?:\([^)]*\)|\[[^\]]*\]))?")
"""A name between blanks, which may be followed by a unit in brackets."""
_IN_A_SECOND = {"s": 1.0, "ms": 1e3, "us": 1e6, "µs": 1e6, "-": 1.0, "": 1.0}
_Array = NDArray[np.float64]


def read(file: File) -> list[Channel]:
    """Read the columns of a file, except for the column of times."""
    if not file.lines:
        raise InputError(
            f"record: {file.path!r} is not text; pass a text file with columns of numbers"
        )
    decimal = file.decimal or decimal_mark(file.lines, f"record: {file.path!r}")
    rows, lines, words = _numbers(file, decimal)
    if not rows:
        raise InputError(f"record: {file.path!r} has no numbers; pass a file with number columns")
    step = _stated(words)
    if len(rows) > 2 and len(rows[0]) == 2 and len(rows[1]) == 1:
        count, step = rows[0]
        if count != len(rows) - 1:
            raise file.refused(
                lines[0],
                f"the file announces {count:g} values, but {len(rows) - 1} follow; "
                "correct this number, or pass a complete file",
            )
        rows, lines = rows[1:], lines[1:]
    table = _table(file, rows, lines)
    few_columns(table.shape[1], file.path, "record")
    for i, j in np.argwhere(~np.isfinite(table))[:1]:
        at = lines[i] if len(lines) == len(table) else lines[0]
        raise file.refused(at, f"{table[i, j]} is not finite; replace it by a finite number")
    stated = [unit for line in reversed(words) if (unit := stated_unit(line))]
    general = stated[0] if stated else None
    # Others may be of the times.
    above = tuple(unit for unit in stated if is_acceleration(unit))
    if table.shape[1] == 1:
        own = general or _of_one(words)
        return [Channel(table[:, 0], step, own, others=above)]
    names, units = _names(words, table.shape[1])
    spacing, note, uneven = _spacing(file, table[:, 0], lines, units[0])
    return [
        Channel(
            table[:, column],
            spacing,
            units[column].unit or general,
            component=parted(names[column])[0] if table.shape[1] > 2 else "",
            others=(*above, *(unit for unit in units[column][1:2] if unit)),
            of_name=units[column].of_name,
            notes=(note,) if note else (),
            uneven=uneven,
        )
        for column in range(1, table.shape[1])
    ]


def _numbers(file: File, decimal: Decimal) -> tuple[list[list[float]], list[int], list[str]]:
    """The numbers of each line, from the first that has some; their lines; the words above."""
    rows: list[list[float]] = []
    lines: list[int] = []
    words: list[str] = []
    ended = False
    for at, whole in enumerate(file.lines):
        line = whole.split("#")[0].strip()
        if rows and _END.fullmatch(line):
            ended = True
            continue
        numbers = (pointed(line) if decimal == "," else line).replace('"', " ").replace("'", " ")
        parts = [part for part in re.split(r"[,;\s]+", numbers) if part]
        if not parts:
            if not rows:
                words.append(whole.strip("# \t"))
            continue
        try:
            row = [float(part) for part in parts]
        except ValueError:
            if rows:
                told = f"{whole.strip()[:40]!r} is not a row of numbers; after the first row of "
                raise file.refused(at, f"{told}numbers, only numbers are accepted") from None
            words.append(line)
            continue
        if ended:
            raise file.refused(
                at, "numbers follow the end of the data; a file with one record is accepted"
            )
        rows.append(row)
        lines.append(at)
    return rows, lines, words


def _stated(words: list[str]) -> float | None:
    """A step that stands above the numbers, in s."""
    for line in words:
        if found := _STEP.search(line):
            return float(found[1]) * (1e-3 if (found[2] or "").lower() == "ms" else 1.0)
    return None


def _of_one(words: list[str]) -> str | None:
    """The unit of a single column: of an acceleration, or what the line above it ends in."""
    for line in reversed(words):
        if unit := stated_acceleration(line):
            return unit
    last = words[-1] if words else ""
    return None if re.search(r"[:=]", last) else unit_of(last)


def _names(words: list[str], columns: int) -> tuple[list[str], list[Units]]:
    """The names of the columns and their units; none where no line has as many."""
    under: list[str] | None = None
    for line in reversed(words):
        names = [name.strip().strip("\"'").strip() for name in re.split(r"[,;\t]", line)]
        if len(names) != columns:
            names = _WORD.findall(line)
            if len(names) == columns and not any(unit_of(name) for name in names):
                continue  # a sentence
        if len(names) != columns or not any(names):
            continue
        if under is None and columns > 1 and are_units(names):
            under = [name.strip("[]() ") for name in names]
            continue
        beneath: list[str | None] = [*under] if under else [None] * columns
        return names, list(map(units_of, names, beneath))
    units: list[str | None] = [*under] if under else [None] * columns
    return (
        ["", *(str(column) for column in range(1, columns))],
        [units_of("", unit) for unit in units],
    )


def _table(file: File, rows: list[list[float]], lines: list[int]) -> _Array:
    """Rows of one width; two long rows are columns."""
    widths = [len(row) for row in rows]
    for at, width in zip(lines, widths, strict=True):
        if width != widths[0]:
            told = f"the row has {width} number{'' if width == 1 else 's'}, but the rows above "
            raise file.refused(at, f"{told}have {widths[0]}; make all rows equally long")
    table = np.array(rows)
    return table.T if len(rows) == 2 and widths[0] > 2 else table


def _spacing(
    file: File, times: _Array, lines: list[int], stated: Units
) -> tuple[float | None, str, str]:
    """The time between samples; what is noted of it; or why there is none that is the same.

    Raises
    ------
    InputError
        If the unit of the times is not known.
    """
    if len(times) < 2:
        raise InputError(f"record: {file.path!r} has one sample; pass at least two samples")
    unit = stated.unit
    each = _IN_A_SECOND.get(unit or "s")
    if each is None:
        raise InputError(
            f"record: {file.path!r}: its times are in {unit!r}; convert them to s, ms or us"
        )
    for other in (stated.other, stated.of_name):
        if other and _IN_A_SECOND.get(other) != each:
            told = f"its times are in {unit!r} and in {other!r}; use one unit, or pass step= "
            return None, "", f"{told}(--step), which replaces the times"
    step = float((times[-1] - times[0]) / (len(times) - 1))
    off = times - (times[0] + step * np.arange(len(times)))
    worst = int(np.abs(off).argmax()) if step > 0.0 else 0
    if step > 0.0 and abs(off[worst]) <= _EVEN * step:
        return step / each, "", ""
    within = max(_UNEVEN * step, min(0.8 * _digit(times), _ROUNDED * step))
    # A sample that is missing shifts those behind it by a whole step, wherever it is.
    if step > 0.0 and 0.5 * np.ptp(off) <= within:
        told = f"its times are uneven by up to {abs(off[worst]) / each:.3g} s"
        return step / each, f"{told}, so the average step of {step / each:.6g} s is used", ""
    row = file.lines[lines[0]]
    may_be = "," in row and "." not in row and file.decimal is None
    hint = "; decimal=',' (--decimal ,) reads decimal commas" if may_be else ""
    where = f"line {lines[worst] + 1}" if len(lines) == len(times) else f"sample {worst}"
    return (
        None,
        "",
        f"{where}: its time {times[worst]:g} s is not evenly spaced (steps of {step / each:g} s on "
        f"average); make the steps equal, or pass step= (--step), which replaces the times{hint}",
    )


def _digit(times: _Array) -> float:
    """The size of the last digit that the times are written with."""
    for decimals in range(7):
        if np.abs(np.round(times, decimals) - times).max() < 1e-9 * max(1.0, abs(times[-1])):
            return float(10.0**-decimals)
    return 0.0


FORMAT = Format("columns", lambda file: True, read)
