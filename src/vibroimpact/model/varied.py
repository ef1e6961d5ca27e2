"""Several parameters of a rig at once: values that are varied, and the rig that has them."""

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
from vibroimpact.model.units import doubt_damping_ratio, to_si

_FIRST = ("proportional_stiffness", "stiffness_at_restitution")
"""Parameters that also set a damping, which a damping that is named after them replaces."""

_LAST = ("stiffness_ratio", "damping_ratio", "gap_ratio", "relaxation_time")
"""Parameters that are made of others, which are set before; the last is made of the first."""


class Varied(NamedTuple):
    """Values of one parameter."""

    name: str
    values: NDArray[np.float64]
    units: str
    long_name: str


def varied(
    name: str, values: Any, rig: Oscillator, field: str, but: tuple[str, ...], why: str
) -> Varied:
    """Read values of a parameter.

    Parameters
    ----------
    name, values
        Of the registry; in SI units or as text.
    rig
        Whose units it has.
    field
        Names the values in messages.
    but
        Parameters that are not accepted here, and in words `why`.

    Raises
    ------
    InputError
        If there is no such parameter, or a value cannot be used or is given twice.
    """
    known = parameter(name, "vary").of(rig)
    if known.name in but:
        raise InputError(f"vary: {name!r} {why}; a parameter of the rig is accepted")
    values = check_list(values, field, what="a list of values")
    limits: dict[str, Any] = {"minimum": known.least} if known.zero else {"above": 0.0}
    numbers = [
        to_si(value, known.quantity, f"{field}[{i}]", **limits, maximum=known.most)
        for i, value in enumerate(values)
    ]
    if not numbers:
        raise InputError(f"{field}: empty; one or more values are accepted")
    if known.name == "damping_ratio":
        doubt_damping_ratio(max(numbers), field)
    if len(set(numbers)) < len(numbers):
        raise InputError(f"{field}: a value is given twice; distinct values are accepted")
    return Varied(known.name, np.array(numbers), known.units, known.long_name)


def vary_all(rig: Rig, values: Iterable[tuple[Parameter, float]]) -> Rig:
    """Return the rig at values of several parameters, in whatever order.

    Raises
    ------
    InputError
        If it cannot have one, or has no such parameter.
    """
    for one, value in sorted(values, key=lambda pair: _turn(pair[0].name)):
        rig = one.vary(rig, value)
        one.read(rig)  # refuses what the rig does not have
    return rig


def _turn(name: str) -> int:
    """When a parameter is set."""
    return _LAST.index(name) + 1 if name in _LAST else -int(name in _FIRST)
