"""K-NET's and KiK-net's ASCII files: 17 lines of header, then counts, eight per line.

The scale factor, such as ``3920(gal)/6182761``, converts counts to gal. The offset of the sensor at
rest is not subtracted.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.tables.file import File

_HEADER = 17
_SCALE = re.compile(r"(\d+\.?\d*)\(gal\)/(\d*[1-9]\d*\.?\d*)")
_KIK = {"1": "N-S", "2": "E-W", "3": "U-D", "4": "N-S", "5": "E-W", "6": "U-D"}
"""Directions of KiK-net: 1 to 3 are in the borehole, and 4 to 6 at the surface."""


def recognises(file: File) -> bool:
    """Return whether a file has this format: its header has the origin time and the scale."""
    lines = file.lines
    return bool(lines) and lines[0].startswith("Origin Time") and bool(_find(file, "Scale Factor"))


def _find(file: File, name: str) -> tuple[int, str] | None:
    """Line and text of an entry of the header."""
    for at, line in enumerate(file.lines[:_HEADER]):
        if line.startswith(name):
            return at, line[len(name) :].strip()
    return None


def _entry(file: File, name: str, pattern: str) -> tuple[int, re.Match[str]]:
    found = _find(file, name)
    if found is None:
        told = f"the header has no {name!r}; a header of K-NET is accepted"
        raise file.refused(min(_HEADER, len(file.lines)) - 1, told)
    match = re.match(pattern, found[1])
    if match is None:
        raise file.refused(found[0], f"{found[1]!r} is not a {name}; a header of K-NET is accepted")
    return found[0], match


def read(file: File) -> list[Channel]:
    """Read the component of a file."""
    _, rate = _entry(file, "Sampling Freq(Hz)", r"(\d+\.?\d*)")
    _, lasts = _entry(file, "Duration Time(s)", r"(\d+\.?\d*)")
    _, scale = _entry(file, "Scale Factor", _SCALE.pattern)
    _, direction = _entry(file, "Dir.", r"(\S+)")
    _, station = _entry(file, "Station Code", r"(\S+)")
    count = round(float(rate[1]) * float(lasts[1]))
    counts, at = file.numbers(_HEADER, count)
    file.behind(at, count)
    towards = direction[1]
    also: tuple[str, ...] = ()
    if towards in _KIK:
        place = "borehole" if towards in "123" else "surface"
        also = (towards, _KIK[towards])
        towards = f"{_KIK[towards]}, {place}"
    return [
        Channel(
            counts * (float(scale[1]) / float(scale[2])),
            1.0 / float(rate[1]) if float(rate[1]) > 0.0 else None,
            "cm/s^2",
            station[1],
            towards,
            also,
            "line 11",
        )
    ]


FORMAT = Format("K-NET", recognises, read)
