"""Entries of a file next to its columns: the shaking, and entries that are not understood."""

from __future__ import annotations

from collections.abc import Mapping

from vibroimpact.errors import InputError
from vibroimpact.measurements.columns import Columns
from vibroimpact.measurements.sampling import is_sampling
from vibroimpact.model.quantities import ACCELERATION, FREQUENCY
from vibroimpact.model.units import to_si
from vibroimpact.tables.headings import BARE, is_number
from vibroimpact.tables.units import ended, spelled

_SHAKEN = {"amplitude": ACCELERATION, "frequency": FREQUENCY}


def shaking(table: Columns, arguments: Mapping[str, object], notes: list[str]) -> dict[str, float]:
    """Return the amplitude and the frequency of the base in SI units, from the call or the file.

    Parameters
    ----------
    arguments
        Values in the call, which take precedence. None if the call has no value.
    notes
        List to which notes on assumptions and on numbers that were left out are added.

    Raises
    ------
    InputError
        If a value cannot be read, if it is not greater than 0, or if an amplitude in the file has
        no unit.
    """
    written: dict[str, str] = {}
    left = []
    for key, text in table.said.items():
        bare, unit = ended(key)
        if bare in _SHAKEN:
            written.setdefault(bare, with_unit(text, unit))
        elif _odd(key, text):
            left.append(f"{key} = {text}")
    values = {}
    for name, quantity in _SHAKEN.items():
        value, said = arguments.get(name), written.get(name, "")
        if value is None and not said:
            continue
        is_bare = value is None and BARE.fullmatch(said.strip()) is not None
        if is_bare and quantity is ACCELERATION:
            raise InputError(
                f"measurement: {table.path!r}: {name} = {said} has no unit; pass {name}= "
                f"(--{name}) with a unit, such as '0.05 g', or write the unit in the file"
            )
        values[name] = to_si(said if value is None else value, quantity, name, above=0.0)
        if is_bare:
            notes.append(f"{name} has no unit, so {values[name]:.6g} {quantity.symbol} was assumed")
    if left:
        notes.append(
            f"entries outside the columns were not understood and were left out: {', '.join(left)}"
        )
    return values


def with_unit(text: str, unit: str | None) -> str:
    """Return a number with the unit at the end of its name, if the number has no unit."""
    return f"{text} {spelled(unit)}" if unit and BARE.fullmatch(text.strip()) else text


def _odd(key: str, text: str) -> bool:
    """Return whether an entry is an unused number that the format itself does not write."""
    own = key.startswith("_") or key.lower().startswith(("matlab_", "wf_")) or key == "group"
    return is_number(text.strip()) and not own and not is_sampling(key)
