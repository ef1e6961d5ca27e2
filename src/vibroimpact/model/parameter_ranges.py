"""Parameters of a rig that are varied: a range or values by path, and several set at once."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact.arguments import MOST_LISTED, check_list, check_mapping
from vibroimpact.errors import InputError, shown
from vibroimpact.model.parameters import Parameter, parameter
from vibroimpact.model.quantity_lists import read_span
from vibroimpact.model.rig import Rig
from vibroimpact.model.size_checks import doubt_damping_ratio
from vibroimpact.model.system import System
from vibroimpact.model.units import pretty, to_si

Ranges: TypeAlias = Mapping[str, tuple[float | str, float | str]]
"""Lowest and highest value by parameter, in SI units or as strings with units."""
Values: TypeAlias = Mapping[str, ArrayLike]
"""Values by parameter, in SI units or as strings with units."""

_RANGES = {"frequency": ("1 Hz", "3 Hz"), "gap": ("5 mm", "8 mm")}
_VALUES = {"gap": ["5 mm", "8 mm"], "damping_ratio": [0.05, 0.1]}
_COUNTS = {0: "no", 1: "one", 2: "two"}


class ParameterValues(NamedTuple):
    """The values of one parameter that is varied."""

    name: str
    values: NDArray[np.float64]
    units: str
    long_name: str


class ParameterRange(NamedTuple):
    """A parameter that is varied, and its lowest and highest value in SI units."""

    parameter: Parameter
    low: float
    high: float
    field: str
    """Name of the range in messages, such as ``vary['gap']``."""

    @property
    def ends(self) -> tuple[float, float]:
        """Lowest and highest value."""
        return self.low, self.high

    def check_contains(self, value: float, why: str = "") -> None:
        """Refuse a range that does not contain the rig's own value. ``why`` it must, in words."""
        if not self.low <= value <= self.high:
            low, high, own = (pretty(one, self.parameter.quantity) for one in (*self.ends, value))
            raise InputError(
                f"{self.field}: {low} to {high} does not contain the rig's {self.parameter.name} "
                f"of {own}{why}; widen this range"
            )


def read_ranges(vary: object, rig: Rig | System, count: int | None = 1) -> list[ParameterRange]:
    """Read parameters and their ranges, such as ``{"gap": ("3 mm", "7 mm")}``.

    Parameters
    ----------
    rig
        The rig. The unit of a parameter may depend on its laws.
    count
        Number of parameters. None if any number of at least one is accepted.
    """
    least, most = (1, None) if count is None else (count, count)
    examples = {"gap": _RANGES["gap"]} if count is None else _RANGES
    ranges = _mapping(vary, "ranges", examples, least, most)
    return [
        read_range(varied, span, field_of(name))
        for (name, span), varied in zip(ranges.items(), _parameters(ranges, rig), strict=True)
    ]


def read_range(
    varied: Parameter, span: object, field: str, *, positive: bool = False
) -> ParameterRange:
    """Read the range of a parameter, a pair.

    With `positive`, the values must be greater than 0, as for logarithmic spacing.
    """
    bounds = _bounds(varied, positive)
    low, high = read_span(span, varied.quantity, field, f"value of {varied.name}", **bounds)
    return ParameterRange(varied, low, high, field)


def read_values(
    vary: object,
    rig: Rig | System,
    *,
    least: int = 0,
    most: int | None = None,
    longest: int = MOST_LISTED,
    but: tuple[str, ...] = (),
    why: str = "",
) -> tuple[ParameterValues, ...]:
    """Read parameters and their values, such as ``{"gap": ["3 mm", "7 mm"]}``.

    No value may occur twice.

    Parameters
    ----------
    vary
        The argument. None means no parameter, if this is accepted.
    least, most
        Least and largest number of parameters.
    but, why
        Names of parameters that are not accepted, and the reason in words.
    """
    lists = entries(vary, least, most)
    parameters = _parameters(lists, rig)
    for name, one in zip(lists, parameters, strict=True):
        if one.name in but:
            raise InputError(f"vary: {name!r} {why}; remove it")
    return tuple(
        _values(varied, values, field_of(name), longest)
        for (name, values), varied in zip(lists.items(), parameters, strict=True)
    )


def stated(vary: object) -> dict[str, Any]:
    """Return the values or ranges by their names in messages, to see which state a unit.

    What is not a mapping has none; it is refused where it is read.
    """
    return (
        {field_of(str(name)): one for name, one in vary.items()}
        if isinstance(vary, Mapping)
        else {}
    )


def entries(vary: object, least: int = 0, most: int | None = None) -> dict[str, Any]:
    """Return the values of the parameters that are varied, as they were passed.

    They must be a mapping from names, with `least` to `most` entries.
    """
    return _mapping({} if vary is None and not least else vary, "values", _VALUES, least, most)


def field_of(name: str) -> str:
    """Return the name of the values or of the range of a parameter in messages."""
    return f"vary[{name!r}]"


def _mapping(
    vary: object, kind: str, examples: Mapping[str, Any], least: int, most: int | None
) -> dict[str, Any]:
    count = _COUNTS[least if most is None else most]
    bound = "at least " if most is None else "" if least == most else "at most "
    plural = "" if count == "one" else "s"
    clause = f", with {bound}{count} parameter{plural}" if least or most else ""
    shortest = dict(itertools.islice(examples.items(), max(1, most or 1)))
    example = repr(shortest).replace("'", '"')
    what = f"a dict of {kind} by parameter{clause}, such as {example}"
    mapping = dict(check_mapping(vary, "vary", what))
    if len(mapping) < least or (most is not None and len(mapping) > most):
        names = ", ".join(map(shown, mapping)) or "no parameter"
        raise InputError(f"vary: {names}; pass {what}")
    return mapping


def _parameters(mapping: Mapping[str, Any], rig: Rig | System) -> list[Parameter]:
    by_path: dict[str, Parameter] = {}
    for name in mapping:
        one = parameter(name, rig, "vary")
        if one.name in by_path:
            first = next(other for other in mapping if parameter(other, rig, "vary") == one)
            raise InputError(
                f"vary: {first!r} and {name!r} are the same parameter; remove one of the two"
            )
        by_path[one.name] = one
    return list(by_path.values())


def _bounds(varied: Parameter, positive: bool = False) -> dict[str, float | None]:
    """Return the bounds of the values of a parameter, as `to_si` accepts them."""
    if positive or not varied.zero:
        return {"above": 0.0, "maximum": varied.most}
    return {"minimum": varied.least, "maximum": varied.most}


def _values(varied: Parameter, values: object, field: str, longest: int) -> ParameterValues:
    items = check_list(values, field, longest, f"a list of values of {varied.name}")
    numbers = [
        to_si(value, varied.quantity, f"{field}[{i}]", **_bounds(varied))
        for i, value in enumerate(items)
    ]
    if not numbers:
        raise InputError(f"{field}: the list is empty; pass at least one value of {varied.name}")
    if varied.name == "damping_ratio":
        doubt_damping_ratio(max(numbers), field)
    if twice := [one for i, one in enumerate(numbers) if one in numbers[:i]]:
        raise InputError(
            f"{field}: {pretty(twice[0], varied.quantity)} is given twice; remove one of the two"
        )
    return ParameterValues(varied.name, np.array(numbers), varied.units, varied.long_name)
