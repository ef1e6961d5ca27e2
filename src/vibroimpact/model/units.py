"""Conversion of strings with units to numbers in SI units, and of such numbers to texts.

All numbers inside the package are in SI units. This module converts the texts of a user, such as
``"15 mm"``, ``"510 kN/m"`` or ``"0.05 g"``, to such numbers. It also writes numbers as readable
texts.

The units are read by pint. Its import takes about 0.3 s. Therefore it is imported only when a text
has a unit that this module cannot read itself.
"""

from __future__ import annotations

import math
import numbers
import re
from collections.abc import Sequence
from decimal import Decimal
from functools import lru_cache
from typing import Any

from vibroimpact.errors import InputError, shown
from vibroimpact.model import quantities
from vibroimpact.model.quantities import (
    ACCELERATION,
    FORCE,
    FREQUENCY,
    GRAVITY,
    MASS,
    Quantity,
)
from vibroimpact.model.unit_registry import RefusalError, check_used, unit_text, with_unit
from vibroimpact.model.written_units import unitless

_TWO_PI = Decimal("6.283185307179586476925286766559")


# Named only so that a message can say what a text of the wrong dimension is.
_ALSO_NAMED: dict[tuple[tuple[str, float], ...], str] = {
    (("radian", 1), ("second", -1)): "an angular frequency",
    (("kilogram", 1), ("meter", -1), ("second", -2)): "a pressure",
    (("meter", 2),): "an area",
    (("kelvin", 1),): "a temperature",
}
_NAMES: dict[tuple[tuple[str, float], ...], str] = _ALSO_NAMED | {
    q.base: q.phrase for q in vars(quantities).values() if isinstance(q, Quantity)
}

_LEAST, _MOST = 1e-5, 1e9
"""Sizes between which a number is written without a power of ten."""

_OF_ANY_RIG = ("frequency", "angle", "dimensionless number")
"""Names of quantities whose values may have a unit even if the rig has none."""
_LONGEST = 200
"""Letters of a number with its unit; patterns of longer texts take long to search."""
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_SLOWEST, _FASTEST = 1e-100, 1e100
"""Frequencies (Hz) of a motion beyond have no period, or accelerations, in the range of numbers."""
_NOT_FINITE = re.compile(r"[+-]?(?:inf|infinity|∞|nan)\b|[+-]?∞", re.IGNORECASE)

_GAL = re.compile(r"(?<![A-Za-z_])(m?)gal(?![A-Za-z_])", re.IGNORECASE)
"""To pint ``gal`` is a gallon, and its ``Gal`` has capitals."""
_GRAVITY_SYMBOL = re.compile(r"(?<![A-Za-z_])(m?)[gG](?![A-Za-z_])")


def to_si(
    value: object,
    quantity: Quantity,
    field: str,
    *,
    above: float | None = None,
    minimum: float | None = None,
    maximum: float | None = None,
) -> float:
    """Convert a number or a string with a unit to a number in SI units.

    A number, or a string without a unit, is already in SI units (Hz for a frequency, rad for an
    angle). A text with a unit is converted exactly and rounded once, so that ``"26.8 kN/m"`` equals
    ``26800.0``. In a product of units, write ``*``, ``·`` or a space between them. Powers are
    written as in ``m/s^2``, ``m/s**2``, ``m/s²``, ``m/s2`` or ``m s-2``.

    Two units are read in a special way:

    - For an acceleration, ``g`` is gravity (9.80665 m/s²), and ``mg`` is a thousandth of it. For a
      mass, neither of them is accepted; write ``gram``.
    - For a frequency, an angle divided by a time is converted to turns per second:
      ``"6.2832 rad/s"``, ``"60 rpm"`` and ``"360 deg/s"`` are 1 Hz. ``"1/s"`` is 1 Hz, too.

    Parameters
    ----------
    value
        A real number, a text, or a pint quantity.
    quantity
        The expected quantity, such as `LENGTH`.
    field
        Name of the value in error messages.
    above, minimum, maximum
        Bounds in SI units. The value must be greater than `above`, at least `minimum` and at most
        `maximum`. Default: no bound.

    Returns
    -------
    float
        The value in SI units. It is finite, and never a negative zero.

    Raises
    ------
    InputError
        If the value is a bool, is not a number, is not finite, is empty, has an unknown unit
        or a unit of another dimension, or lies outside the bounds.
    """
    try:
        return read(value, quantity, above=above, minimum=minimum, maximum=maximum)
    except InputError as error:
        raise InputError(f"{field}: {error}") from None


