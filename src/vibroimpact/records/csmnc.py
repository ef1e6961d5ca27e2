"""Files of the China Strong Motion Networks Centre: lines of text, then values in eight columns.

The lines state the component, the unit, the number of values, their step, their duration and their
peak.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import check_stated, duration_conflict, read_peak
from vibroimpact.tables.file import File
from vibroimpact.tables.units import spelled

_NUMBER = r"([-+]?\d*\.?\d+)"
_COUNT = rf"\s*NO\. OF POINTS:?\s*(\d+)\s+EQUALLY SPACED INTERVALS? OF:?\s*{_NUMBER}\s*SEC"
_UNIT = r".*\bACCELERATION\b.*\bUNIT:\s*(\S*)"
_PEAK = rf"\s*(PEAK VALUE:?\s*{_NUMBER})"
_DURATION = rf".*\b(DURATION:?\s*{_NUMBER}\s*SEC)"

_VALUES = re.compile(rf"\s*{_NUMBER}(?:[ED][-+]?\d+)?(?:\s.*)?", re.IGNORECASE)


def recognises(file: File) -> bool:
    """Return whether a file has this format: a line with the number of points and their step."""
    return file.find_line(_COUNT, last=40) is not None


def read(file: File) -> list[Channel]:
    """Read the component of a file."""
    counted, points = file.require_line(_COUNT, "the number of points")
    count, step = int(points[1]), float(points[2])
    check_stated(file, counted, count)
    at = counted + 1
    while not _VALUES.fullmatch(file.line(at)):
        at += 1
    values, after = file.numbers(at, count)
    file.behind(after, count)
    unit = file.find_line(_UNIT, last=at)
    named = spelled(unit[1][1]) if unit else ""
    station = file.find_line(r"\s*STATION:\s*(\S*)", last=at)
    component = file.find_line(r"\s*COMP\.\s*(\S*)", last=at)
    peak = file.find_line(_PEAK, last=at)
    lasts = file.find_line(_DURATION, last=at)
    problem = ""
    if lasts and step > 0.0:
        problem = duration_conflict(lasts[0], lasts[1][2], lasts[1][1], count, step)
    return [
        Channel(
            values,
            step if step > 0.0 else None,
            named or None,
            station[1][1] if station else "",
            component[1][1] if component else "",
            where=f"line {counted + 1}",
            no_step=problem,
            peaks=read_peak(peak[0], peak[1][2], None, peak[1][1]) if peak else (),
        )
    ]


FORMAT = Format("CSMNC", recognises, read)
