"""Files of the Central Weather Bureau of Taiwan: lines ``#entry: value``, then rows of numbers.

A row is a time and the values of three components. ``#DataSequence`` names them, ``#RecordLength``
and ``#SampleRate`` give their number, ``#AmplitudeUnit`` states their unit, and ``#AmplitudeMAX.``
states the maximum and the minimum of each component.
"""

from __future__ import annotations

import re

from vibroimpact.records.channel import Channel, Format
from vibroimpact.records.header import read_peak, read_times, step_conflict
from vibroimpact.tables.file import File
from vibroimpact.tables.statements import StatedPeak

_NUMBER = r"([-+]?\d+\.?\d*|[-+]?\.\d+)"
_SEQUENCE = r"#\s*DataSequence\s*:\s*Time\s+(.*)"
_COMPONENT = re.compile(r"(\w+)\s*\(\+\)")


def recognises(file: File) -> bool:
    """Return whether a file has this format: its header states the sequence of the columns."""
    return bool(file.lines) and file.lines[0].startswith("#") and bool(file.find_line(_SEQUENCE))


def read(file: File) -> list[Channel]:
    """Read the components of a file."""
    ordered, sequence = file.require_line(_SEQUENCE, "the sequence of its columns")
    names = [_COMPONENT.fullmatch(name.strip()) for name in sequence[1].strip(" ;").split(";")]
    components = [name[1] for name in names if name]
    if len(components) < len(names):
        message = f"{sequence[1].strip()!r} does not name components"
        raise file.refused(ordered, f"{message}; write 'Time U(+); N(+); E(+)'")
    rated, rate = file.require_line(rf"#\s*SampleRate\s*\(Hz\)\s*:\s*{_NUMBER}", "the sample rate")
    lasts, length = file.require_line(rf"#\s*RecordLength\s*\(sec\)\s*:\s*{_NUMBER}", "the length")
    if float(rate[1]) <= 0.0:
        raise file.refused(rated, f"the sample rate is {rate[1]} Hz; state a rate above 0")
    above, _ = file.require_line(r"#\s*Data\s*:", "where its values begin ('#Data:')")
    code = file.find_line(r"#\s*StationCode\s*:\s*(\S*)")
    unit = file.find_line(r"#\s*AmplitudeUnit\s*:\s*([A-Za-z][\w/^]*)(?![\w(])")
    rows = file.rows(above + 1, 1 + len(components))
    file.check_count(lasts, round(float(rate[1]) * float(length[1])), len(rows))
    spaced = read_times(file, above + 1, rows[:, 0])
    problem = spaced.no_step
    if spaced.step:
        problem = step_conflict(rated, rate[0], 1.0 / float(rate[1]), spaced.step, "its times")
    channels = []
    for column, name in enumerate(components, start=1):
        peaks: tuple[StatedPeak, ...] = ()
        pattern = rf"#\s*AmplitudeMAX\.?\s*{name}\s*:\s*{_NUMBER}\s*~\s*{_NUMBER}"
        if peak := file.find_line(pattern):
            larger = max(peak[1].groups(), key=lambda stated: abs(float(stated)))
            peaks = read_peak(peak[0], larger, None, peak[1][0])
        channels.append(
            Channel(
                rows[:, column],
                spaced.step,
                unit[1][1] if unit else None,
                code[1][1] if code else "",
                name,
                notes=spaced.notes,
                no_step=problem,
                times=spaced.times,
                peaks=peaks,
            )
        )
    return channels


FORMAT = Format("CWB", recognises, read)
