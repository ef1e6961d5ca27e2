"""The (λ, δ0) plane with its scenarios, at the ξ and τ of the rig."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.explorer.pictures.numbers import short
from vibroimpact.explorer.state import State
from vibroimpact.model import from_dimensionless, to_dimensionless
from vibroimpact.model.dimensionless import DimensionlessBumper
from vibroimpact.scenarios.map import scenario_map
from vibroimpact.scenarios.scenario import Scenario
from vibroimpact.tasks.threads import Progress

_NODES, _STEP = 9, 0.03
"""Along each axis, and step of the sweeps over the natural frequency: some seconds."""
STIFFNESS, GAP = (0.25, 250.0), (0.0, 1.2)
"""Ranges of λ and δ0."""


class Plane(NamedTuple):
    """What the map depends on: λ and δ0 are its axes."""

    damping_ratio: float
    relaxation_time: float
    sides: tuple[bool, bool]


def plane(state: State) -> Plane:
    """Return what the map of a rig depends on.

    Raises
    ------
    InputError
        If the rig has no λ, δ0, τ and ξ that are those of both sides.
    """
    rig = state.oscillator
    scaled = to_dimensionless(state.rig)
    stops = [stop for stop in (scaled.right, scaled.left) if stop is not None]
    if not stops or not all(isinstance(stop, DimensionlessBumper) for stop in stops):
        raise InputError("map: the rig has no Kelvin-Voigt bumper; at least one is required")
    times = {float(f"{stop.relaxation_time:.6g}") for stop in stops}  # type: ignore[union-attr]
    if len(times) > 1 or rig.force:
        raise InputError(
            "map: the relaxation times τ of the two sides differ, or a constant force acts on the "
            "mass; rigs with one τ and without constant force are accepted"
        )
    return Plane(
        float(f"{scaled.damping_ratio:.6g}"),
        times.pop(),
        (scaled.right is not None, scaled.left is not None),
    )


def scenarios(where: Plane, fine: bool, progress: Progress) -> dict[str, Any]:
    """Return the scenario at each node, denser at borders where it is `fine`."""
    right, left = where.sides

    def each(value: float) -> tuple[float | None, float | None]:
        return value if right else None, value if left else None

    base = from_dimensionless(
        each(10.0), each(0.5), each(where.relaxation_time), where.damping_ratio
    )
    data = scenario_map(
        base,
        ("stiffness_ratio", np.geomspace(*STIFFNESS, _NODES), "log"),
        ("gap_ratio", np.linspace(*GAP, _NODES)),
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