def one_of(
    value: object,
    quantities: Sequence[Quantity],
    field: str,
    *,
    above: float | None = None,
    minimum: float | None = None,
) -> tuple[float, Quantity]:
    """Convert a value that may be one of several quantities, and return it with its quantity.

    A plain number is the first of them.

    Raises
    ------
    InputError
        As in `to_si`. If the unit is wrong, the message lists all accepted quantities.
    """
    for quantity in quantities:
        try:
            read(value, quantity)
        except InputError:
            continue  # of another dimension, or no number at all
        return to_si(value, quantity, field, above=above, minimum=minimum), quantity
    first, *others = quantities
    if unitless():  # only a unit states which of them
        others = []
    try:
        return to_si(value, first, field, above=above, minimum=minimum), first
    except InputError as error:
        also = "".join(
            f', or {quantity.phrase} such as "{quantity.example}"' for quantity in others
        )
        raise InputError(f"{error}{also}") from None


def read(
    value: object,
    quantity: Quantity,
    *,
    above: float | None = None,
    minimum: float | None = None,
    maximum: float | None = None,
) -> float:
    """Convert a value as `to_si` does, but raise errors that do not contain the name of a field."""
    if unitless() and _names_unit(value, quantity):
        raise InputError(
            f"{shown(value)} has a unit, but the rig has none; pass a number without a unit"
        )
    try:
        number = _number(value, quantity)
        if not math.isfinite(number):
            raise RefusalError("is not finite")
        if above is not None and not number > above:
            raise RefusalError(f"is not greater than {_bound(above, quantity)}")
        if above == 0.0 and quantity is FREQUENCY and not _SLOWEST <= number <= _FASTEST:
            raise RefusalError(f"is not between {_SLOWEST:g} and {_FASTEST:g} Hz")
        if minimum is not None and not number >= minimum:
            raise RefusalError(f"is less than {_bound(minimum, quantity)}")
        if maximum is not None and not number <= maximum:
            raise RefusalError(f"is greater than {_bound(maximum, quantity)}")
    except RefusalError as refusal:
        wanted = accepted(quantity, above=above, minimum=minimum, maximum=maximum)
        raise InputError(f"{shown(value)} {refusal}; use {wanted}") from None
    # A negative zero equals zero but prints differently; adding 0.0 removes its sign.
    return number + 0.0


def accepted(
    quantity: Quantity,
    *,
    above: float | None = None,
    minimum: float | None = None,
    maximum: float | None = None,
) -> str:
    """Describe the accepted values of a quantity, with an example."""
    limits = (("greater than", above), ("of at least", minimum), ("of at most", maximum))
    bounds = [f"{words} {_bound(end, quantity)}" for words, end in limits if end is not None]
    if minimum is not None and maximum is not None:
        bounds = [f"from {minimum:g} to {_bound(maximum, quantity)}"]
    sign = "-" if maximum is not None and maximum <= 0 else ""
    has_unit = quantity.symbol and (not unitless() or quantity.name in _OF_ANY_RIG)
    number = f"{sign}{quantity.number}"
    example = f'"{sign}{quantity.example}" or {number} ({quantity.symbol})' if has_unit else number
    return f"{' '.join((quantity.phrase, *bounds))}, such as {example}"


def with_si_unit(value: float, quantity: Quantity) -> str:
    """Write a value with its SI unit, unless the rig has no units."""
    if unitless():
        return pretty(value, quantity)
    return f"{value:g} {quantity.symbol}".rstrip()


def _bound(value: float, quantity: Quantity) -> str:
    return with_si_unit(value, quantity) if value else "0"


