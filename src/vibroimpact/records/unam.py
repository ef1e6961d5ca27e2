"""Mexican files in the standard acceleration format of the UNAM: ``ENTRY : value``, then columns.

The entries of channels contain one value per channel, each after a slash: ``/200/200/200``. A line
``CANAL-1 CANAL-2 ...`` stands above the names of the columns, and these above their values.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import duration_conflict, read_peak, step_conflict
from vibroimpact.tables.file import File
from vibroimpact.tables.statements import StatedPeak
from vibroimpact.tables.units import spelled

_TITLE = r"\s*ARCHIVO EST[AÁ]NDAR DE ACELERACI[OÓ]N"
_COLUMNS = r"\s*CANAL-\d+(?:\s+CANAL-\d+)*\s*$"
_HEADER = 160
_COUNT = r"NUM\. TOTAL DE MUESTRAS, C\d+-C\d+"
_STEP = r"INTERVALO DE MUESTREO, C\d+-C\d+ \(s\)"
_RATE = r"VEL\. DE MUESTREO, C\d+-C\d+ \(muestras/s\)"
_DURATION = r"DURACION DEL REGISTRO \(s\), C\d+-C\d+"
_PEAK = r"ACEL\. MAX\.\s*\(Gal\), C\d+-C\d+"
_UNIT = r"UNIDADES DE LOS DATOS\s*:\s*([A-Za-z][A-Za-z0-9/^]*)"
_FORMAT = r"FORMATO DATOS\b.*:\s*\d+F(\d+)\.\d+\s*$"
"""Columns touch where a value fills its width."""
_NUMBER = re.compile(r"[-+]?\d*\.?\d+")


def recognises(file: File) -> bool:
    """Return whether a file has this format: its title."""
    return file.find_line(_TITLE, last=20) is not None


def read(file: File) -> list[Channel]:
    """Read the channels of a file."""
    above, named = file.require_line(_COLUMNS, "its columns ('CANAL-1 CANAL-2 ...')", _HEADER)
    names = file.line(above + 1).split()
    if len(names) != len(named[0].split()):
        names = named[0].split()
    first = above + 2
    while not file.line(first).strip(" \t-+"):
        first += 1
    form = file.find_line(_FORMAT, _HEADER)
    rows = file.rows(first, len(names), width=int(form[1][1]) if form else None)
    stated = {name: _of_channels(file, name) for name in (_COUNT, _STEP, _RATE, _DURATION, _PEAK)}
    for entry in (_COUNT, _STEP):
        if len(stated[entry]) != len(names):
            message = f"the header has {len(stated[entry])} values of {entry.split(',')[0]}, but"
            raise file.refused(above, f"{message.replace(chr(92), '')} {len(names)} channels")
    unit = file.find_line(_UNIT)
    station = file.find_line(r"CLAVE DE LA ESTACION\s*:\s*(\S*)")
    channels = []
    for column, name in enumerate(names):
        values = rows[:, column]
        at, count = stated[_COUNT][column]
        file.check_count(at, round(float(count)), len(rows))
        channel = Channel(
            values,
            float(stated[_STEP][column][1]) or None,
            spelled(unit[1][1]) if unit else None,
            station[1][1] if station else "",
            name,
            where=f"line {stated[_STEP][column][0] + 1}",
        )
        channels.append(
            _compared(channel, {key: each[column:][:1] for key, each in stated.items()})
        )
    return channels


_Entry = list[tuple[int, str]]


def _of_channels(file: File, name: str) -> _Entry:
    """The numbers of the channels in an entry, of which there may be several lines; their lines."""
    numbers = []
    for at, line in enumerate(file.lines[:_HEADER]):
        if match := re.match(rf"{name}\s*:(.*)", line, re.IGNORECASE):
            cells = [cell.strip() for cell in match[1].split("/")[1:]]
            numbers += [(at, cell) for cell in cells if _NUMBER.fullmatch(cell)]
    return numbers


def _compared(channel: Channel, stated: dict[str, _Entry]) -> Channel:
    """A channel with the statements that differ from its values."""
    problem = ""
    peaks: tuple[StatedPeak, ...] = ()
    for at, rate in stated[_RATE]:
        if channel.step and float(rate) > 0.0:
            text = f"VEL. DE MUESTREO: {rate}"
            problem = step_conflict(at, text, 1.0 / float(rate), channel.step, "its intervals")
    for at, lasts in stated[_DURATION]:
        if channel.step and not problem:
            count, text = len(channel.values), f"DURACION DEL REGISTRO: {lasts}"
            problem = duration_conflict(at, lasts, text, count, channel.step)
    for at, peak in stated[_PEAK]:
        peaks = read_peak(at, peak, "gal", f"ACEL. MAX. (Gal): {peak}")
    return channel._replace(no_step=problem, peaks=peaks)


FORMAT = Format("UNAM", recognises, read)
