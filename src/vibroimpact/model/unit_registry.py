"""Units that pint reads. pint is imported on first use, because its registry takes 0.3 s."""

from __future__ import annotations

import re
from decimal import Decimal
from functools import cache
from typing import Any

from vibroimpact.model.unit_names import FRACTIONS, accepted_unit, two_meanings

# Only products of powers with small exponents: pint evaluates what it is given, and an exponent
# tower such as m^9^9^9 would never return. Laws of contact and damping have units such as N/m^1.5.
_NAME = r"[A-Za-zµμΩ°%]+(?:_[A-Za-z]+)*"
_BROKEN = r"\d?\.\d{1,6}"
_POWER = rf"(?:(?:\^|\*\*)-?{_BROKEN}(?![\d.])|(?:\^|\*\*)?-?[1-9](?![\d.])|⁻?[¹²³])"
_FACTOR = rf"{_NAME}{_POWER}?"
_TIMES = r"(?: ?[*/·⋅] ?| )"
_GROUP = rf"\({_FACTOR}(?:{_TIMES}{_FACTOR})*\){_POWER}?"
_UNITS = re.compile(
    rf"(?:1 ?/ ?)?(?:{_FACTOR}|{_GROUP})(?:{_TIMES}(?:{_FACTOR}|{_GROUP}))*", re.ASCII
)
_NAMES_IN = re.compile(_NAME, re.ASCII)
_BARE_POWER = re.compile(r"(?<=[A-Za-z)])(-?[1-9])")


class RefusalError(Exception):
    """Exception that states why a value is invalid. Its text follows the value in a sentence."""


def unit_text(rest: str) -> str:
    """Return a unit in the notation of pint.

    Raises
    ------
    RefusalError
        If the unit is not a product of powers of names.
    """
    if _UNITS.fullmatch(rest) is None:
        raise RefusalError(f"has a unit that cannot be read, '{rest}'")
    return _BARE_POWER.sub(r"**\1", rest.replace("·", "*").replace("⋅", "*"))


def with_unit(number: Decimal, rest: str) -> Any:
    """Return a number with a unit as a quantity of pint.

    Raises
    ------
    RefusalError
        If the unit is unknown or ambiguous, or if it contains a fraction such as %.
    """
    names = _NAMES_IN.findall(rest)
    if rest not in FRACTIONS:
        for fraction in FRACTIONS:
            if any(fraction in name for name in names):
                raise RefusalError(f"has {fraction} and a unit; write one of the two")
    for name in names:
        if meant := two_meanings(name):
            raise RefusalError(f"has the ambiguous unit '{name}'; write {meant}")
    registry = _registry()
    try:
        unit = registry.parse_units(rest)
        return registry.Quantity(number, unit)
    except AttributeError:  # pint.UndefinedUnitError, without importing pint by name
        raise RefusalError("has an unknown unit") from None
    except Exception:
        # pint raises whatever its tokenizer and arithmetic raise; for text from a user
        # every one of them means the same.
        raise RefusalError("has a unit that cannot be read") from None


def check_used(rest: str) -> None:
    """Raise an error if a text contains a unit that only pint accepts."""
    registry = _registry()
    for name in _NAMES_IN.findall(rest):
        # pint takes the first of several readings. It finds none for a sign such as °.
        readings = registry.parse_unit_name(name)
        if readings and not accepted_unit(readings[0][1]):
            raise RefusalError(f"has a unit that is not accepted, '{name}'")


@cache
def _registry() -> Any:
    """Return pint's registry, made on first use.

    With decimal arithmetic a prefix is exact: 26.8 kN/m is 26800 N/m, not 26800.000000000004.
    """
    import pint

    return pint.UnitRegistry(non_int_type=Decimal)
