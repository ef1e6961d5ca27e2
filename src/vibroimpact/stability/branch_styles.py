"""What branches are drawn by, for figures and the command line."""

from __future__ import annotations

from typing import Literal, get_args

Quantity = Literal[
    "eta_d",
    "eta_a",
    "displacement_excursion",
    "eccentricity",
    "peak_displacement",
    "peak_acceleration",
    "peak_transmitted_force",
    "transmissibility",
    "peak_force",
    "peak_force.right",
    "peak_force.left",
]
"""A variable of each orbit that each bifurcation has as well, as ``bifurcation_`` and its name.

Of one stop, or of all (`datasets.stops.quantity`)."""

QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)
VARIABLES = tuple(one for one in QUANTITIES if "." not in one)


def contact_counts(right: int, left: int, stops: tuple[object, object]) -> str:
    """Write contacts per period, such as ``"2R 1L"``. A side without a stop is left out."""
    counts = ((right, "R", stops[0]), (left, "L", stops[1]))
    return " ".join(f"{count}{side}" for count, side, stop in counts if stop is not None)
