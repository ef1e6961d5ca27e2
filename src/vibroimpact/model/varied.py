"""Vary several parameters of a rig at once."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.arguments import check_list
from vibroimpact.errors import InputError
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.parameters import Parameter, parameter
from vibroimpact.model.rig import Rig
from vibroimpact.model.sizes import doubt_damping_ratio
from vibroimpact.model.units import pretty, to_si

_FIRST = ("proportional_stiffness", "stiffness_at_restitution")
"""Parameters that also set a damping. They are set first, so that a varied damping replaces it."""

_LAST = ("stiffness_ratio", "damping_ratio", "gap_ratio", "relaxation_time")
"""Parameters that depend on others. They are set after all others, in this order."""


class Varied(NamedTuple):
    """The values of one parameter that is varied."""

    name: str
    values: NDArray[np.float64]
    units: str
    long_name: str


def varied(
    name: str, values: Any, rig: Oscillator, field: str, but: tuple[str, ...], why: str
) -> Varied:
    """Read the values of a parameter that is varied.

    Parameters
    ----------
    name, values
        Name of the parameter, and its values in SI units or as texts with units.
    rig
        The oscillator. The unit of the parameter may depend on its laws.
    field
        Name of the values in messages.
    but, why
        Names of parameters that are not accepted, and the reason in words.

    Raises
    ------
    InputError
        If there is no such parameter, or if a value is invalid or occurs twice.
    """
    known = parameter(name, rig, "vary")
    if known.name in but:
        raise InputError(f"vary: {name!r} {why}; remove it")
    values = check_list(values, field, what="a list of values")
    limits: dict[str, Any] = {"minimum": known.least} if known.zero else {"above": 0.0}
    numbers = [
        to_si(value, known.quantity, f"{field}[{i}]", **limits, maximum=known.most)
        for i, value in enumerate(values)
    ]
    if not numbers:
        raise InputError(f"{field}: the list is empty; pass at least one value")
    if known.name == "damping_ratio":
        doubt_damping_ratio(max(numbers), field)
    if twice := [one for i, one in enumerate(numbers) if one in numbers[:i]]:
        raise InputError(
            f"{field}: {pretty(twice[0], known.quantity)} is given twice; remove one of the two"
        )
    return Varied(known.name, np.array(numbers), known.units, known.long_name)


def vary_all(rig: Rig, values: Iterable[tuple[Parameter, float]]) -> Rig:
    """Return the rig with values of several parameters. Their order does not matter.

    Raises
    ------
    InputError
        If the rig does not have a parameter, or if a value is invalid.
    """
    for one, value in sorted(values, key=lambda pair: turn(pair[0].name)):
        rig = one.vary(rig, value)
        one.read(rig)  # refuses what the rig does not have
    return rig


def turn(name: str) -> int:
    """When a parameter is set."""
    return _LAST.index(name) + 1 if name in _LAST else -int(name in _FIRST)
