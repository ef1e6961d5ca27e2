"""Read ranges and rising lists of one quantity."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.arguments import check_list, is_pair
from vibroimpact.errors import InputError, shown
from vibroimpact.model.quantities import Quantity
from vibroimpact.model.units import pretty, to_si

_COUNTS = ("is empty", "has one value", "has two values")


def read_span(
    span: Any, quantity: Quantity, field: str, what: str = "value", **bounds: float | None
) -> tuple[float, float]:
    """Return the lowest and the highest value of a range in SI units.

    Parameters
    ----------
    quantity, field, bounds
        As in `to_si`.
    what
        What the values are, for error messages.

    Raises
    ------
    InputError
        If it is not a pair in rising order, if a value is invalid, or if only one has a unit.
    """
    if not is_pair(span):
        raise InputError(
            f"{field}: {shown(span)}; pass the lowest and the highest {what} as (low, high)"
        )
    low, high = (to_si(end, quantity, f"{field}[{i}]", **bounds) for i, end in enumerate(span))
    check_stated_units(span, quantity, field)
    if not low < high:
        first, second = (pretty(end, quantity) for end in (low, high))
        raise InputError(
            f"{field}: the first value, {first}, is not below the second, {second}; pass the lower "
            "value first"
        )
    return low, high


def check_stated_units(ends: Iterable[Any], quantity: Quantity, field: str) -> None:
    """Refuse valid ends of a range of which only one has a unit; 0 needs none.

    ``10:60 kN/m`` would begin at 10 N/m.
    """
    if not quantity.base:
        return
    with_unit = [end for end in ends if _states_unit(end)]
    bare = [end for end in ends if not _states_unit(end) and float(end)]
    if with_unit and bare:
        raise InputError(
            f"{field}: {shown(with_unit[0])} has a unit and {shown(bare[0])} has none; write both "
            "with units"
        )


def _states_unit(value: Any) -> bool:
    """Return whether a valid value has a unit."""
    if not isinstance(value, str):
        return hasattr(value, "to_base_units")  # of pint
    try:
        float(value)
    except ValueError:
        return True
    return False


def read_rising(
    values: Any, quantity: Quantity, field: str, least: int = 1, **bounds: float | None
) -> NDArray[np.float64]:
    """Return a list of rising values in SI units.

    Parameters
    ----------
    quantity, field, bounds
        As in `to_si`.
    least
        Smallest number of values.

    Raises
    ------
    InputError
        If it is not a list of so many rising values. The message has the position and the value of
        the first wrong one.
    """
    items = check_list(values, field, what=f"a list of values, such as [{quantity.example!r}]")
    if isinstance(values, np.ndarray) and values.dtype == float and values.ndim == 1:
        items = tuple(values.tolist())  # of plain floats, which are read at once
    numbers = np.array(
        [to_si(one, quantity, f"{field}[{i}]", **bounds) for i, one in enumerate(items)]
    )
    if len(numbers) < least:
        needed = _COUNTS[least].removeprefix("has ")
        raise InputError(f"{field}: the list {_COUNTS[len(numbers)]}; pass at least {needed}")
    for i in np.flatnonzero(np.diff(numbers) <= 0.0):
        last, this = (pretty(float(one), quantity, 9) for one in numbers[i : i + 2])
        raise InputError(
            f"{field}[{i + 1}]: {this} follows {last}; sort the values in increasing order, and "
            "pass each one only once"
        )
    return numbers
