"""What the formats of files have in common: named columns of numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Column(NamedTuple):
    """One channel of a file."""

    name: str
    """As the file has it, without its unit."""
    unit: str | None
    """As the file has it; None where it has none."""
    values: NDArray[Any]
    """Numbers, NaN where there is none; or words, such as the direction of a sweep."""
    step: float | None = None
    """Time between its samples (s), where the channel itself states it."""
    start: float = 0.0
    """Time of its first sample (s)."""
    scale: float | None = None
    """What its values are still to be multiplied by; None where nothing states it."""
    offset: float | None = None
    """What is to be added after that."""
    doubt: str = ""
    """What the file states of its unit or its scale and is not understood, in words."""


class Columns(NamedTuple):
    """All channels of a file, or of one of its groups."""

    path: str
    columns: tuple[Column, ...]
    said: Mapping[str, str]
    """What stands beside the numbers, such as ``amplitude``, as it is written."""
    lines: NDArray[np.int64] | None = None
    """Of a text file, the line of each row, from 1 on."""
    notes: tuple[str, ...] = ()
    """What was assumed, and what was left out, in words."""

    def row(self, i: int) -> str:
        """Where a row stands, in words."""
        return f"row {i + 1}" if self.lines is None else f"line {self.lines[i]}"


def of_one_length(path: str, columns: list[Column]) -> tuple[Column, ...]:
    """The channels as long as the longest one, the shorter ones padded by NaN."""
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
