"""Numbers that are sent to a page: rounded, and only numbers that JSON can contain."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

WIDTH = 100
"""Number of columns of a text on the page."""


def short(values: Iterable[Any], digits: int = 5) -> list[float | None]:
    """Return numbers rounded to `digits` significant digits. Infinity and NaN become None."""
    return [one(value, digits) for value in values]


def one(value: Any, digits: int = 5) -> float | None:
    """Return a number rounded to `digits` significant digits, or None if it is not finite."""
    number = float(value)
    return float(f"{number:.{digits}g}") if math.isfinite(number) else None
