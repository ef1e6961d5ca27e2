"""Whether a value states a unit."""

from __future__ import annotations

from vibroimpact.errors import InputError
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
