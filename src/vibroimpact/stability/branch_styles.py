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
    "peak_force_right",
    "peak_force_left",
]
"""A variable of each orbit that each bifurcation has as well, as ``bifurcation_`` and its name."""

QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)
