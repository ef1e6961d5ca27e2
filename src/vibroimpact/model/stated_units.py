"""Whether a value states a unit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from vibroimpact.errors import InputError, shown
from vibroimpact.model.units import to_si_of_any


def has_unit(value: object) -> bool:
    """Return whether a value states a unit of mass, length or time, such as ``"5 mm"``.

    A percentage and an angle do not; neither does a text that is not a quantity.
    """
    if hasattr(value, "to_base_units"):  # of pint
        value = str(value)
    if not isinstance(value, str):
        return False
    try:
        return any(to_si_of_any(value, "value")[1] or ())
    except InputError:
        return False


def check_no_units(table: Mapping[str, Any]) -> None:
    """Refuse values with a unit in the table of a system without units."""
    for path, value in values_of(table):
        if has_unit(value):
            raise InputError(
                f'{path}: {shown(value)} has a unit, but units is "none"; pass a number without a '
                "unit, or remove units"
            )


def values_of(table: Mapping[str, Any], path: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the values of nested tables, with their paths."""
    for name, value in table.items():
        if isinstance(value, Mapping):
            yield from values_of(value, f"{path}{name}.")
        else:
            yield f"{path}{name}", value
