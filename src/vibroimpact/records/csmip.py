"""CSMIP's V1 and V2 files: channels one after the other, each with its own header.

The line above the values of the acceleration states their number, their unit, and the step or the
number of samples per second. In newer files it also states the columns. In older files, each line
has eight values. In V2 files, velocities and displacements follow.

In V1 files of the early 1990s, no line stands above the values: the header of 27 lines is followed
by pairs of a time and a value, five per line in columns of 7 characters. The values are in G/10.
RENADIC, the network of the Universidad de Chile, writes its V1 files in this form.

Source: A. F. Shakal and M. J. Huang (1985), Standard tape format for CSMIP strong-motion data
tapes, report OSMS 85-03.
"""

from __future__ import annotations

import re
from typing import Any

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import (
    check_stated,
    duration_conflict,
    each_channel,
    read_peak,
    read_times,
)
from vibroimpact.tables.file import File
from vibroimpact.tables.units import spelled

_BEGINS = re.compile(r"\s*(?:UN)?CORRECTED ACCELEROGRAM", re.IGNORECASE)
_RAW = re.compile(r"\s*UNCORRECTED", re.IGNORECASE)
_DATA = re.compile(r"\s*(\d+)\s+(?:POINTS OF ACCEL|ACCELEROGRAM POINTS)", re.IGNORECASE)
_OTHER = re.compile(r"\s*(\d+)\s+POINTS OF (?:VELOC|DISPL)", re.IGNORECASE)
_STEP = re.compile(r"SPACED AT\s*(\d*\.?\d+)\s*SEC", re.IGNORECASE)
_RATE = re.compile(r"AT\s*(\d*\.?\d+)\s*PTS/SEC", re.IGNORECASE)
_COLUMNS = re.compile(r"\(\s*\d+F(\d+)\.", re.IGNORECASE)
_UNIT = re.compile(r"\b(?:UNITS?(?:\s*:|\s+OF)|IN(?!\s+UNITS))\s*([A-Z][A-Z0-9/]*)", re.IGNORECASE)
_COUNT = re.compile(r"\s*NO\. OF POINTS\s*=\s*(\d+)", re.IGNORECASE)
_LENGTH = re.compile(r".*\b(RECORD LENGTH\s*=\s*(\d*\.?\d+)\s*SEC)", re.IGNORECASE)
_RAW_UNIT = re.compile(
    r"\s*UNITS OF UNCOR\w*\s+\w+\s+(?:ARE|IS)\s+(?:SEC\s+AND\s+)?(?!SEC\b)([A-Z][A-Z0-9/]*)",
    re.IGNORECASE,
)
_RAW_PEAK = re.compile(
    r"\s*UNITS OF UNCOR.*\b(MAX\s*=\s*([-+]?\d*\.?\d+)\s*([A-Z][A-Z0-9/]*))",
    re.IGNORECASE,
)
_PEAK = re.compile(
    r"\s*(PEAK\s+ACCELERATION\s*=\s*([-+]?\d*\.?\d+)\s*([A-Z][A-Z0-9/]*))",
    re.IGNORECASE,
)
_TOWARDS = re.compile(r"\s*CHAN\s+(\d+)\s*:\s*(.*?)\s*(?:\(STA CHN:.*)?$", re.IGNORECASE)
_STATION = re.compile(r"\s*STATION (?:NO|ID)\.\s*((?!\d+\.\d+\s*[NS])\S+)?", re.IGNORECASE)
"""Number of the station, which may be missing before its coordinates."""
_PAIRS = re.compile(r"[-+.\d\s]+")
_ENDS = re.compile(r"\s*/&")
_A_LINE = 8
_HEADER = 27
"""Number of lines before the values, if they are pairs: 13 of text, 7 of integers, 7 of reals."""
_PAIR_WIDTH = 7


def _recognised(file: File) -> bool:
    lines = file.lines[:80]
    if not lines or not _BEGINS.match(lines[0]):
        return False
    paired = bool(_RAW.match(lines[0])) and any(map(_COUNT.match, lines))
    return paired or any(map(_DATA.match, lines))


def _of_renadic(file: File) -> bool:
    return any("RENADIC" in line.upper() for line in file.lines[:_HEADER])


def recognises(file: File) -> bool:
    """Return whether a file has this format: its first line, and a number of values."""
    return _recognised(file) and not _of_renadic(file)


def recognises_renadic(file: File) -> bool:
    """Return whether a file has this format: it is in CSMIP's form, and names RENADIC."""
    return _recognised(file) and _of_renadic(file)


def read(file: File) -> list[Channel]:
    """Read the channels of a file."""
    return each_channel(file, _channel)


