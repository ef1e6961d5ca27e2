"""Numbers that count something."""

from __future__ import annotations

from numbers import Integral

from vibroimpact.errors import InputError


def whole(value: object, field: str, least: int = 1) -> int:
    """Read a whole number, numpy's included.

    Raises
    ------
    InputError
        If it is none, or less than `least`.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < least:
        raise InputError(f"{field}: {value!r}; a whole number of at least {least} is accepted")
    return int(value)


def share(value: object, field: str) -> float:
    """Read a number between 0 and 1, both excluded.

    Raises
    ------
    InputError
        If it is none.
    """
    from vibroimpact.model.units import DIMENSIONLESS, to_si

    number = to_si(value, DIMENSIONLESS, field, above=0.0)
    if not number < 1.0:
        raise InputError(f"{field}: {value!r}; a number between 0 and 1 is accepted")
    return number
