"""Sizes that can be computed with: squares and quotients of them are floating-point numbers."""

from __future__ import annotations

from vibroimpact.errors import InputError, shown

SMALLEST, LARGEST = 1e-100, 1e100
"""In SI units."""


def check_size(value: object, number: float, smallest: float = 0.0) -> float:
    """Return a number of moderate size, or raise `InputError` that shows the value given."""
    if not smallest <= abs(number) <= LARGEST:
        raise InputError(
            f"{shown(value)} is outside the range that can be computed with; a size between "
            f"{smallest:g} and {LARGEST:g} in SI units is accepted"
        )
    return number
