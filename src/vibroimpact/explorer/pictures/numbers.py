"""Numbers as a page is sent them: short, and none that JSON has not."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

WIDTH = 100
"""Columns of a text on the page."""


def short(values: Iterable[Any], digits: int = 5) -> list[float | None]:
    """Round to so many digits; None for what is not finite."""
    return [one(value, digits) for value in values]


def one(value: Any, digits: int = 5) -> float | None:
    """Round one number."""
    number = float(value)
    return float(f"{number:.{digits}g}") if math.isfinite(number) else None
