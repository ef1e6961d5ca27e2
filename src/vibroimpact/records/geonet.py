"""GeoNet's V1A and V2A files: each component has 16 lines of text, 4 of integers and 6 of reals.

Columns have 8 characters, and a line has ten columns. Integers 34, 35 and 36 are the numbers of
values of acceleration, velocity and displacement. Real 26 is the step. Accelerations are in mm/s².
Lines of text repeat the number of values, and state the duration and the peak.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import check_stated, duration_conflict, each_channel, read_peak
from vibroimpact.tables.file import File
from vibroimpact.tables.statements import StatedPeak

_TEXT = 16
_WIDTH = 8
_POINTS = re.compile(r"Number of points\s+(\d+)\s+Duration\s+(\d+\.?\d*)", re.IGNORECASE)
_PEAK = re.compile(r"Acceleration:\s*Peak\s+([-+]?\d+\.?\d*)\s*(mm/s/s)", re.IGNORECASE)


def recognises(file: File) -> bool:
    """Return whether a file has this format: its first lines name an accelerogram and a site."""
    lines = file.lines
    return len(lines) > 2 and _begins(lines[0]) and lines[1].startswith("Site ")


def read(file: File) -> list[Channel]:
    """Read the components of a file."""
    return each_channel(file, _component)


def _begins(line: str) -> bool:
    return "corrected accelerogram" in line.lower()


def _component(file: File, first: int) -> tuple[Channel, int]:
    if not _begins(file.line(first)):
        raise file.refused(
            first,
            f"{file.lines[first].strip()[:40]!r} does not start a component; "
            "start it with 'Uncorrected accelerogram' or 'Corrected accelerogram'",
        )
    integers, at = file.numbers(first + _TEXT, 40, _WIDTH)
    reals, at = file.numbers(at, 60, _WIDTH)
    counts = [int(count) for count in integers[33:36]]
    check_stated(file, first + _TEXT + 3, counts[0], "values of acceleration")
    values, at = file.numbers(at, counts[0], _WIDTH)
    for count in counts[1:]:
        _, at = file.numbers(at, count, _WIDTH)
    words = file.lines[first + 12].split()
    step = float(reals[25])
    problem = ""
    peaks: tuple[StatedPeak, ...] = ()
    for line in range(first, first + _TEXT):
        if points := _POINTS.match(file.lines[line]):
            if int(points[1]) != counts[0]:
                raise file.refused(
                    line,
                    f"the header announces {points[1]} values here, but {counts[0]} in line "
                    f"{first + _TEXT + 4}; correct the header",
                )
            if step > 0.0:
                problem = duration_conflict(line, points[2], points[0], counts[0], step)
        if peak := _PEAK.match(file.lines[line]):
            peaks = read_peak(line, peak[1], peak[2], peak[0])
    return (
        Channel(
            values,
            step if step > 0.0 else None,
            "mm/s^2",
            ", ".join([file.lines[first + 1].split()[1], file.lines[first + 2].strip()]),
            words[1] if len(words) > 1 else "",
            (),
            f"line {first + 23}",
            no_step=problem,
            peaks=peaks,
        ),
        at,
    )


FORMAT = Format("GeoNet", recognises, read)
