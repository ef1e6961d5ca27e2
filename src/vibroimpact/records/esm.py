"""ESM's and ITACA's ASCII files (DYNA 1): lines ``KEY: value``, then one value per line.

``NDATA``, ``SAMPLING_INTERVAL_S``, ``DURATION_S``, ``UNITS`` and ``PGA_CM/S^2`` describe the
values.
"""

from __future__ import annotations

import math
import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import duration_conflict, read_peak
from vibroimpact.tables.file import File
from vibroimpact.tables.statements import StatedPeak

_PGA, _DURATION = "PGA_CM/S^2", "DURATION_S"
_ENTRY = re.compile(r"([A-Z][A-Z0-9_/^]*):\s*(.*?)\s*$")


def recognises(file: File) -> bool:
    """Return whether a file has this format: its header starts with EVENT_NAME and has NDATA."""
    lines = file.lines[:80]
    return bool(lines) and lines[0].startswith("EVENT_NAME:") and any("NDATA:" in x for x in lines)


def read(file: File) -> list[Channel]:
    """Read the component of a file."""
    entries: dict[str, str] = {}
    where: dict[str, int] = {}
    at = 0
    while at < len(file.lines) and (entry := _ENTRY.match(file.lines[at])):
        entries[entry[1]], where[entry[1]] = entry[2], at
        at += 1

    def number(name: str) -> float:
        try:
            return float(entries.get(name) or "nan")
        except ValueError:
            message = f"{name}: {entries[name]!r} is not a number; write a number"
            raise file.refused(where[name], message) from None

    raw_count = number("NDATA")
    if not 1.0 <= raw_count < math.inf:
        message = f"NDATA: {entries.get('NDATA')!r}; use a record with at least 2 values"
        raise file.refused(where.get("NDATA", at - 1), message)
    count = int(raw_count)
    values, behind = file.numbers(at, count)
    for further in range(behind, len(file.lines)):
        if _ENTRY.match(file.lines[further]):
            raise file.refused(further, "a second header starts here; use one record per file")
    file.behind(behind, count)
    step = number("SAMPLING_INTERVAL_S")
    unit = entries.get("UNITS") or None
    peaks: tuple[StatedPeak, ...] = ()
    if math.isfinite(number(_PGA)):
        peaks = read_peak(where[_PGA], entries[_PGA], "cm/s^2", f"{_PGA}: {entries[_PGA]}")
    problem = ""
    if step > 0.0 and math.isfinite(number(_DURATION)):
        at, lasts = where[_DURATION], entries[_DURATION]
        problem = duration_conflict(at, lasts, f"{_DURATION}: {lasts}", count, step)
    names = [entries.get("NETWORK", ""), entries.get("STATION_CODE", "")]
    return [
        Channel(
            values,
            step if step > 0.0 else None,
            unit,
            ".".join(name for name in names if name),
            entries.get("STREAM", ""),
            (),
            f"line {where.get('SAMPLING_INTERVAL_S', at - 1) + 1}",
            no_step=problem,
            peaks=peaks,
        )
    ]


FORMAT = Format("ESM", recognises, read)
