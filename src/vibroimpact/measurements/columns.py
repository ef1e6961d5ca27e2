"""Common result of the readers of all file formats: named columns of numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class ChannelColumn(NamedTuple):
    """A channel of a file."""

    name: str
    """Name in the file, without the unit."""
    unit: str | None
    """Unit in the file. None if the file states none."""
    values: NDArray[Any]
    """Numbers (NaN if a number is missing), or words such as the direction of a sweep."""
    step: float | None = None
    """Time between samples (s), if the channel states it."""
    start: float = 0.0
    """Time of the first sample (s)."""
    scale: float | None = None
    """Factor by which the values must still be multiplied. None if the file states none."""
    offset: float | None = None
    """Offset that must be added after that."""
    doubt: str = ""
    """Statements in the file about the unit or the scale that are not understood."""


class Columns(NamedTuple):
    """All channels of a file, or of a group in a file."""

    path: str
    columns: tuple[ChannelColumn, ...]
    said: Mapping[str, str]
    """Entries next to the numbers, such as ``amplitude``, as they are written in the file."""
    lines: NDArray[np.int64] | None = None
    """For a text file, the line number of each row, starting from 1."""
    notes: tuple[str, ...] = ()
    """Notes on assumptions, and on what was left out."""

    def row(self, i: int) -> str:
        """Return the position of a row as text."""
        return f"row {i + 1}" if self.lines is None else f"line {self.lines[i]}"


def of_one_length(path: str, columns: list[ChannelColumn]) -> tuple[ChannelColumn, ...]:
    """Return the channels with the same length. Shorter channels are padded with NaN."""
    longest = max((len(column.values) for column in columns), default=0)
    padded = []
    for column in columns:
        values = np.asarray(column.values)
        if values.dtype.kind in "fiub" and len(values) < longest:
            short = np.full(longest, np.nan)
            short[: len(values)] = values
            values = short
        padded.append(column._replace(values=values))
    return tuple(padded)
