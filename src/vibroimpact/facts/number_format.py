"""Numbers of a column or a row, in one unit that fits the largest of them."""

from __future__ import annotations

from collections.abc import Iterable

from vibroimpact.model.parameters import in_units
from vibroimpact.model.quantities import (
    ACCELERATION,
    ENERGY,
    FORCE,
    IMPULSE,
    LENGTH,
    VELOCITY,
    Scale,
    fitting,
)
from vibroimpact.model.units import plain

ACCELERATIONS, LENGTHS, SPEEDS = ACCELERATION.scales, LENGTH.scales, VELOCITY.scales
FORCES, IMPULSES, ENERGIES = FORCE.scales, IMPULSE.scales, ENERGY.scales


def shown_in(units: str, values: Iterable[float]) -> Scale:
    """The unit in which values of a dataset's units are written."""
    try:
        return fitting(values, in_units(units).scales)
    except StopIteration:  # of a law with another exponent
        return Scale(0.0, 1.0, units)


__all__ = [
    "ACCELERATIONS",
    "ENERGIES",
    "FORCES",
    "IMPULSES",
    "LENGTHS",
    "SPEEDS",
    "Scale",
    "fitting",
    "plain",
    "shown_in",
]