def to_si_of_any(value: object, field: str) -> tuple[float, tuple[float, float, float] | None]:
    """Convert a number of any mechanical quantity, such as a number in a formula.

    Returns
    -------
    value, dimension
        The value in SI units, and the powers of mass, length and time in its unit. The dimension
        is None for a plain number, whose unit is not stated. An angle counts as a plain number.

    Raises
    ------
    InputError
        If the value is not a finite number, or if its unit cannot be read or is not mechanical.
    """
    if not isinstance(value, str) or _NUMBER.fullmatch(value.strip()):
        return to_si(value, quantities.DIMENSIONLESS, field), None
    clean = " ".join(value.replace("−", "-").split())
    match = _NUMBER.match(clean)
    try:
        if match is None or len(clean) > _LONGEST:
            raise RefusalError("does not start with a number")
        rest = unit_text(clean[match.end() :].strip())
        base = with_unit(Decimal(match[0]), rest).to_base_units()
        check_used(rest)
        powers = {str(name): float(power) for name, power in base.unit_items()}
        powers.pop("radian", None)
        mass, length, time = (powers.pop(name, 0.0) for name in ("kilogram", "meter", "second"))
        if powers:
            raise RefusalError("is not a mechanical quantity")
        number = float(base.magnitude)
        if not math.isfinite(number):
            raise RefusalError("is not finite")
    except ArithmeticError:
        raise InputError(
            f'{field}: {shown(value)} is not finite; pass a finite number, such as "26 kN/m"'
        ) from None
    except RefusalError as refusal:
        raise InputError(
            f'{field}: {shown(value)} {refusal}; pass a number with its unit, such as "26 kN/m"'
        ) from None
    return number + 0.0, (mass, length, time)


def plain(value: float, digits: int = 6) -> str:
    """Write a number with `digits` significant digits, without a power of ten if possible."""
    text = f"{value:.{digits}g}"
    if "e" not in text or not _LEAST <= abs(value) < _MOST:
        return text
    return f"{Decimal(text):f}"


def pretty(value: float, quantity: Quantity, digits: int = 6) -> str:
    """Write a value in SI units with a unit of fitting size, such as mm or kN/m.

    `to_si` can read this text, with the precision of its significant digits.

    Returns
    -------
    str
        Text such as ``"510 kN/m"``, ``"7.5 mm"`` or ``"0.15"``. Values of a rig without units are
        numbers, and a frequency is ``"ω = 2"``.
    """
    if not math.isfinite(value):
        return with_si_unit(value, quantity)
    if unitless() and quantity is FREQUENCY:
        return f"ω = {plain(math.tau * value, digits)}"
    # What rounds up to the next unit is written in that: 1 MN, not 1000 kN.
    unit = quantity.unit(float(f"{value:.{digits}g}"))
    return f"{plain(value / unit.size, digits)} {unit.symbol}".rstrip()


def _names_unit(value: object, quantity: Quantity) -> bool:
    """Return whether a text has a unit that a rig without units cannot have.

    A frequency is entered as of any rig, and a ratio and an angle do not depend on the units.
    """
    if not isinstance(value, str) or quantity.name in _OF_ANY_RIG:
        return False
    match = _NUMBER.match(value.strip())
    return match is not None and value.strip()[match.end() :].strip()[:1].isalpha()


def _number(value: Any, quantity: Quantity) -> float:
    """Return the SI value of anything that can be read as one; it may be infinite or NaN."""
    if type(value) is float:  # as nearly always
        return value
    if getattr(value, "ndim", None) == 0 and hasattr(value, "item"):
        value = value.item()  # a numpy scalar or an array of no dimension
    if isinstance(value, str):
        return _from_text(value, quantity)
    # A bool is an int to Python, but True is no length.
    if isinstance(value, numbers.Real | Decimal) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            return math.inf
        except ValueError:  # Decimal("sNaN")
            return math.nan
    if hasattr(value, "to_base_units") and isinstance(
        getattr(value, "magnitude", None), numbers.Real | Decimal
    ):
        if quantity is ACCELERATION and value.dimensionality == {"[mass]": 1}:
            # Of a text the g is read as gravity; pint itself has made a gram of it.
            raise RefusalError(
                "is a mass, because g is the gram in pint; for gravity, use pint's "
                'standard_gravity or a string such as "0.05 g"'
            )
        return float(_from_pint(value, quantity))
    raise RefusalError("is not a number")