def _channel(file: File, first: int) -> tuple[Channel, int]:
    if not _BEGINS.match(file.lines[first]):
        message = f"{file.lines[first].strip()[:40]!r} does not start a channel; add its header"
        raise file.refused(first, message)
    raw = bool(_RAW.match(file.lines[first]))
    at = first
    while not (data := _DATA.match(file.line(at))):
        if raw and at == first + _HEADER and _PAIRS.fullmatch(file.lines[at]):
            break
        if at > first + 2 and _BEGINS.match(file.lines[at]):
            raise file.refused(
                at,
                "a second header starts here, but the first header has no line that describes its "
                "values; use a complete file",
            )
        at += 1
    head = _head(file, first, at)
    channel, at = _series(file, at, data, head) if data else _pairs(file, at, head)
    if raw and (length := head.get(_LENGTH)) and channel.step:
        line, match = length
        count = len(channel.values)
        problem = duration_conflict(line, match[2], match[1], count, channel.step)
        channel = channel._replace(no_step=problem)
    if peak := head.get(_RAW_PEAK if raw else _PEAK):
        line, match = peak
        channel = channel._replace(peaks=read_peak(line, match[2], match[3], match[1]))
    return channel, _end(file, at, first)


_Head = dict[re.Pattern[str], tuple[int, re.Match[str]]]


def _head(file: File, first: int, last: int) -> _Head:
    """The lines of a header that state something, and their matches."""
    entries: _Head = {}
    for at in range(first, last):
        for pattern in (_COUNT, _LENGTH, _RAW_UNIT, _RAW_PEAK, _PEAK, _TOWARDS, _STATION):
            if match := pattern.match(file.lines[at]):
                entries[pattern] = at, match
    return entries


def _series(file: File, above: int, data: re.Match[str], head: _Head) -> tuple[Channel, int]:
    """The values below a line that describes them."""
    line = file.lines[above]
    count = check_stated(file, above, int(data[1]))
    if (also := head.get(_COUNT)) and int(also[1][1]) != count:
        raise file.refused(
            above,
            f"the header announces {count} values here, but {also[1][1]} in line {also[0] + 1}; "
            "correct the header",
        )
    columns = _COLUMNS.search(line)
    width = int(columns[1]) if columns else len(file.line(above + 1).rstrip()) // _A_LINE
    values, at = file.numbers(above + 1, count, width or None)
    file.behind(at, count, width or None)
    stepped, rate = _STEP.search(line), _RATE.search(line)
    step = float(stepped[1]) if stepped else 0.0
    if rate and float(rate[1]) > 0.0:
        step = 1.0 / float(rate[1])
    stated = _UNIT.search(line, data.end())
    unit, scale = _scaled(stated[1] if stated else "")
    return (
        Channel(
            values * scale, step if step > 0.0 else None, unit, where=f"line {above + 1}"
        )._replace(**_names(file, head)),
        at,
    )


def _pairs(file: File, first: int, head: _Head) -> tuple[Channel, int]:
    """Times and values in turn, of which the header states the number and the unit."""
    if _COUNT not in head:
        raise file.refused(first - 1, "the header has no number of points; pass a complete file")
    count = check_stated(file, head[_COUNT][0], int(head[_COUNT][1][1]))
    numbers, at = file.numbers(first, 2 * count, _PAIR_WIDTH, each=2)
    file.behind(at, 2 * count, _PAIR_WIDTH, each=2)
    unit, scale = _scaled(head[_RAW_UNIT][1][1] if _RAW_UNIT in head else "")
    spaced = read_times(file, first, numbers[0::2])
    return (
        Channel(
            numbers[1::2] * scale,
            spaced.step,
            unit,
            times=spaced.times,
            no_step=spaced.no_step,
            notes=spaced.notes,
        )._replace(**_names(file, head)),
        at,
    )


def _scaled(stated: str) -> tuple[str | None, float]:
    """A unit, and the size of the unit in the file in it. They differ for G/10."""
    if stated.lower() == "g/10":
        return "g", 0.1
    return spelled(stated) or None, 1.0


def _names(file: File, head: _Head) -> dict[str, Any]:
    """The station and the component of a channel."""
    towards = head[_TOWARDS][1] if _TOWARDS in head else None
    station = ""
    if _STATION in head:
        at, known = head[_STATION]
        place = file.line(at + 1).split("  ")[0].strip()
        station = ", ".join(name for name in (known[1], place) if name)
    return {
        "station": station,
        "component": towards[2] or towards[1] if towards else "",
        "also": tuple(towards[2].split()[:1]) if towards else (),
    }


def _end(file: File, at: int, first: int) -> int:
    """The line after a channel, whose velocities and displacements are passed over."""
    while at < len(file.lines):
        line = file.lines[at]
        if _ENDS.match(line):
            return at + 1
        if other := _OTHER.match(line):
            columns = _COLUMNS.search(line)
            width = int(columns[1]) if columns else len(file.line(at + 1).rstrip()) // _A_LINE
            _, at = file.numbers(at + 1, int(other[1]), width or None)
            continue
        if line.strip():
            message = (
                f"{line.strip()[:40]!r} does not end the channel that starts in line {first + 1}; "
                "end it with '/&'"
            )
            raise file.refused(at, message)
        at += 1
    return at


FORMAT = Format("CSMIP", recognises, read)
RENADIC = Format("RENADIC", recognises_renadic, read)
