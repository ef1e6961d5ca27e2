"""GeoNet's V1A and V2A files: each component has 16 lines of text, 4 of integers and 6 of reals.

Columns have 8 characters, and a line has ten columns. Integers 34, 35 and 36 are the numbers of
values of acceleration, velocity and displacement. Real 26 is the step. Accelerations are in mm/s².
"""

from __future__ import annotations

from vibroimpact.records.channel import Channel, Format
from vibroimpact.tables.file import File

_TEXT = 16
_WIDTH = 8


def recognises(file: File) -> bool:
    """Return whether a file has this format: its first lines name an accelerogram and a site."""
    lines = file.lines
    return len(lines) > 2 and _begins(lines[0]) and lines[1].startswith("Site ")


def read(file: File) -> list[Channel]:
    """Read the components of a file."""
    found = []
    at = 0
    while at < len(file.lines):
        channel, at = _component(file, at)
        found.append(channel)
        while at < len(file.lines) and not file.lines[at].strip():
            at += 1
    return found


def _begins(line: str) -> bool:
    return "corrected accelerogram" in line.lower()


def _component(file: File, first: int) -> tuple[Channel, int]:
    if not _begins(file.line(first)):
        raise file.refused(
            first,
            f"{file.lines[first].strip()[:40]!r} does not start a component; "
            f"'Uncorrected accelerogram' or 'Corrected accelerogram' is accepted",
        )
    integers, at = file.numbers(first + _TEXT, 40, _WIDTH)
    reals, at = file.numbers(at, 60, _WIDTH)
    counts = [int(count) for count in integers[33:36]]
    if counts[0] < 1:
        told = f"the header states {counts[0]} values of acceleration; at least 2 are accepted"
        raise file.refused(first + _TEXT + 3, told)
    values, at = file.numbers(at, counts[0], _WIDTH)
    for count in counts[1:]:
        _, at = file.numbers(at, count, _WIDTH)
    words = file.lines[first + 12].split()
    step = float(reals[25])
    return (
        Channel(
            values,
            step if step > 0.0 else None,
            "mm/s^2",
            ", ".join([file.lines[first + 1].split()[1], file.lines[first + 2].strip()]),
            words[1] if len(words) > 1 else "",
            (),
            f"line {first + 23}",
        ),
        at,
    )


FORMAT = Format("GeoNet", recognises, read)