def _from_text(text: str, quantity: Quantity) -> float:
    # str.split also takes the no-break spaces that typeset tables hold.
    clean = " ".join(text.replace("−", "-").split())
    if not clean:
        raise RefusalError("is empty")
    if len(clean) > _LONGEST:
        raise RefusalError(f"has {len(clean)} characters, more than the accepted {_LONGEST}")
    match = _NUMBER.match(clean)
    if match is None:
        finite = _NOT_FINITE.match(clean) is None
        raise RefusalError("does not start with a number" if finite else "is not finite")
    rest = clean[match.end() :].strip()
    digits = re.split("[eE]", match[0])[0]
    if not float(match[0]) and digits.strip("+-.0"):
        raise RefusalError("is smaller than the smallest floating-point number")
    if not rest:
        return float(clean)
    if rest.startswith(","):
        raise RefusalError("has a comma; write a decimal point")
    try:
        # Decimal raises an error for exponents beyond its range, also for that of a zero.
        number = Decimal(match[0] if float(match[0]) else 0)
        return float(number * _size(rest, quantity))
    except ArithmeticError:
        raise RefusalError("is not finite") from None
    except RefusalError:
        return float(_measured(number, rest, quantity))  # whose words may name the number


@lru_cache(maxsize=4096)
def _size(unit: str, quantity: Quantity) -> Decimal:
    """How large a unit is in SI units; a unit in which the quantity is written needs no pint."""
    for scale in quantity.scales:
        if unit == scale.symbol:
            return Decimal(f"{scale.size:.12g}")
    return Decimal(_measured(Decimal(1), unit, quantity))


def _measured(number: Decimal, rest: str, quantity: Quantity) -> Decimal | float:
    """A number with a unit in SI units."""
    rest = unit_text(rest)
    if quantity is ACCELERATION:
        rest = _GRAVITY_SYMBOL.sub(
            lambda m: ("milli" if m[1] else "") + "standard_gravity",
            rest,
        )
        rest = _GAL.sub(lambda m: ("milli" if m[1] else "") + "galileo", rest)
    if quantity is MASS and _GRAVITY_SYMBOL.search(rest):
        raise RefusalError("has a g, which is gravity here; write gram, kg or t")
    magnitude = _from_pint(with_unit(number, rest), quantity)
    check_used(rest)
    return magnitude


def _from_pint(measured: Any, quantity: Quantity) -> Decimal | float:
    try:
        base = measured.to_base_units()
    except ArithmeticError:
        raise RefusalError("is not finite") from None
    except Exception:  # logarithmic and offset units, which no quantity here takes
        raise RefusalError(f"is not {quantity.phrase}") from None
    # An exponent that is no decimal fraction, such as 1/3, is written with six digits.
    powers = ((str(name), round(float(power), 5)) for name, power in base.unit_items())
    dimension = tuple(sorted((name, power) for name, power in powers if power))
    magnitude = base.magnitude
    if quantity is FREQUENCY and dimension == (("radian", 1), ("second", -1)):
        # pint converts rad/s to Hz by a factor of 1, since it holds the radian for a
        # number. A frequency counts cycles, and a cycle is 2π radians.
        turn = _TWO_PI if isinstance(magnitude, Decimal) else math.tau
        frequency: Decimal | float = magnitude / turn
        return frequency
    if dimension != tuple((name, round(power, 5)) for name, power in quantity.base):
        if quantity is MASS and dimension == FORCE.base and magnitude > 0:
            weighing = pretty(float(magnitude) / GRAVITY, MASS)
            raise RefusalError(f"is a force, the weight of {weighing}")
        raise RefusalError(f"is {_NAMES.get(dimension, 'not ' + quantity.phrase)}")
    within: Decimal | float = magnitude
    return within
