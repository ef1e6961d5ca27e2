"""The USGS's SMC files: 11 lines of text, 48 integers, 50 reals, comments, then values in cm/s².

Integer 17 is the number of values, integer 16 is the number of comments, and real 2 is the number
of samples per second. There may be no blanks between values. Therefore all values are read with the
width of the first one.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.tables.file import File

_KIND = re.compile(r"\s*\d\s+(?:UNKNOWN|(?:UN)?CORRECTED ACCELEROGRAM|ACCELEROGRAM)")
_TEXT, _INTEGERS, _REALS = 11, 6, 10
_NAMES = re.compile(r"station\s*=\s*(.*?)\s*component\s*=\s*(.*?)\s*$")
_FIRST = re.compile(r"\s*[-+]?\d*\.\d*(?:[ED][-+]\d+)?", re.IGNORECASE)
_ABSENT = 1e38


def recognises(file: File) -> bool:
    """Return whether a file has this format: its first line states the kind of accelerogram."""
    lines = file.lines
    return len(lines) > 1 and bool(_KIND.match(lines[0])) and lines[1].startswith("*")


def read(file: File) -> list[Channel]:
    """Read the component of a file."""
    file.line(_TEXT + _INTEGERS + _REALS)
    integers, at = file.numbers(_TEXT, 48, 10)
    reals, at = file.numbers(at, 50, 15)
    count, comments, rate = int(integers[16]), int(integers[15]), float(reals[1])
    if count < 1:
        raise file.refused(_TEXT + 2, f"the header states {count} values; at least 2 are accepted")
    for _ in range(max(comments, 0)):
        if not file.line(at).startswith("|"):
            told = (
                f"the header states {comments} comments, but this line is not a comment; a line "
                "that begins with '|' is accepted"
            )
            raise file.refused(at, told)
        at += 1
    first = _FIRST.match(file.line(at))
    values, at = file.numbers(at, count, first.end() if first and first.end() else None)
    file.behind(at, count, first.end() if first else None)
    named = next((found for line in file.lines[:_TEXT] if (found := _NAMES.search(line))), None)
    code = file.lines[2].strip(" *")
    place = named[1] if named else ""
    return [
        Channel(
            values,
            1.0 / rate if 0.0 < rate < _ABSENT else None,
            "cm/s^2",
            f"{code}, {place}" if code and place else code or place,
            named[2] if named else "",
            (),
            f"line {_TEXT + _INTEGERS + 1}",
        )
    ]


FORMAT = Format("USGS SMC", recognises, read)
