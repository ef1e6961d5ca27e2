"""Accepted units: units of engineering whose name has only one meaning."""

from __future__ import annotations

import re

_PREFIX = r"(?:k|kilo|M|mega)?"
_TWO_MEANINGS: tuple[tuple[re.Pattern[str], str], ...] = tuple(
    (re.compile(rf"{_PREFIX}(?:{word})s?"), meant)
    for word, meant in (
        ("ton", "t (1000 kg), short_ton (907.2 kg) or long_ton (1016 kg)"),
        (
            "tonf|ton_force|force_ton",
            "tf (9.807 kN), short_ton_force (8.896 kN) or long_ton_force (9.964 kN)",
        ),
        ("cwt|hundredweight", "short_hundredweight (45.36 kg) or long_hundredweight (50.8 kg)"),
        ("gr", "gram, or grain (64.8 mg)"),
        ("mt", "t (1000 kg)"),
        ("Mm", "mm, or km for a thousand metres"),
        ("mil", "thou (0.0254 mm), mm, or rad of an angle"),
    )
)
"""Unit names with two meanings, and the names to write instead."""

_ACCEPTED = frozenset(
    """
    meter inch foot survey_foot yard mile nautical_mile thou micron angstrom
    gram metric_ton pound ounce slug slinch stone grain
    ton long_ton US_ton UK_ton hundredweight long_hundredweight
    second minute hour day week
    newton dyne force_gram force_kilogram force_metric_ton force_pound force_ounce kip poundal
    force_ton force_long_ton US_force_ton UK_force_ton
    mile_per_hour kilometer_per_hour knot foot_per_second meter_per_second
    galileo standard_gravity
    pascal bar standard_atmosphere pound_force_per_square_inch kip_per_square_inch
    joule erg watt watt_hour foot_pound
    radian degree arcminute arcsecond turn grade
    hertz revolutions_per_minute revolutions_per_second
    percent permille ppm
    """.split()  # noqa: SIM905
)
"""Accepted units by their names in pint. Each may have a prefix.

pint has a thousand more units, including constants and typographic units. In pint, ``zeta`` is
3e10, ``c`` is the speed of light, and ``a`` is a year.
"""

FRACTIONS = ("%", "percent", "permille", "ppm")
"""Fractions of 1, which are not accepted together with another unit."""


def two_meanings(name: str) -> str:
    """Return the names to write instead of a name with two meanings; empty for other names."""
    return next((meant for word, meant in _TWO_MEANINGS if word.fullmatch(name)), "")


def accepted_unit(canonical: str) -> bool:
    """Return whether a unit is accepted. `canonical` is its name in pint without a prefix."""
    return canonical in _ACCEPTED
