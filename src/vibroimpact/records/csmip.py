"""CSMIP's V1 and V2 files: channels one after the other, each with its own header.

The line above the values of the acceleration states their number, their unit, and the step or the
number of samples per second. In newer files it also states the columns. In older files, each line
has eight values. In V2 files, velocities and displacements follow.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.tables.file import File

_BEGINS = re.compile(r"\s*(?:UN)?CORRECTED ACCELEROGRAM", re.IGNORECASE)
_DATA = re.compile(r"\s*(\d+)\s+(?:POINTS OF ACCEL|ACCELEROGRAM POINTS)", re.IGNORECASE)
_OTHER = re.compile(r"\s*(\d+)\s+POINTS OF (?:VELOC|DISPL)", re.IGNORECASE)
_STEP = re.compile(r"SPACED AT\s*(\d*\.?\d+)\s*SEC", re.IGNORECASE)
_RATE = re.compile(r"AT\s*(\d*\.?\d+)\s*PTS/SEC", re.IGNORECASE)
_COLUMNS = re.compile(r"\(\s*\d+F(\d+)\.", re.IGNORECASE)
_TOWARDS = re.compile(r"\s*CHAN\s+(\d+)\s*:\s*(.*?)\s*$", re.IGNORECASE)
_STATION = re.compile(r"\s*STATION (?:NO|ID)\.\s*(\S+)", re.IGNORECASE)
_ENDS = re.compile(r"\s*/&")
_A_LINE = 8


def recognises(file: File) -> bool:
    """Return whether a file has this format: its first line, and a line that describes values."""
    lines = file.lines
    return bool(lines) and bool(_BEGINS.match(lines[0])) and any(map(_DATA.match, lines[:80]))


def read(file: File) -> list[Channel]:
    """Read the channels of a file."""
    found: list[Channel] = []
    at = 0
    while at < len(file.lines):
        if not file.lines[at].strip():
            at += 1
            continue
        channel, at = _channel(file, at)
        found.append(channel)
    return found


def _channel(file: File, first: int) -> tuple[Channel, int]:
    if not _BEGINS.match(file.lines[first]):
        told = f"{file.lines[first].strip()[:40]!r} does not start a channel; a header is accepted"
        raise file.refused(first, told)
    at = first
    number = towards = station = ""
    while not (data := _DATA.match(file.line(at))):
        if at > first + 2 and _BEGINS.match(file.lines[at]):
            raise file.refused(
                at,
                "a second header starts here, but the first header has no line that describes its "
                "values; a complete file is accepted",
            )
        if named := _TOWARDS.match(file.lines[at]):
            number, towards = named.groups()
        if known := _STATION.match(file.lines[at]):
            place = file.line(at + 1).split("  ")[0].strip()
            station = f"{known[1]}, {place}"
        at += 1
    line, above = file.lines[at], at
    count = int(data[1])
    if count < 1:
        raise file.refused(at, f"the header states {count} values; at least 2 are accepted")
    columns = _COLUMNS.search(line)
    width = int(columns[1]) if columns else len(file.line(at + 1).rstrip()) // _A_LINE
    values, at = file.numbers(at + 1, count, width or None)
    file.behind(at, count, width or None)
    at = _end(file, at, first)
    stepped, rate = _STEP.search(line), _RATE.search(line)
    step = float(stepped[1]) if stepped else 0.0
    if rate and float(rate[1]) > 0.0:
        step = 1.0 / float(rate[1])
    tail = line[data.end() :].lower()
    unit = "cm/s^2" if "cm/s" in tail else "g" if re.search(r"\bg\b", tail) else None
    return (
        Channel(
            values,
            step if step > 0.0 else None,
            unit,
            station,
            towards or number,
            (towards.split()[0],) if towards else (),
            f"line {above + 1}",
        ),
        at,
    )


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
            told = (
                f"{line.strip()[:40]!r} does not end the channel that starts in line {first + 1}; "
                "'/&' is accepted"
            )
            raise file.refused(at, told)
        at += 1
    return at


FORMAT = Format("CSMIP", recognises, read)
