"""What stands beside the columns of a file: the shaking, and what is not understood."""

from __future__ import annotations

import re
from collections.abc import Mapping

from vibroimpact.measurements.columns import Columns
from vibroimpact.measurements.sampling import is_sampling
from vibroimpact.model.quantities import ACCELERATION, FREQUENCY, GRAVITY
from vibroimpact.model.units import to_si
from vibroimpact.records.stated import ended, spelled

_BARE = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)(e[+-]?\d+)?", re.IGNORECASE)
"""A number without a unit."""
_SHAKEN = {"amplitude": ACCELERATION, "frequency": FREQUENCY}


def shaking(table: Columns, given: Mapping[str, object], notes: list[str]) -> dict[str, float]:
    """Amplitude and frequency of the base, in SI units, as the call or the file says them.

    Parameters
    ----------
    table
        What was read.
    given
        What the call says, which comes first; None where it says nothing.
    notes
        What was guessed, and the numbers that were left out, in words; added to.

    Raises
    ------
    InputError
        If one of them cannot be read, or is not above 0.
    """
    written: dict[str, str] = {}
    left = []
    for key, text in table.said.items():
        bare, unit = ended(key)
        if bare in _SHAKEN:
            written.setdefault(bare, with_unit(text, unit))
        elif _odd(key, text):
            left.append(f"{key} = {text}")
    found = {}
    for name, quantity in _SHAKEN.items():
        value, said = given.get(name), written.get(name, "")
        if value is None and not said:
            continue
        found[name] = to_si(said if value is None else value, quantity, name, above=0.0)
        if value is None and _BARE.fullmatch(said.strip()):
            told = f"{found[name]:.6g} {quantity.symbol}"
            told += f" ({found[name] / GRAVITY:.3g} g)" if quantity is ACCELERATION else ""
            notes.append(f"{name} has no unit: taken as {told}")
    if left:
        notes.append(
            "entries next to the columns that were not understood and were left out: "
            f"{', '.join(left)}"
        )
    return found


def is_number(text: str) -> bool:
    """Whether a text is a number, with a unit or without; a date is none."""
    begin = _BARE.match(text)
    return begin is not None and re.fullmatch(r" *([^\W\d_].*|%)?", text[begin.end() :]) is not None


def with_unit(text: str, unit: str | None) -> str:
    """A number with the unit that its name ends in, where it has none of its own."""
    return f"{text} {spelled(unit)}" if unit and _BARE.fullmatch(text.strip()) else text


def _odd(key: str, text: str) -> bool:
    """Whether a number may matter, and is not used; what a format itself writes does not."""
    own = key.startswith("_") or key.lower().startswith(("matlab_", "wf_")) or key == "group"
    return is_number(text.strip()) and not own and not is_sampling(key)
