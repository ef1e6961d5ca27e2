"""What is free in a fit: parameters of the rigs and of the sensors, shared by tests or not."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError, advised, shown
from vibroimpact.model.parameters import (
    canonical,
    parameter,
    parameters,
    set_values,
    suggestion,
)
from vibroimpact.model.quantities import ACCELERATION, DIMENSIONLESS, LENGTH, Quantity
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import to_si, with_si_unit

Array = NDArray[np.float64]

SENSORS: dict[str, tuple[Quantity, float]] = {
    "displacement_scale": (DIMENSIONLESS, 1.0),
    "acceleration_scale": (DIMENSIONLESS, 1.0),
    "displacement_offset": (LENGTH, 0.0),
    "acceleration_offset": (ACCELERATION, 0.0),
}
"""What a sensor makes of a value: scale times it, plus an offset; each with what it is if right."""

_RANGE = 3.0
"""Where no bounds are given, starts are tried from a third of the rig's value to three times it."""
NEAR_ZERO = 1e-3
"""A value below this share of the size of its kind counts as zero, which has no size of its own."""
_ABOVE_ZERO = 1e-9
"""Lower bound of what must be greater than zero, in sizes."""


class FitNumber(NamedTuple):
    """One number of a fit."""

    name: str
    """Of the registry or a sensor."""
    test: str | None
    """Whose it is; None if it is shared by all tests."""
    quantity: Quantity
    start: float
    low: float
    high: float
    """What it cannot fall below and not exceed."""
    first: float
    last: float
    """Between which starts are tried."""
    scale: float
    """Its size: the fit counts in it."""
    prior: tuple[float, float] | None
    """Mean and standard deviation of what is known beforehand."""

    @property
    def key(self) -> str:
        """How it is called in the result."""
        return self.name if self.test is None else f"{self.name}[{self.test}]"

    def drawn(self, share: float) -> float:
        """A start: evenly spread over the logarithm where the range has one sign."""
        if self.first > 0.0:
            return float(self.first * (self.last / self.first) ** share)
        return self.first + share * (self.last - self.first)


def frees(
    free: Any,
    rigs: Mapping[str, Rig],
    each: Any,
    priors: Any,
    swings: Mapping[str, float] | None = None,
) -> list[FitNumber]:
    """Read what is free.

    Parameters
    ----------
    free
        Names, as a list or a string with commas; or a mapping from names to a start, a range (low,
        high), None for the rig's own value, or a mapping with ``start``, ``low`` and ``high``.
    each
        Names of parameters that are fitted separately per test, as a list or a string with commas.
    priors
        Mean and standard deviation by name; None for no prior.
    swings
        Measured size of the displacement of each test (m), where it is known.

    Raises
    ------
    InputError
        If a name is unknown, or a value cannot be used.
    """
    if not isinstance(free, Mapping):
        free = dict.fromkeys(_names(free, "free"))
    if not free:
        raise InputError("free: empty; pass the name of at least one parameter, such as 'gap'")
    known_names = parameters(next(iter(rigs.values())))
    wanted = {_name(name, known_names): value for name, value in free.items()}
    own = {_name(name, known_names, "each") for name in _names(each, "each")}
    if not isinstance(priors, Mapping | None):
        raise InputError(
            f"priors: {shown(priors)}; pass a mapping from names of parameters to pairs (mean, "
            "standard deviation)"
        )
    known = {_name(name, known_names, "priors"): value for name, value in (priors or {}).items()}
    for field, names in (("each", own), ("priors", set(known))):
        if strange := names - set(wanted):
            raise InputError(
                f"{field}: {sorted(strange)[0]!r} is not free; add it to free, or use one of the "
                f"free parameters: {', '.join(wanted)}"
            )
    free_list = []
    for name, value in wanted.items():
        for test in rigs if name in own else [None]:
            first = next(iter(rigs)) if test is None else test
            swing = (swings or {}).get(first, 0.0)
            free_list.append(_free(name, test, value, rigs[first], known.get(name), swing))
    return free_list


def _names(listing: Any, field: str) -> list[str]:
    """Names from a string with commas or a list of them."""
    if listing is None:
        return []
    if isinstance(listing, str):
        return [name.strip() for name in listing.split(",")] if listing or field == "free" else []
    names = list(listing) if isinstance(listing, Iterable) else [listing]
    if not all(isinstance(name, str) for name in names):
        raise InputError(
            f"{field}: {shown(listing)}; pass a list of names, or a string such as 'gap, mass'"
        )
    return names


def _name(name: Any, known: Iterable[str], field: str = "free") -> str:
    known = list(known)
    key = canonical(name, [*known, *SENSORS])
    if key in SENSORS or key in known:
        return key
    what = f"a parameter of the rig ({', '.join(known)}) or of a sensor ({', '.join(SENSORS)})"
    use = advised(suggestion(name, [*known, *SENSORS]), what)
    raise InputError(f"{field}: {shown(name)} is unknown; {use}")


