"""Accepted sizes of values. Their squares and quotients must be floating-point numbers."""

from __future__ import annotations

from vibroimpact.errors import InputError, shown, suggested, warn_of_input

SMALLEST, LARGEST = 1e-100, 1e100
"""Smallest and largest accepted size in SI units."""


def check_size(value: object, number: float, smallest: float = 0.0) -> float:
    """Return a number whose size is accepted. `value` is shown in the error message.

    Its absolute value is at most `LARGEST`, and at least `smallest`.
    """
    if not smallest <= abs(number) <= LARGEST:
        wrong = "small; pass at least" if abs(number) < smallest else "large; pass at most"
        limit = smallest if abs(number) < smallest else LARGEST
        raise InputError(f"{shown(value)} is too {wrong} {limit:g} (absolute value in SI units)")
    return number


_FAR_OVERDAMPED = 2.0
"""A damping ratio from which on a percentage is more likely."""


def doubt_damping_ratio(value: float, field: str) -> None:
    """Issue a warning if a damping ratio was probably meant in percent."""
    if value >= _FAR_OVERDAMPED:
        percent = suggested(f"{value:g} %").strip()
        warn_of_input(field, [f"{value:g} is {value:g} times the critical damping; {percent}"])
