"""What is free in a fit: parameters of the rigs and of the sensors, shared by tests or not."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError, meant
from vibroimpact.model.access import Setting
from vibroimpact.model.parameters import PARAMETERS, Parameter, parameter
from vibroimpact.model.quantities import ACCELERATION, DIMENSIONLESS, LENGTH, Quantity
from vibroimpact.model.units import shown, to_si

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


class Free(NamedTuple):
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
    given: Any,
    settings: Mapping[str, Setting],
    each: Iterable[str],
    priors: Mapping[str, Any],
) -> list[Free]:
    """Read what is free.

    Parameters
    ----------
    given
        Names, as a list or a text with commas; or a mapping from names to a start, a range (low,
        high), None for the rig's own value, or a mapping with ``start``, ``low`` and ``high``.
    settings
        The rig and shaking of each test.
    each
        Names of those that every test has its own of.
    priors
        Mean and standard deviation by name.

    Raises
    ------
    InputError
        If a name is unknown, or a value cannot be used.
    """
    if isinstance(given, str):
        given = [name.strip() for name in given.split(",")]
    if not isinstance(given, Mapping):
        given = dict.fromkeys(given)
    if not given:
        raise InputError("free: nothing is free; the name of at least one parameter is accepted")
    wanted = {_name(name): value for name, value in given.items()}
    own = {_name(name) for name in each}
    known = {_name(name): value for name, value in priors.items()}
    for field, names in (("each", own), ("priors", set(known))):
        if strange := names - set(wanted):
            raise InputError(
                f"{field}: {sorted(strange)[0]!r} is not free; {', '.join(wanted)} are accepted"
            )
    found = []
    for name, value in wanted.items():
        for test in settings if name in own else [None]:
            rig = settings[test] if test is not None else next(iter(settings.values()))
            found.append(_free(name, test, value, rig, known.get(name)))
    return found


def _name(name: str) -> str:
    key = name.replace("-", "_") if isinstance(name, str) else name
    if key in SENSORS or key in PARAMETERS:
        return str(key)
    hint = meant(name, [*PARAMETERS, *SENSORS])
    raise InputError(
        f"free: {name!r}; {hint}{'A' if hint else 'a'} parameter of a rig "
        f"({', '.join(PARAMETERS)}) or of a sensor ({', '.join(SENSORS)}) is accepted"
    )


def _free(name: str, test: str | None, value: Any, setting: Setting, prior: Any) -> Free:
    field = f"free[{name!r}]"
    least: float | None = None
    most: float | None = None
    if name in SENSORS:
        quantity, now = SENSORS[name]
        if name.endswith("scale"):
            least = 0.0
    else:
        of = _parameter(name, setting)
        quantity, least, most = of.quantity, of.least, of.most
        now = of.read(*setting)
    bounded: dict[str, Any] = {}
    if isinstance(value, Mapping):
        bounded = dict(value)
        if strange := set(bounded) - {"start", "low", "high"}:
            raise InputError(f"{field}: {sorted(strange)[0]!r}; start, low and high are accepted")
    elif isinstance(value, Sequence) and not isinstance(value, str):
        if len(value) != 2:
            raise InputError(f"{field}: {shown(value)}; a range (low, high) is accepted")
        bounded = {"low": value[0], "high": value[1]}
    elif value is not None:
        bounded = {"start": value}
    read = {
        key: to_si(one, quantity, f"{field}.{key}", minimum=least, maximum=most)
        for key, one in bounded.items()
        if one is not None
    }
    low = read.get("low", -math.inf if least is None else least)
    high = read.get("high", math.inf if most is None else most)
    if not low < high:
        raise InputError(f"{field}: low {low:g} is not below high {high:g}; it has to be")
    inside = low <= now <= high
    middle = math.sqrt(low * high) if low > 0.0 else 0.5 * (low + high)
    start = read.get("start", now if inside else middle)
    if not low <= start <= high:
        raise InputError(f"{field}: the start {start:g} lies outside {low:g} to {high:g}")
    scale = abs(start) or _size_of(name, setting)
    if "low" in read and "high" in read:
        first, last = low, high
    elif name in SENSORS:
        first, last = (0.8, 1.25) if name.endswith("scale") else (-scale, scale)
    elif start == 0.0:
        first, last = max(low, -scale), min(high, scale)
    else:
        first, last = sorted((start / _RANGE, start * _RANGE))
        first, last = max(first, low), min(last, high)
    if not first < last:
        first, last = low, high
    known = None
    if prior is not None:
        mean, deviation = prior
        known = (
            to_si(mean, quantity, f"priors[{name!r}][0]"),
            to_si(deviation, quantity, f"priors[{name!r}][1]", above=0.0),
        )
    return Free(name, test, quantity, start, low, high, first, last, scale, known)


def _parameter(name: str, setting: Setting) -> Parameter:
    rig, shaken = setting
    return parameter(name, of=shaken.of).of(rig)


def _size_of(name: str, setting: Setting) -> float:
    """The size of a number that is 0 in the rig."""
    rig, shaken = setting
    swing = float(shaken.acceleration(rig.mass, rig.angular_frequency or 1.0))
    swing /= rig.angular_frequency**2 or 1.0
    pull = rig.isolator.initial_stiffness * swing
    quantity = SENSORS[name][0] if name in SENSORS else _parameter(name, setting).quantity
    if quantity is LENGTH:
        return swing
    if quantity is ACCELERATION:
        return swing * rig.angular_frequency**2 or 1.0
    symbols = {"N": pull, "N s/m": rig.mass * rig.angular_frequency, "N/m³": pull / swing**3}
    return symbols.get(quantity.symbol, 1.0) or 1.0


def written(
    given: Sequence[Free],
    values: Array,
    setting: Setting,
    test: str,
    ties: Mapping[str, str],
) -> tuple[Setting, dict[str, float]]:
    """The rig and shaking of a test, and its sensors, at some values of what is free."""
    sensors = {name: right for name, (_, right) in SENSORS.items()}
    for one, value in zip(given, values, strict=True):
        if one.test is not None and one.test != test:
            continue
        if one.name in SENSORS:
            sensors[one.name] = float(value)
        else:
            setting = PARAMETERS[one.name].write(*setting, float(value))
    for tied, to in ties.items():
        setting = PARAMETERS[tied].write(*setting, PARAMETERS[to].read(*setting))
    return setting, sensors
