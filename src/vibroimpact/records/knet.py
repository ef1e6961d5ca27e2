"""K-NET's and KiK-net's ASCII and CSV files.

ASCII: 17 lines of header, then counts, eight per line. The scale factor, such as
``3920(gal)/6182761``, converts counts to gal. The stated maximum is that of the values after their
mean was subtracted.

CSV: a header in lines that begin with ``#``, with the names of its entries above the entries; then
rows of a date, the time, and the values of three components in gal (KiK-net: six).

In both, the offset of the sensor at rest is not subtracted from the values.
"""

from __future__ import annotations

import re
from typing import Any

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import read_peak, read_times, step_conflict
from vibroimpact.tables.file import File

_HEADER = 17
_MARK = "#K-NET CSV"
_CSV_COLUMN = re.compile(r"(.*?)\s*\(([^()]*)\)")
_SCALE = re.compile(r"(\d+\.?\d*)\(gal\)/(\d*[1-9]\d*\.?\d*)")
_MOST = r"Max\.? Acc\. \(gal\)\s*(\d*\.?\d+)"
_POSITIVE = re.compile(r"(?=.*[1-9])\d+\.?\d*")
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
    entry = _find(file, name)
    if entry is None:
        message = f"the header has no {name!r}; use a file with a header of K-NET"
        raise file.refused(min(_HEADER, len(file.lines)) - 1, message)
    match = re.match(pattern, entry[1])
    if match is None:
        raise file.refused(
            entry[0], f"{entry[1]!r} is not a {name}; use a file with a header of K-NET"
        )
    return entry[0], match


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
    most = file.find_line(_MOST, last=_HEADER)
    return [
        Channel(
            counts * (float(scale[1]) / float(scale[2])),
            1.0 / float(rate[1]) if float(rate[1]) > 0.0 else None,
            "cm/s^2",
            station[1],
            where="line 11",
            peaks=read_peak(most[0], most[1][1], "gal", most[1][0]) if most else (),
        )._replace(**_names(direction[1]))
    ]


def _names(towards: str) -> dict[str, Any]:
    """The name of a component, and its other names."""
    if towards not in _KIK:
        return {"component": towards}
    place = "borehole" if towards in "123" else "surface"
    return {"component": f"{_KIK[towards]}, {place}", "also": (towards, _KIK[towards])}


def recognises_csv(file: File) -> bool:
    """Return whether a file has this format: its first line names it."""
    return bool(file.lines) and file.lines[0].strip() == _MARK


def read_csv(file: File) -> list[Channel]:
    """Read the components of a CSV file."""
    above, _ = file.require_line(
        r"#Time,\s*RelativeTime", "its columns ('#Time,RelativeTime(s),...')"
    )
    columns = [_CSV_COLUMN.fullmatch(name.strip()) for name in file.lines[above].split(",")[1:]]
    if not all(columns) or len(columns) < 2 or (columns[0] and columns[0][2] != "s"):
        message = f"{file.lines[above][:60]!r} does not name columns with units"
        raise file.refused(above, f"{message}; write '#Time,RelativeTime(s),N-S(gal),...'")
    names = [(name[1], name[2]) for name in columns[1:] if name]
    rates, rate = _under(file, r"#SamplingFrequency\(Hz\)", "the sampling frequency")
    lasts, duration = _under(file, r"#DurationTime\(s\)", "the duration")
    code = file.require_line(r"#Code", "the station")[0] + 1
    station = file.line(code).strip("#").split(",")[0].strip()
    rows = file.rows(above + 1, len(columns) + 1, ",", skip=1)
    count = round(float(rate) * float(duration))
    file.check_count(lasts, count, len(rows))
    spaced = read_times(file, above + 1, rows[:, 0])
    problem = spaced.no_step
    if spaced.step:
        text = f"{file.lines[rates - 1]} {rate}"
        problem = step_conflict(rates, text, 1.0 / float(rate), spaced.step, "its times")
    return [
        Channel(
            rows[:, column],
            spaced.step,
            unit,
            station,
            notes=spaced.notes,
            no_step=problem,
            times=spaced.times,
        )._replace(**_names(name))
        for column, (name, unit) in enumerate(names, start=1)
    ]


def _under(file: File, name: str, what: str) -> tuple[int, str]:
    """The positive number in the line under an entry's name, and this line."""
    at = file.require_line(name, what)[0] + 1
    text = file.line(at).strip("# \t")
    if not _POSITIVE.fullmatch(text):
        raise file.refused(at, f"{text!r} is not {what}; pass a complete file")
    return at, text


FORMAT = Format("K-NET", recognises, read)
CSV = Format("K-NET CSV", recognises_csv, read_csv)
