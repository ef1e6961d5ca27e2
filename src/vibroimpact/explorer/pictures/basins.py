"""The basins of attraction at the selected frequency, first on a coarse grid."""

from __future__ import annotations

from typing import Any

from vibroimpact.attraction.basins import basins
from vibroimpact.explorer.pictures.numbers import axis, forcing, short
from vibroimpact.explorer.state import PageState
from vibroimpact.figures.finish import in_unit
from vibroimpact.model.units import plain
from vibroimpact.model.written_units import as_first_argument, unit
from vibroimpact.tasks.threads import Progress

AXES = {"x": "initial displacement (mm)", "y": "initial velocity (mm/s)"}
COARSE, FINE = 32, 128
"""Number of initial states along each axis."""
PATIENCE = 500
"""Number of forcing cycles after which an unsettled motion is treated as not periodic."""


@as_first_argument
def starts(state: PageState, fine: bool, progress: Progress) -> dict[str, Any]:
    """Return the motions, and for each initial state the number of the motion that it leads to.

    Raises
    ------
    InputError
        If the rig has no dissipation, because then every initial state has its own motion.
    """
    data = basins(state.rig, nodes=FINE if fine else COARSE, max_cycles=PATIENCE, progress=progress)
    return {
        "picture": "basins",
        "fine": fine,
        "frequency": forcing(state.shaking.frequency),
        "axes": {name: axis(label) for name, label in AXES.items()},
        "x": short(in_unit(1e3) * data["displacement"].values),
        "y": short(in_unit(1e3) * data["velocity"].values),
        "cells": [[int(cell) for cell in row] for row in data["basin"].values],
        "motions": [
            f"{kind}, period {period}" if period else str(kind)
            for kind, period in zip(
                data["motion"].values.tolist(), data["period"].values.tolist(), strict=True
            )
        ],
        "shares": short(data["share"].values, 3),
        "excursions": [
            f"{plain(in_unit(1e3) * size, 3)}{unit(' mm')}"
            for size in data["displacement_excursion"].values
        ],
    }
