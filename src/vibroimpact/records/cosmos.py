"""COSMOS files, V1 and V2, of version 1.20: channels one after the other.

A channel has lines of text, the first of which states their number. They are followed by integers
and reals in columns; the line above them states the width of the columns. After the comments, a
line states the number of the values, their unit and their width. The step is real 62, in ms.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.tables.file import File

_BEGINS = re.compile(r"\(Format v\S* with\s+(\d+) text lines\)", re.IGNORECASE)
_HEADER = re.compile(
    r"\s*(\d+)\s+(?:integer|real)-header values follow.*Format\s*=\s*\(\s*(\d+)[A-Z](\d+)",
    re.IGNORECASE,
)
_COMMENTS = re.compile(r"\s*(\d+)\s+comment", re.IGNORECASE)
_DATA = re.compile(
    r"\s*(\d+)\s+(\w+)\s+pts.*units\s*=[^(]*\(\s*(\d+)\s*\).*Format\s*=\s*\(\s*\d+[A-Z](\d+)",
    re.IGNORECASE,
)
_UNITS = {
    2: "g",
    4: "cm/s^2",
    5: "cm/s",
    6: "cm",
    7: "in/s^2",
    8: "in/s",
    9: "in",
}
"""Units by their number in the header."""
_COUNTS = 50
_STEP = 61
_CODE = re.compile(r"<SCNL>\s*([^.\s]*)\.([^.\s]*)\.([^.\s]*)")
_TOWARDS = re.compile(r"Sta\s+Chan?:?\s*\S+?\s*:\s*(.*?)\s*(?:\(|$)", re.IGNORECASE)
_STATION = re.compile(r"Code:\s*(\S+)\s+(.*)")


def recognises(file: File) -> bool:
    """Return whether a file has this format: its first line names it."""
    return bool(file.lines) and bool(_BEGINS.search(file.lines[0]))


def read(file: File) -> list[Channel]:
    """Read the channels of a file."""
    found: list[Channel] = []
    at = 0
    while at < len(file.lines):
        channel, at = _channel(file, at)
        found.append(channel)
        while at < len(file.lines) and not file.lines[at].strip():
            at += 1
    return found


def _expected(file: File, at: int, pattern: re.Pattern[str], what: str) -> re.Match[str]:
    match = pattern.match(file.line(at)) or pattern.search(file.line(at))
    if match is None:
        raise file.refused(at, f"{file.lines[at].strip()[:40]!r} is not the {what}")
    return match


def _channel(file: File, first: int) -> tuple[Channel, int]:
    begins = _expected(file, first, _BEGINS, "beginning of a channel; a COSMOS header is accepted")
    at = first + int(begins[1])
    integers = _expected(file, at, _HEADER, "line above the integers of the header")
    _, at = file.numbers(at + 1, int(integers[1]), int(integers[3]))
    above = at
    reals = _expected(file, at, _HEADER, "line above the reals of the header")
    numbers, at = file.numbers(at + 1, int(reals[1]), int(reals[3]))
    comments = int(_expected(file, at, _COMMENTS, "number of comments")[1])
    said = [file.line(at + 1 + n) for n in range(comments)]
    at += 1 + comments
    data = _expected(file, at, _DATA, "line above the values")
    count, width = int(data[1]), int(data[4])
    if count < 1:
        raise file.refused(at, f"the header states {count} values; at least 2 are accepted")
    values, at = file.numbers(at + 1, count, width)
    if at < len(file.lines):
        file.behind(at, count, width)
        if not re.match(r"\s*(End-of-data|/&)", file.lines[at], re.IGNORECASE):
            told = f"{file.lines[at].strip()[:40]!r} does not end the data of the channel; "
            raise file.refused(at, f"{told}'End-of-data' is accepted")
    step = 1e-3 * float(numbers[_STEP]) if len(numbers) > _STEP else 0.0
    head = file.lines[first : first + int(begins[1])]
    code = next((c for line in said if (c := _CODE.search(line))), None)
    towards = next((t[1] for line in head if (t := _TOWARDS.match(line))), "")
    names = [name for name in (towards, code[2] if code else "") if name]
    if towards.lower() == "other":
        names.reverse()
    station = next((f"{s[1]}, {s[2].strip()}" for line in head if (s := _STATION.search(line))), "")
    return (
        Channel(
            values,
            step if step > 0.0 else None,
            _UNITS.get(int(data[3])),
            re.sub(r"\s{2,}", " ", station),
            names[0] if names else "",
            (*names[1:], *towards.split()[:1]),
            f"line {above + 2 + _STEP // int(reals[2])}",
            unclear="counts" if int(data[3]) == _COUNTS else "",
        ),
        at + 1,
    )


FORMAT = Format("COSMOS", recognises, read)
