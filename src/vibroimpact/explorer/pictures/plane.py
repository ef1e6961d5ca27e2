"""The map of scenarios over λ and δ0, at the ξ and the τ of the rig."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.explorer.pictures.numbers import short
from vibroimpact.explorer.state import PageState
from vibroimpact.model import from_dimensionless, to_dimensionless
from vibroimpact.model.written_units import as_first_argument
from vibroimpact.scenarios.map import scenario_map
from vibroimpact.scenarios.scenario import Scenario
from vibroimpact.tasks.threads import Progress

_NODES, _STEP = 9, 0.03
"""Along each axis, and step of the sweeps over the natural frequency: some seconds."""
STIFFNESS, GAP = (0.25, 250.0), (0.0, 1.2)
"""Ranges of λ and δ0."""


class Plane(NamedTuple):
    """The values on which the map depends, in addition to λ and δ0 on its axes."""

    damping_ratio: float
    relaxation_time: float
    sides: tuple[bool, bool]


@as_first_argument
def plane(state: PageState) -> Plane:
    """Return the values on which the map of a rig depends.

    Raises
    ------
    InputError
        If a stop of the rig is not a Kelvin-Voigt bumper, if both sides have different τ, or if a
        constant force acts on the mass.
    """
    rig = state.oscillator
    scaled = to_dimensionless(state.rig)
    stops = [stop for stop in (scaled.right, scaled.left) if stop is not None]
    if not stops or not all(stop.spring_and_dashpot for stop in rig.stops.values()):
        raise InputError(
            "map: the map requires at least one stop, and all stops must be Kelvin-Voigt bumpers; "
            "change the law of the stops to kelvin-voigt"
        )
    times = {float(f"{stop.relaxation_time:.6g}") for stop in stops}  # type: ignore[union-attr]
    if len(times) > 1:
        raise InputError(
            "map: the two bumpers have different relaxation times τ; give both the same τ"
        )
    if rig.force:
        raise InputError("map: a constant force acts on the mass; set this force to 0")
    return Plane(
        float(f"{scaled.damping_ratio:.6g}"),
        times.pop(),
        (scaled.right is not None, scaled.left is not None),
    )


def scenarios(where: Plane, fine: bool, progress: Progress) -> dict[str, Any]:
    """Return the scenario at each node. If `fine`, the map is refined at the borders."""
    right, left = where.sides

    def each(value: float) -> tuple[float | None, float | None]:
        return value if right else None, value if left else None

    base = from_dimensionless(
        each(10.0), each(0.5), each(where.relaxation_time), where.damping_ratio
    )
    data = scenario_map(
        base,
        {
            "stiffness_ratio": np.geomspace(*STIFFNESS, _NODES),
            "gap_ratio": np.linspace(*GAP, _NODES),
        },
        step=_STEP,
        refine=1 if fine else 0,
        progress=progress,
    )
    return {
        "picture": "map",
        "fine": fine,
        "x": short(data["stiffness_ratio"].values),
        "y": short(data["gap_ratio"].values),
        "names": [one.label for one in Scenario],
        "cells": [[int(one) for one in row] for row in data["scenario"].values],
    }
