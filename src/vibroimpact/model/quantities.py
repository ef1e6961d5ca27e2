"""Physical quantities: their units, and how their values are written."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

from vibroimpact.model.written_units import unitless

GRAVITY = 9.80665
"""Standard acceleration of gravity in m/s² (the *g* of ``"0.05 g"``)."""


class Scale(NamedTuple):
    """A unit for printed values."""

    least: float
    """Smallest value (in SI units) that is printed in this unit."""
    size: float
    """Size of the unit in SI units."""
    symbol: str


def fitting(values: Iterable[float], scales: tuple[Scale, ...]) -> Scale:
    """Return the unit in which the largest of the values is written; the SI unit for zeros.

    The values of a rig without units are written as they are, and a frequency f as ω = 2π f.
    """
    if unitless() and scales is not ANGLE.scales:
        return Scale(0.0, 1.0 / math.tau if scales is FREQUENCY.scales else 1.0, "")
    largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
    if largest == 0.0:
        return next((scale for scale in scales if scale.size == 1.0), scales[0])
    return next(scale for scale in scales if largest >= scale.least)


_FACTOR = re.compile(r"([A-Za-z]+|1)(?:\^(-?[\d.]+))?")
"""A unit and its power, in a symbol such as N s/m^3."""


def _factors(symbol: str) -> list[tuple[str, float]] | None:
    """Return the units of a symbol with their powers, or None if it is not a product of powers."""
    above, _, below = symbol.replace("²", "^2").replace("³", "^3").partition("/")
    tokens = [(1.0, one) for one in above.split()] + [(-1.0, one) for one in below.split()]
    matches = [(sign, _FACTOR.fullmatch(token)) for sign, token in tokens]
    if any(one is None for _, one in matches):
        return None
    return [(one[1], sign * float(one[2] or 1)) for sign, one in matches if one and one[1] != "1"]


@dataclass(frozen=True, slots=True)
class Quantity:
    """A physical quantity, with its units.

    Attributes
    ----------
    name
        Name in messages, such as ``"length"``.
    base
        Exponents of the SI base units. The radian counts as a base unit, so that an angle differs
        from a ratio, and an angular frequency from a frequency.
    symbol
        The SI unit, such as ``"m"``; empty for a ratio.
    example
        Accepted string with a unit, such as ``"15 mm"``.
    number
        The same example as a number in SI units.
    scales
        Units for printed values, from the largest to the smallest.
    """

    name: str
    base: tuple[tuple[str, float], ...]
    symbol: str
    example: str
    number: float
    scales: tuple[Scale, ...]

    def unit(self, *values: float) -> Scale:
        """Return the unit in which the largest of the values is written; the SI unit for zeros."""
        return fitting(values, self.scales)

    @property
    def phrase(self) -> str:
        """The name with its article, such as ``"a length"``."""
        return f"{'an' if self.name[0] in 'aeiou' else 'a'} {self.name}"

    @property
    def units(self) -> str:
        """The SI unit as datasets state it, such as ``"N s m-1"``; ``"1"`` for a ratio.

        The symbol itself if an exponent is not an integer.
        """
        factors = _factors(self.symbol)
        if factors is None or not all(power.is_integer() for _, power in factors):
            return self.symbol
        words = [f"{unit}{power:g}" if power != 1.0 else unit for unit, power in factors]
        return " ".join(words) or "1"

    def size(self, mass: float, length: float, time: float) -> float:
        """Return the value (SI units) that is made of a mass (kg), a length (m) and a time (s)."""
        units = {"kilogram": mass, "meter": length, "second": time, "radian": 1.0}
        return float(math.prod(units[unit] ** power for unit, power in self.base))


_PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "": 1.0, "m": 1e-3, "µ": 1e-6}
_OF_FORCE = {"G": 1e10, "M": 1e7, "k": 1e3, "": 0.0}
"""Least values that are printed with these prefixes of a unit of force or energy."""
_WHOLE: Mapping[str, float] = MappingProxyType({"": 0.0})
"""The same where only the unit itself is used."""

_BASE_OF = {
    "kg": (1, 0, 0),
    "m": (0, 1, 0),
    "s": (0, 0, 1),
    "N": (1, 1, -2),
    "J": (1, 2, -2),
    "W": (1, 2, -3),
    "Pa": (1, -1, -2),
    "Hz": (0, 0, -1),
}
"""Powers of mass, length and time in the units of which symbols are made."""

_Powers: TypeAlias = tuple[float, float, float]


def _made(
    name: str,
    symbol: str,
    example: str,
    number: float,
    least: Mapping[str, float] | Iterable[Scale] = _WHOLE,
    powers: _Powers | None = None,
) -> Quantity:
    """Return a quantity: `least` has the least printed value by prefix, or is the scales.

    The powers of mass, length and time are by default those of the symbol.
    """
    scales = (
        [Scale(one, _PREFIXES[prefix], f"{prefix}{symbol}") for prefix, one in least.items()]
        if isinstance(least, Mapping)
        else least
    )
    exponents = zip(("kilogram", "meter", "second"), powers or _powers_of(symbol), strict=True)
    base = tuple((unit, power) for unit, power in exponents if power)
    return Quantity(name, base, symbol, example, number, tuple(scales))


def _powers_of(symbol: str) -> _Powers:
    """Return the powers of mass, length and time in a symbol."""
    factors = _factors(symbol)
    if factors is None or any(unit not in _BASE_OF for unit, _ in factors):
        raise ValueError(
            f"{symbol!r} is not a product of powers of {', '.join(_BASE_OF)}; write a unit such as "
            "'N s/m^3'"
        )
    mass, length, time = (
        sum(power * _BASE_OF[unit][i] for unit, power in factors) for i in range(3)
    )
    return mass, length, time


LENGTH = _made("length", "m", "15 mm", 0.015, {"": 1.0, "m": 1e-4, "µ": 0.0})
MASS = _made("mass", "kg", "550 kg", 550, (Scale(1e4, 1e3, "t"), Scale(0.0, 1.0, "kg")))
STIFFNESS = _made("stiffness", "N/m", "510 kN/m", 510000, _OF_FORCE)
DAMPING = _made("damping", "N s/m", "1.1 kN s/m", 1100, {"M": 1e6, "k": 1e2, "": 0.0})
ACCELERATION = _made(
    "acceleration",
    "m/s²",
    "0.05 g",
    0.4903325,
    (
        Scale(1e-4 * GRAVITY, GRAVITY, "g"),
        Scale(1e-7 * GRAVITY, 1e-3 * GRAVITY, "mg"),
        Scale(0.0, 1.0, "m/s²"),
    ),
)
FREQUENCY = _made("frequency", "Hz", "2.5 Hz", 2.5, {"k": 1e3, "": 0.0})
TIME = _made("time", "s", "20 ms", 0.02, {"": 0.1, "m": 0.0})
PERIOD = replace(TIME, example="2.5 s", number=2.5)
VELOCITY = _made("velocity", "m/s", "150 mm/s", 0.15, {"": 1.0, "m": 0.0})
FORCE = _made("force", "N", "120 N", 120, {"G": 1e9, "M": 1e6, "k": 1e3, "": 0.0})
UNBALANCE = _made(
    "unbalance", "kg m", "0.4 kg m", 0.4, (Scale(1e-2, 1.0, "kg m"), Scale(0.0, 1e-6, "g mm"))
)
"""m e of a rotating mass m whose centre lies the distance e off its axis."""
IMPULSE = _made("impulse", "N s", "2 kN s", 2000, {"M": 1e6, "k": 1e3, "": 0.0})
ENERGY = _made("energy", "J", "2 kJ", 2000, {"M": 1e6, "k": 1e3, "": 1e-3, "m": 0.0})
ANGLE = Quantity("angle", (("radian", 1),), "rad", "90 deg", 1.5708, (Scale(0.0, 1.0, "rad"),))
DIMENSIONLESS = _made("dimensionless number", "", "0.15", 0.15)
DISSIPATION = _made("dissipation factor", "s/m", "0.4 s/m", 0.4)
"""χ of a contact force k δⁿ (1 + χ δ')."""
DECAY = _made("inverse length", "1/m", "200 1/m", 200)


@cache
def power_stiffness(exponent: float) -> Quantity:
    """Return the quantity of k in a force k uⁿ, in N/mⁿ. For n = 1 it is the stiffness."""
    if exponent == 1.0:
        return STIFFNESS
    symbol = f"N/m{_SUPERSCRIPTS.get(exponent, f'^{exponent:g}')}"
    powers = (1.0, 1.0 - exponent, -2.0)
    return _made(f"stiffness in {symbol}", symbol, f"510 k{symbol}", 510000, _OF_FORCE, powers)


@cache
def power_damping(exponent: float) -> Quantity:
    """Return the quantity of c in a force c |v|^α sgn v. For α = 1 it is the damping."""
    if exponent == 1.0:
        return DAMPING
    symbol = f"N (s/m)^{exponent:g}"
    powers = (1.0, 1.0 - exponent, exponent - 2.0)
    least = {"M": 1e7, "k": 1e2, "": 0.0}
    return _made(f"damping in {symbol}", symbol, f"1.1 k{symbol}", 1100, least, powers)


_OF_POWERS = (
    (re.compile(r"N/m\^(-?[\d.]+)|N m-(\d+)"), power_stiffness),
    (re.compile(r"N \(s/m\)\^([\d.]+)"), power_damping),
)
"""Units, as datasets state them, of families of quantities with an exponent."""


def of_power(units: str) -> Quantity | None:
    """Return the quantity with an exponent that has these units in a dataset, or None."""
    for pattern, family in _OF_POWERS:
        if match := pattern.fullmatch(units):
            return family(float(next(filter(None, match.groups()))))
    return None


@cache
def in_base_units(mass: float, length: float, time: float) -> Quantity:
    """Return the quantity with these powers of mass, length and time, written in kg, m and s."""
    powers = (mass, length, time)
    symbol = " ".join(
        f"{name}^{power:g}" if power != 1.0 else name
        for name, power in zip(("kg", "m", "s"), powers, strict=True)
        if power
    )
    return _made(f"number in {symbol}", symbol, f"2 {symbol}", 2.0, powers=powers)


@cache
def quantity(symbol: str) -> Quantity:
    """Return the quantity with a SI unit, such as ``quantity("N s/m^3")``, for a field of a law.

    Error messages have 2 of the unit as an example; `dataclasses.replace` sets another one.

    Raises
    ------
    ValueError
        If the symbol is not a product of powers of kg, m, s, N, J, W, Pa and Hz.
    """
    powers, first = _powers_of(symbol), (_factors(symbol) or [("", 1.0)])[0]
    symbol = re.sub(r"\^([23])(?![\d.])", lambda one: "²³"[int(one[1]) - 2], symbol)
    least = _OF_FORCE if first in (("N", 1.0), ("J", 1.0), ("W", 1.0), ("Pa", 1.0)) else _WHOLE
    return _made(f"number in {symbol}", symbol, f"2 {symbol}", 2.0, least, powers)


_SUPERSCRIPTS = {2.0: "²", 3.0: "³"}
"""Exponents that are written as superscripts."""
