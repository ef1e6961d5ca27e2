"""Where jumps begin: the border of the scenarios without them, exact.

On one side of it the branch of orbits turns back at two folds, on the other it does not turn:
the folds meet in a cusp. The sweeps of a map determine on which side a node lies; from one with
jumps the fold is followed in the frequency and one of the map's parameters until it turns.
"""

from __future__ import annotations

import functools
import json
from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.datasets.description import describe, excitation_from
from vibroimpact.errors import InputError
from vibroimpact.model import Oscillator
from vibroimpact.model.periodic_shaking import ANY_FREQUENCY
from vibroimpact.model.rig import Rig
from vibroimpact.response.sweep import sweep
from vibroimpact.scenarios.axes import one_sine, rig_at
from vibroimpact.scenarios.evidence import evidence
from vibroimpact.scenarios.map import map_workers
from vibroimpact.scenarios.map_store import CREATED_BY
from vibroimpact.scenarios.orbit_evidence import primary_branch
from vibroimpact.scenarios.resonance_curves import holds
from vibroimpact.scenarios.scenario import Scenario
from vibroimpact.scenarios.sweep_frequencies import frequencies
from vibroimpact.stability.bifurcation_curve import bifurcation_curve
from vibroimpact.stability.bifurcations import FOLD
from vibroimpact.tasks.threads import Progress, Tally, each

FOLLOWED = ("stiffness_ratio", "gap", "gap_ratio", "amplitude")
"""Parameters in which a fold can be followed, the first one of the map's is."""
_REACH = 4.0
"""How far beyond the node the fold is followed, as a factor."""


def jump_border(
    data: xr.Dataset,
    lines: int = 12,
    *,
    threads: int | None = None,
    where: Any = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Follow folds to the cusps in which they end: the exact border between S2 and S6.

    Parameters
    ----------
    lines
        At how many values of the other parameter, at most, the border is sought.
    threads
        Number of folds that are followed in parallel; None: one per processor. The result is the
        same for any number.
    where
        As for `scenario_map`; None for what that takes by itself for such a map.

    Returns
    -------
    xarray.Dataset
        Dim ``border_point``: the map's two parameters at each point, which is exact to the
        tolerance of the continuation. It has no points where the map shows no such border.
    """
    if data.attrs.get("created_by") != CREATED_BY:
        raise InputError("data: this is not a map; pass the result of scenario_map")
    settings = json.loads(data.attrs["parameters"])
    x, y = settings["x"]["name"], settings["y"]["name"]
    along = next((name for name in FOLLOWED if name in (x, y)), None)
    points: list[tuple[float, float]] = []
    if along is not None:
        other = y if along == x else x
        base = dict(settings["base"])
        oscillator = Oscillator.model_validate(base.pop("oscillator"))
        shaking = excitation_from(base, frequency=ANY_FREQUENCY)
        start = one_sine(Rig(oscillator, shaking), "data")
        candidates = _beside(data, along, other)
        chosen = np.unique(np.linspace(0, len(candidates) - 1, lines).round().astype(int))
        nodes = [candidates[i] for i in chosen] if candidates else []
        first_nodes = len(settings["x"]["values"]) * len(settings["y"]["values"])
        cusps = each(
            functools.partial(_cusp_beside, start, along, other),
            nodes,
            threads=map_workers(first_nodes, threads, where),
            progress=progress,
        )
        points = [
            (cusp, at) for cusp, (_, at) in zip(cusps, nodes, strict=True) if cusp is not None
        ]
    border = xr.Dataset(
        {
            name: ("border_point", [p[k] for p in points])
            for k, name in enumerate((along, y if along == x else x) if along else (x, y))
        }
    )
    return describe(border, "vibroimpact.scenarios.borders.jump_border", settings)


def _beside(data: xr.Dataset, along: str, other: str) -> list[tuple[float, float]]:
    """Nodes with jumps whose neighbours along an axis have none, one for each other value."""
    scenarios = data["scenario"].transpose(other, along).values
    jumping = np.isin(scenarios, [Scenario.S2, Scenario.S3])
    smooth = np.isin(scenarios, [Scenario.S6, Scenario.UNCLASSIFIED])
    nodes = []
    for row, at in enumerate(data[other].values):
        values = data[along].values
        for i in range(len(values)):
            neighbours = [k for k in (i - 1, i + 1) if 0 <= k < len(values)]
            if jumping[row, i] and any(smooth[row, k] for k in neighbours):
                nodes.append((float(values[i]), float(at)))
                break
    return nodes


def _cusp_beside(
    start: Rig, along: str, other: str, node: tuple[float, float], _: Tally
) -> float | None:
    """Value of one parameter at the cusp beside a node of the map."""
    value, at = node
    return _cusp(rig_at(start, {other: at, along: value}), along, value)


def _cusp(rig: Rig, along: str, value: float) -> float | None:
    """Value of a parameter at the cusp of the rig's folds that is nearest; None if not found."""
    held = frequencies(rig)
    data = sweep(rig, held)
    seen = evidence(rig, data, 0.02)
    try:
        orbits = primary_branch(seen, rig, holds(data))
        if orbits is None:
            return None
        kinds = orbits["bifurcation_kind"].values
        folds = np.flatnonzero((kinds == FOLD) & (orbits["bifurcation_value"].values > seen.top))
        if not len(folds):
            return None
        i = int(folds[np.argmax(orbits["bifurcation_value"].values[folds])])
        curve = bifurcation_curve(
            rig.at(float(orbits["bifurcation_value"][i])),
            orbits.isel(bifurcation=i),
            vary={
                "frequency": (float(held[0]), float(held[-1])),
                along: (value / _REACH, value * _REACH),
            },
        )
    except InputError:  # too near to the cusp for Newton's method
        return None
    cusps = curve["cusp_second"].values
    return float(cusps[np.argmin(np.abs(cusps - value))]) if len(cusps) else None
