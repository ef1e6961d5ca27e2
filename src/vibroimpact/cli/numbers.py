"""Numbers as people write them: plain decimals, in a unit of fitting size."""

from __future__ import annotations

import math
from collections.abc import Iterable
from decimal import Decimal
from typing import NamedTuple

_LEAST, _MOST = 1e-7, 1e9
"""Sizes between which a number is written out."""


class Scale(NamedTuple):
    """A unit, and from which size on it is used."""

    least: float
    size: float
    """In SI units."""
    symbol: str


LENGTHS = (Scale(1.0, 1.0, "m"), Scale(1e-4, 1e-3, "mm"), Scale(0.0, 1e-6, "µm"))
SPEEDS = (Scale(10.0, 1.0, "m/s"), Scale(0.0, 1e-3, "mm/s"))
FORCES = (
    Scale(1e9, 1e9, "GN"),
    Scale(1e6, 1e6, "MN"),
    Scale(1e2, 1e3, "kN"),
    Scale(0.0, 1.0, "N"),
)
IMPULSES = (Scale(1e6, 1e6, "MN s"), Scale(1e4, 1e3, "kN s"), Scale(0.0, 1.0, "N s"))
ENERGIES = (
    Scale(1e6, 1e6, "MJ"),
    Scale(1e3, 1e3, "kJ"),
    Scale(1e-3, 1.0, "J"),
    Scale(0.0, 1e-3, "mJ"),
)


def plain(value: float, digits: int = 6) -> str:
    """Write a number with so many significant digits and, unless it is huge or tiny, no power."""
    text = f"{value:.{digits}g}"
    if "e" not in text or not _LEAST <= abs(value) < _MOST:
        return text
    return f"{Decimal(text):f}"


def fitting(values: Iterable[float], scales: tuple[Scale, ...]) -> Scale:
    """The unit in which the largest of some values is written."""
    largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
    if largest == 0.0:
        return next(scale for scale in scales if scale.size == min(1.0, scales[0].size))
    return next(scale for scale in scales if largest >= scale.least)
