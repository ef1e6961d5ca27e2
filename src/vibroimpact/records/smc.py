"""The USGS's SMC files: 11 lines of text, 48 integers, 50 reals, comments, then values in cm/s².

Integer 17 is the number of values, integer 16 is the number of comments, and real 2 is the number
of samples per second. There may be no blanks between values. Therefore all values are read with the
width of the first one.

Film records were digitised at uneven times. Their files state no number of samples per second, and
contain a time before each value. Integer 17 then counts times and values. Many of these files end
with one further line of numbers, which do not belong to the record.

Reals 29 to 32 are the time and the value of the maximum, then of the minimum.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import check_stated, read_peak, read_times
from vibroimpact.tables.file import File
from vibroimpact.tables.statements import StatedPeak

_KIND = re.compile(r"\s*\d\s+(?:UNKNOWN|(?:UN)?CORRECTED ACCELEROGRAM|ACCELEROGRAM)")
_TEXT, _INTEGERS, _REALS = 11, 6, 10
_NAMES = re.compile(r"station\s*=\s*(.*?)\s*component\s*=\s*(.*?)\s*$")
_FIRST = re.compile(r"\s*[-+]?\d*\.\d*(?:[ED][-+]\d+)?", re.IGNORECASE)
_ABSENT = 1e38
_EXTREMES = (29, 31)
_REALS_A_LINE, _REAL_WIDTH = 5, 15


def recognises(file: File) -> bool:
    """Return whether a file has this format: its first line states the kind of accelerogram."""
    lines = file.lines
    return len(lines) > 1 and bool(_KIND.match(lines[0])) and lines[1].startswith("*")


def read(file: File) -> list[Channel]:
    """Read the component of a file."""
    file.line(_TEXT + _INTEGERS + _REALS)
    integers, at = file.numbers(_TEXT, 48, 10)
    reals, at = file.numbers(at, 50, _REAL_WIDTH)
    count, comments, rate = int(integers[16]), int(integers[15]), float(reals[1])
    check_stated(file, _TEXT + 2, count)
    for _ in range(max(comments, 0)):
        if not file.line(at).startswith("|"):
            message = (
                f"the header states {comments} comments, but this line is not a comment; "
                "begin each with '|'"
            )
            raise file.refused(at, message)
        at += 1
    first = _FIRST.match(file.line(at))
    width = first.end() if first and first.end() else None
    numbers, after = file.numbers(at, count, width)
    named = next((match for line in file.lines[:_TEXT] if (match := _NAMES.search(line))), None)
    code = file.lines[2].strip(" *")
    place = named[1] if named else ""
    step = 1.0 / rate if 0.0 < rate < _ABSENT else None
    spaced = read_times(file, at, numbers[0::2]) if _has_times(numbers, step) else None
    values = numbers[1::2] if spaced else numbers
    notes: tuple[str, ...] = ()
    if spaced and (more := _one_line_more(file, after)):
        notes = (
            f"line {after + 1}, after the {count} numbers that the header announces, is not read",
        )
        after += more
    file.behind(after, count, width)
    return [
        Channel(
            values,
            spaced.step if spaced else step,
            "cm/s^2",
            f"{code}, {place}" if code and place else code or place,
            named[2] if named else "",
            (),
            f"line {_TEXT + _INTEGERS + 1}",
            notes=(*spaced.notes, *notes) if spaced else (),
            no_step=spaced.no_step if spaced else "",
            times=spaced.times if spaced else None,
            peaks=_peaks(file, reals),
        )
    ]


def _has_times(numbers: NDArray[np.float64], step: float | None) -> bool:
    """Return whether every other number, from the first one on, is a time (s).

    Times begin at 0 or later, never decrease, and have the stated step if there is one.
    """
    times = numbers[0::2]
    if len(numbers) % 2 or len(times) < 3 or times[0] < 0.0 or times[-1] <= times[0]:
        return False
    steps = np.diff(times)
    return bool(steps.min() >= 0.0 and (not step or np.abs(steps - step).max() < 0.5 * step))


def _one_line_more(file: File, at: int) -> bool:
    """Return whether one line of the file is left that is not blank."""
    left = [line for line in file.lines[at:] if line.strip()]
    return len(left) == 1 and file.lines[at].strip() != ""


def _peaks(file: File, reals: NDArray[np.float64]) -> tuple[StatedPeak, ...]:
    """The larger of the stated maximum and minimum."""
    if any(abs(reals[one]) >= _ABSENT for one in _EXTREMES):
        return ()
    larger = max(_EXTREMES, key=lambda one: abs(float(reals[one])))
    row, column = divmod(larger, _REALS_A_LINE)
    at = _TEXT + _INTEGERS + row
    text = file.lines[at][_REAL_WIDTH * column : _REAL_WIDTH * (column + 1)]
    return read_peak(at, text, "cm/s^2")


FORMAT = Format("USGS SMC", recognises, read)