def _free(name: str, test: str | None, value: Any, rig: Rig, prior: Any, swing: float) -> FitNumber:
    field = f"free[{name!r}]"
    least: float | None = None
    most: float | None = None
    above: float | None = None
    if name in SENSORS:
        quantity, now = SENSORS[name]
    else:
        of = parameter(name, rig, "free")
        quantity, least, most = of.quantity, of.least, of.most
        above = None if of.zero or least != 0.0 else 0.0
        now = of.read(rig)
    read = {
        key: to_si(
            one,
            quantity,
            f"{field}.{key}",
            above=above if key == "start" else None,
            minimum=least,
            maximum=most,
        )
        for key, one in _bounded(value, field).items()
        if one is not None
    }
    low = read.get("low", -math.inf if least is None else least)
    high = read.get("high", math.inf if most is None else most)
    if name.endswith("scale"):
        # A sensor's sign is given, and not found.
        positive = read.get("start", now) > 0.0
        low, high = read.get("low", 0.0 if positive else low), read.get("high", high)
        high = high if positive or "high" in read else 0.0
    if not low < high:
        raise InputError(
            f"{field}: low, {with_si_unit(low, quantity)}, is not below high, "
            f"{with_si_unit(high, quantity)}; pass a smaller low or a larger high"
        )
    inside = low <= now <= high
    middle = math.sqrt(low * high) if low > 0.0 else 0.5 * (low + high)
    start = read.get("start", now if inside else middle)
    if not low <= start <= high:
        raise InputError(
            f"{field}: the start, {with_si_unit(start, quantity)}, is not in the range from "
            f"{low:g} to {with_si_unit(high, quantity)}; pass a start in this range, or change low "
            "or high"
        )
    size = size_of(quantity, rig, swing)
    small = abs(start) < NEAR_ZERO * size
    scale = size if small else abs(start)
    if "low" in read and "high" in read:
        first, last = low, high
    elif name.endswith("scale"):
        first, last = sorted((0.8 * start, 1.25 * start))
    elif small or name in SENSORS:
        first, last = max(low, -scale), min(high, scale)
    else:
        first, last = sorted((start / _RANGE, start * _RANGE))
        first, last = max(first, low), min(last, high)
    if not first < last:
        first, last = low, high
    if above is not None:
        low = max(low, min(_ABOVE_ZERO * scale, start))
    known = None if prior is None else _prior(name, prior, quantity)
    return FitNumber(name, test, quantity, start, low, high, first, last, scale, known)


def _bounded(value: Any, field: str) -> dict[str, Any]:
    """Start and bounds, as far as they are given."""
    if isinstance(value, Mapping):
        bounded = dict(value)
        if strange := set(bounded) - {"start", "low", "high"}:
            name = shown(min(strange, key=str))
            raise InputError(f"{field}: the key {name} is unknown; use start, low or high")
        return bounded
    if isinstance(value, Sequence) and not isinstance(value, str | bytes):
        if len(value) != 2:
            raise InputError(f"{field}: {shown(value)}; pass a range (low, high)")
        return {"low": value[0], "high": value[1]}
    return {} if value is None else {"start": value}


def _prior(name: str, prior: Any, quantity: Quantity) -> tuple[float, float]:
    """Mean and standard deviation."""
    field = f"priors[{name!r}]"
    pair = list(prior) if isinstance(prior, Iterable) and not isinstance(prior, str) else []
    if len(pair) != 2:
        raise InputError(f"{field}: {shown(prior)}; pass a pair (mean, standard deviation)")
    mean, deviation = pair
    size = to_si(deviation, quantity, f"{field}[1]", above=0.0)
    return to_si(mean, quantity, f"{field}[0]"), size


def size_of(quantity: Quantity, rig: Rig, swing: float = 0.0) -> float:
    """The size of a kind of number, from the rig's mass, its frequency and how far it swings.

    `swing` is the measured displacement (m), where it is known: the base of a free vibration is at
    rest.
    """
    oscillator, shaken = rig.oscillator, rig.periodic
    omega = oscillator.angular_frequency or shaken.angular_frequency
    driven = float(np.sum(shaken.acceleration(oscillator.mass, omega))) / omega**2
    sizes = {"kilogram": oscillator.mass, "meter": max(driven, swing), "second": 1.0 / omega}
    return math.prod(sizes.get(unit, 1.0) ** power for unit, power in quantity.base) or 1.0


def written(
    free_list: Sequence[FitNumber],
    values: Array | Sequence[float],
    rig: Rig,
    test: str,
    ties: Mapping[str, str],
) -> tuple[Rig, dict[str, float]]:
    """The rig and shaking of a test, and its sensors, at some values of what is free."""
    sensors = {name: right for name, (_, right) in SENSORS.items()}
    here = {
        one.name: float(value)
        for one, value in zip(free_list, values, strict=True)
        if one.test in (None, test)
    }
    sensors |= {name: value for name, value in here.items() if name in SENSORS}
    rig = set_values(rig, {name: value for name, value in here.items() if name not in SENSORS})
    for tied, to in ties.items():
        rig = parameter(tied, rig).vary(rig, parameter(to, rig).read(rig))
    return rig, sensors
