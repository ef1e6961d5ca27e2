"""Measurement files of LabVIEW: a table contains all channels of a segment with the same times."""

from __future__ import annotations

import numpy as np

from vibroimpact.measurements.columns import ChannelColumn, Columns
from vibroimpact.measurements.scaling import agreed
from vibroimpact.records.lvm import recognises, segments
from vibroimpact.tables.file import File
from vibroimpact.tables.units import parted


def read(file: File) -> list[Columns] | None:
    """Read the tables of a file. Return None if it has another format.

    Raises
    ------
    InputError
        If the file is damaged.
    """
    if not recognises(file):
        return None
    file_segments = segments(file)
    tables: list[tuple[str, list[ChannelColumn]]] = []
    for number, signals in enumerate(file_segments, 1):
        begun = len(tables)
        for signal in signals:
            bare, own = parted(signal.name)
            unit, doubt = agreed(own, signal.label)
            column = ChannelColumn(bare, unit, signal.values, doubt=doubt)
            for _, columns in tables[begun:]:
                if np.array_equal(columns[0].values, signal.times):
                    columns.append(column)
                    break
            else:
                unit = {"time": "s", "frequency": "Hz"}.get(signal.axis)
                axis = ChannelColumn(signal.axis, unit, signal.times)
                tables.append((str(number), [axis, column]))
    said = [{"group": name} if len(tables) > 1 else {} for name, _ in tables]
    return [
        Columns(file.path, tuple(columns), one)
        for (_, columns), one in zip(tables, said, strict=True)
    ]
