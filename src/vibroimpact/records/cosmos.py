"""COSMOS files, V0, V1 and V2, of version 1.20: channels one after the other.

A channel has lines of text, the first of which states their number. They are followed by integers
and reals in columns; the line above them states the width of the columns. After the comments, a
line states the number of the values, their unit and their width. The step is real 62, in ms, the
duration is real 63 in s, and the peak is real 64 in the unit of the values.

The values of V0 files are counts. Real 22 is the size of a count in µV, real 42 is the sensitivity
of the accelerometer in V/g, and real 47 is the gain between both.

Source: COSMOS (2001), Strong motion data format, version 1.20.
"""

from __future__ import annotations

import math
import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import check_stated, duration_conflict, each_channel, read_peak
from vibroimpact.tables.file import File

_BEGINS = re.compile(r"\(Format v\S* with\s+(\d+) text lines\)", re.IGNORECASE)
_HEADER = re.compile(
    r"\s*(\d+)\s+(?:integer|real)-header values follow.*Format\s*=\s*\(\s*(\d+)[A-Z](\d+)",
    re.IGNORECASE,
)
_COMMENTS = re.compile(r"\s*(\d+)\s+comment", re.IGNORECASE)
_DATA = re.compile(
    r"\s*(\d+)\s+(\w.*?)\s+pts.*units\s*=[^(]*\(\s*(\d+)\s*\).*Format\s*=\s*\(\s*\d+[A-Z](\d+)",
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
_UNKNOWN = -999.0
_ACCELERATION = 1
"""Second integer of the header, if the values are from an accelerometer."""
_COUNT_SIZE, _SENSITIVITY, _GAIN = 21, 41, 46
_STEP, _DURATION, _PEAK = 61, 62, 63
_CODE = re.compile(r"<SCNL>\s*([^.\s]*)\.([^.\s]*)\.([^.\s]*)")
_TOWARDS = re.compile(r"Sta\s+Chan?:?\s*\S+?\s*:\s*(.*?)\s*(?:\(|$)", re.IGNORECASE)
_STATION = re.compile(r"Code:\s*(\S+)\s+(.*)")


def recognises(file: File) -> bool:
    """Return whether a file has this format: its first line names it."""
    return bool(file.lines) and bool(_BEGINS.search(file.lines[0]))


def read(file: File) -> list[Channel]:
    """Read the channels of a file."""
    return each_channel(file, _channel)


def _expected(file: File, at: int, pattern: re.Pattern[str], what: str) -> re.Match[str]:
    match = pattern.match(file.line(at)) or pattern.search(file.line(at))
    if match is None:
        raise file.refused(at, f"{file.lines[at].strip()[:40]!r} is not the {what}")
    return match


class _Reals(NamedTuple):
    """The reals of a header."""

    values: NDArray[np.float64]
    texts: list[str]
    first: int
    """Line of the first one."""
    a_line: int

    def known(self, index: int) -> bool:
        """Return whether the header states a real. Unknown ones are -999, or 0."""
        return index < len(self.values) and self.values[index] not in (0.0, _UNKNOWN)

    def line(self, index: int) -> int:
        """Return the line of a real."""
        return self.first + index // self.a_line


def _reals(file: File, at: int) -> tuple[_Reals, int]:
    above = _expected(file, at, _HEADER, "line above the reals of the header")
    count, a_line, width = int(above[1]), int(above[2]), int(above[3])
    values, after = file.numbers(at + 1, count, width)
    lines = file.lines[at + 1 : after]
    texts = [line[i : i + width] for line in lines for i in range(0, len(line.rstrip()), width)]
    return _Reals(values, texts, at + 1, max(a_line, 1)), after


def _channel(file: File, first: int) -> tuple[Channel, int]:
    begins = _expected(file, first, _BEGINS, "beginning of a channel; use a complete COSMOS file")
    at = first + int(begins[1])
    integers = _expected(file, at, _HEADER, "line above the integers of the header")
    codes, at = file.numbers(at + 1, int(integers[1]), int(integers[3]))
    reals, at = _reals(file, at)
    comments = int(_expected(file, at, _COMMENTS, "number of comments")[1])
    said = [file.line(at + 1 + n) for n in range(comments)]
    at += 1 + comments
    data = _expected(file, at, _DATA, "line above the values")
    count, width = int(data[1]), int(data[4])
    check_stated(file, at, count)
    values, at = file.numbers(at + 1, count, width)
    if at < len(file.lines):
        file.behind(at, count, width)
        if not re.match(r"\s*(End-of-data|/&)", file.lines[at], re.IGNORECASE):
            message = f"{file.lines[at].strip()[:40]!r} does not end the data of the channel; "
            raise file.refused(at, f"{message}end it with 'End-of-data'")
    head = file.lines[first : first + int(begins[1])]
    code = next((c for line in said if (c := _CODE.search(line))), None)
    towards = next((t[1] for line in head if (t := _TOWARDS.match(line))), "")
    names = [name for name in (towards, code[2] if code else "") if name]
    if towards.lower() == "other":
        names.reverse()
    station = next((f"{s[1]}, {s[2].strip()}" for line in head if (s := _STATION.search(line))), "")
    kind = int(data[3])
    channel = Channel(
        values,
        1e-3 * float(reals.values[_STEP]) if reals.known(_STEP) else None,
        _UNITS.get(kind),
        re.sub(r"\s{2,}", " ", station),
        names[0] if names else "",
        (*names[1:], *towards.split()[:1]),
        f"line {reals.line(_STEP) + 1}",
    )
    if channel.step is not None and channel.step <= 0.0:
        channel = channel._replace(step=None)
    if reals.known(_PEAK):
        peaks = read_peak(reals.line(_PEAK), reals.texts[_PEAK], None)
        channel = channel._replace(peaks=peaks)
    if channel.step and reals.known(_DURATION):
        at_line, lasts = reals.line(_DURATION), reals.texts[_DURATION]
        problem = duration_conflict(at_line, lasts, lasts, count, channel.step)
        channel = channel._replace(no_step=problem)
    if kind == _COUNTS:
        channel = _scaled(channel, reals, len(codes) > 1 and codes[1] == _ACCELERATION)
    return channel, at + 1


def _scaled(channel: Channel, reals: _Reals, accelerometer: bool) -> Channel:
    """A channel of counts in g, if its header states the size of a count."""
    unclear = channel._replace(unit=None, unclear="counts")
    if not accelerometer or not reals.known(_COUNT_SIZE) or not reals.known(_SENSITIVITY):
        return unclear
    gain = float(reals.values[_GAIN]) if reals.known(_GAIN) else 1.0
    size = 1e-6 * float(reals.values[_COUNT_SIZE] / (reals.values[_SENSITIVITY] * gain))
    if not 0.0 < size < math.inf:
        return unclear
    note = f"the counts were multiplied by {size:.6g} g, computed from the header"
    if not reals.known(_GAIN):
        note += ", which states no gain: a gain of 1 was assumed"
    peaks = [one._replace(value=one.value * size, digit=one.digit * size) for one in channel.peaks]
    return channel._replace(
        values=channel.values * size, unit="g", peaks=tuple(peaks), notes=(*channel.notes, note)
    )


FORMAT = Format("COSMOS", recognises, read)
