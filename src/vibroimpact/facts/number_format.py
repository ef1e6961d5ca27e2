"""Numbers of a column or a row, in one unit that fits the largest of them."""

from __future__ import annotations

from collections.abc import Iterable

from vibroimpact.model.parameters import in_units
from vibroimpact.model.quantities import (
    ACCELERATION,
    ENERGY,
    FORCE,
    FREQUENCY,
    IMPULSE,
    LENGTH,
    VELOCITY,
    Scale,
    fitting,
)
from vibroimpact.model.units import plain
from vibroimpact.model.written_units import unit, unitless

ACCELERATIONS, LENGTHS, SPEEDS = ACCELERATION.scales, LENGTH.scales, VELOCITY.scales
FORCES, IMPULSES, ENERGIES = FORCE.scales, IMPULSE.scales, ENERGY.scales


def shown_in(units: str, values: Iterable[float]) -> Scale:
    """The unit in which values of a dataset's units are written."""
    try:
        return fitting(values, in_units(units).scales)
    except StopIteration:  # of a law with another exponent
        return Scale(0.0, 1.0, units)


def heading(words: str, units: str, values: Iterable[float]) -> tuple[Scale, str]:
    """The unit of a column, and its heading with this unit: ω if it is a frequency without one."""
    if words == "frequency" and unitless():
        return fitting(values, FREQUENCY.scales), "ω"
    scale = shown_in(units, values)
    return scale, with_unit(words, scale.symbol)


def with_unit(words: str, symbol: str) -> str:
    """A heading with its unit in parentheses, unless it has none."""
    return f"{words}{unit(f' ({symbol})')}" if symbol else words


__all__ = [
    "ACCELERATIONS",
    "ENERGIES",
    "FORCES",
    "IMPULSES",
    "LENGTHS",
    "SPEEDS",
    "Scale",
    "fitting",
    "heading",
    "plain",
    "shown_in",
    "with_unit",
]
