"""Records as plain numbers: values alone, or times and values, in columns or in two rows.

Apart by commas, semicolons or blanks. Lines before the first number, and what follows a ``#``, are
left out; the last line of words before the numbers names the columns, with units in brackets if
there are some, and a line there may say ``dt = 0.01``. Two numbers above a single column are its
length and its step.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.file import File

_EVEN = 0.01
"""By how much of a step a time may be off: files round theirs."""
_STEP = re.compile(
    r"\b(?:dt|step|time step|sampling interval)\s*[=:]\s*"
    r"([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(s|sec|seconds|ms)?\s*$",
    re.IGNORECASE,
)
_BRACKETS = re.compile(r"[\[(]\s*([^\[\]()]+?)\s*[\])]")
_Array = NDArray[np.float64]


def read(file: File) -> list[Channel]:
    """The columns of a file, that of the time left out."""
    if not file.lines:
        raise InputError(f"record: {file.path!r} is not text; columns of numbers are accepted")
    rows, lines, words = _numbers(file)
    if not rows:
        raise InputError(f"record: {file.path!r} has no numbers; columns of them are accepted")
    step = _stated(words)
    if len(rows) > 2 and len(rows[0]) == 2 and len(rows[1]) == 1:
        count, step = rows[0]
        if count != len(rows) - 1:
            raise file.refused(
                lines[0], f"{count:g} values are announced, and {len(rows) - 1} follow"
            )
        rows, lines = rows[1:], lines[1:]
    table = _table(file, rows, lines)
    for i, j in np.argwhere(~np.isfinite(table))[:1]:
        at = lines[i] if len(lines) == len(table) else lines[0]
        raise file.refused(at, f"{table[i, j]} is not finite; finite samples are accepted")
    if table.shape[1] == 1:
        return [Channel(table[:, 0], step, _unit(_names(words, 1)[-1]))]
    names = _names(words, table.shape[1])
    spacing = _spacing(file, table[:, 0], lines)
    return [
        Channel(
            table[:, column],
            spacing,
            _unit(names[column]),
            component=_BRACKETS.sub("", names[column]).strip() if table.shape[1] > 2 else "",
        )
        for column in range(1, table.shape[1])
    ]


def _numbers(file: File) -> tuple[list[list[float]], list[int], list[str]]:
    """The numbers of each line, from the first that has some; their lines; the words above."""
    rows: list[list[float]] = []
    lines: list[int] = []
    words: list[str] = []
    for at, whole in enumerate(file.lines):
        line = whole.split("#")[0].strip()
        parts = [part for part in re.split(r"[,;\s]+", line) if part]
        if not parts:
            if not rows:
                words.append(whole.strip("# \t"))
            continue
        try:
            rows.append([float(part) for part in parts])
        except ValueError:
            if rows:
                told = f"{whole.strip()[:40]!r} is no row of numbers; numbers are accepted from "
                raise file.refused(at, f"{told}the first row of them on") from None
            words.append(line)
            continue
        if ";" in line and "," in line:
            told = "commas beside semicolons; decimal points are accepted"
            raise file.refused(at, told)
        lines.append(at)
    return rows, lines, words


def _stated(words: list[str]) -> float | None:
    """A step that stands above the numbers, in s."""
    for line in words:
        if found := _STEP.search(line):
            return float(found[1]) * (1e-3 if (found[2] or "").lower() == "ms" else 1.0)
    return None


def _names(words: list[str], columns: int) -> list[str]:
    """The names of the columns, empty where no line has as many."""
    for line in reversed(words):
        names = [name.strip() for name in re.split(r"[,;\t]", line)]
        if len(names) == columns and any(names):
            return names
    return [""] + [str(column) for column in range(1, columns)]


def _unit(name: str) -> str | None:
    """What stands in brackets."""
    found = _BRACKETS.search(name)
    return found[1] if found else None


def _table(file: File, rows: list[list[float]], lines: list[int]) -> _Array:
    """Rows of one width; two long rows are columns."""
    widths = [len(row) for row in rows]
    for at, width in zip(lines, widths, strict=True):
        if width != widths[0]:
            raise file.refused(at, f"a row of {width} numbers, where those above have {widths[0]}")
    table = np.array(rows)
    return table.T if len(rows) == 2 and widths[0] > 2 else table


def _spacing(file: File, times: _Array, lines: list[int]) -> float:
    """The time between samples, which must be the same everywhere."""
    if len(times) < 2:
        raise InputError(f"record: {file.path!r} has one sample; at least 2 are accepted")
    step = float((times[-1] - times[0]) / (len(times) - 1))
    off = np.abs(times - (times[0] + step * np.arange(len(times))))
    if not step > 0.0 or off.max() > _EVEN * step:
        worst = int(off.argmax()) if step > 0.0 else 0
        where = f"line {lines[worst] + 1}" if len(lines) == len(times) else f"sample {worst}"
        raise InputError(
            f"record: {file.path!r}, {where}: its time {times[worst]:g} s is not evenly "
            f"spaced (steps of {step:g} s on average); equal steps are accepted"
        )
    return step


FORMAT = Format("columns", lambda file: True, read)
