"""PEER's AT2 files: four lines of header, then values in lines of any length.

The fourth line states the number of values and the step, in one of three ways::

    NPTS=   7999, DT=   .0050 SEC,
    NPTS=  15306, DT=    0.05 SEC
    4096    0.0100    NPTS, DT

The third line states the unit, as ``IN UNITS OF G`` or ``The units are (g)``. The second line
states event, date, station and component, separated by commas.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import check_stated
from vibroimpact.tables.file import File
from vibroimpact.tables.units import stated_acceleration, stated_unit

_NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[ED][-+]?\d+)?)"
_COUNT = re.compile(r"NPTS\s*=\s*(\d+)", re.IGNORECASE)
_STEP = re.compile(rf"\bDT\s*=\s*{_NUMBER}", re.IGNORECASE)
_BEFORE = re.compile(rf"^\s*(\d+)\s+{_NUMBER}\s+NPTS\s*,\s*DT", re.IGNORECASE)
_NAMED = re.compile(r"\bNPTS\b", re.IGNORECASE)
_OF_PEER = re.compile(r"\bNPTS\s*[=,]", re.IGNORECASE)
_COMMENT = re.compile(r"\s*(?:[#%!]|//)")
_SEARCHED = 12


def _announced(file: File, first: int = 0, last: int = _SEARCHED) -> int | None:
    """The line with the count and the step."""
    for at, line in enumerate(file.lines[first:last], start=first):
        if _NAMED.search(line):
            return at
    return None


def recognises(file: File) -> bool:
    """Return whether a file has this format: one of its first lines contains NPTS.

    This line is not a comment, and no further line of words follows it, nor a table of columns with
    as many rows as the line states values.
    """
    at = _announced(file)
    if at is None or not _OF_PEER.search(line := file.lines[at]) or _COMMENT.match(line):
        return False
    rows = [line for line in file.lines[at + 1 :] if line.strip()]
    behind = rows[0] if rows else ""
    count = _COUNT.search(line) or _BEFORE.match(line)
    if count and int(count[1]) == len(rows) > 1 and len(re.findall(r"[^,;\s]+", behind)) > 1:
        return False
    return not re.search(r"(?i)[a-z]*[a-df-z][a-z]{2}", behind.lower().replace("nan", ""))


def read(file: File) -> list[Channel]:
    """Read the component of a file."""
    at = _announced(file)
    assert at is not None
    line = file.lines[at]
    step: float | None
    if before := _BEFORE.match(line):
        count, step = int(before[1]), _float(before[2])
    else:
        count_match, stepped = _COUNT.search(line), _STEP.search(line)
        if count_match is None:
            raise file.refused(at, f"{line.strip()!r} states no number of values; add NPTS=")
        count, step = int(count_match[1]), _float(stepped[1]) if stepped else None
    check_stated(file, at, count)
    values, behind = file.numbers(at + 1, count)
    again = _announced(file, behind, len(file.lines))
    if again is not None:
        raise file.refused(again, "a second header starts here; use one record per file")
    file.behind(behind, count)
    above = file.lines[: at + 1]
    unit = next((unit for line in above if (unit := stated_unit(line))), None)
    if unit is None:
        # In brackets only where a description of the values stands: stations have brackets, too.
        unit = next((unit for line in above[-2:-1] if (unit := stated_acceleration(line))), None)
    names = [part.strip() for part in file.lines[at - 2].split(",")] if at >= 2 else []
    component = names[-1] if len(names) > 2 else ""
    return [
        Channel(
            values,
            step or None,
            unit,
            names[-2] if len(names) > 2 else "",
            component,
            (component.split()[0],) if component else (),
            f"line {at + 1}",
        )
    ]


def _float(text: str) -> float:
    return float(text.upper().replace("D", "E"))


FORMAT = Format("PEER AT2", recognises, read)
