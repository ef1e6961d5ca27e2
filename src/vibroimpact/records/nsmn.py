"""Files of the national strong-motion network of Türkiye: ``entry : value``, then three columns.

``RAW PGA VALUES (gal)`` states the unit, and the peak of each component.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import read_peak
from vibroimpact.tables.file import File
from vibroimpact.tables.units import spelled

_TITLE = r"\s*STRONG GROUND MOTION RECORDS? OF TURK"
_COLUMNS = r"\s*((?:N-S|E-W|U-D)(?:\s+(?:N-S|E-W|U-D))*)\s*$"
_STEP = r"SAMPLING INTERVAL\s*\(sec\)\s*:\s*(\d*\.?\d+)"
_PEAKS = r"RAW PGA VALUES\s*(?:\(\s*(\S*?)\s*\))?\s*:(.*)"
_PEAK = re.compile(r"\(\s*([A-Z]-[A-Z])\s*\)\s*(\d*\.?\d+)")


def recognises(file: File) -> bool:
    """Return whether a file has this format: its title."""
    return file.find_line(_TITLE, last=5) is not None


def read(file: File) -> list[Channel]:
    """Read the components of a file."""
    counted, count = file.require_line(r"NUMBER OF DATA\s*:\s*(\d+)", "the number of data")
    stepped, step = file.require_line(_STEP, "the sampling interval")
    above, columns = file.require_line(_COLUMNS, "its columns ('N-S E-W U-D')")
    station = file.find_line(r"STATION ID\s*:\s*(\S*)")
    place = file.find_line(r"PLACE\s*:\s*(.*?)\s*$")
    stated = file.find_line(_PEAKS)
    unit = spelled(stated[1][1] or "") if stated else ""
    peaks = dict(_PEAK.findall(stated[1][2])) if stated else {}
    components = columns[1].split()
    rows = file.rows(above + 1, len(components))
    file.check_count(counted, int(count[1]), len(rows))
    channels = []
    for column, name in enumerate(components):
        text = f"({name}) {peaks.get(name)}"
        channels.append(
            Channel(
                rows[:, column],
                float(step[1]) or None,
                unit or None,
                ", ".join(entry[1][1] for entry in (station, place) if entry and entry[1][1]),
                name,
                where=f"line {stepped + 1}",
                peaks=read_peak(stated[0], peaks[name], unit, text)
                if stated and name in peaks
                else (),
            )
        )
    return channels


FORMAT = Format("NSMN", recognises, read)
