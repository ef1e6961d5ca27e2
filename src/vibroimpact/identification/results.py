"""A fit as a labelled dataset."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import numpy as np
import scipy
import xarray as xr

from vibroimpact.datasets.description import (
    describe,
    excitation_from,
    excitation_parameters,
    system_parameters,
)
from vibroimpact.identification import finding_texts
from vibroimpact.identification.equivalent_rigs import Rival, came_to, outside
from vibroimpact.identification.global_search import SearchResult
from vibroimpact.identification.least_squares import Array, Problem
from vibroimpact.identification.overlay import TestPoints
from vibroimpact.identification.profile_likelihood import Profile
from vibroimpact.identification.residual_structure import TOLD, ResidualSeries, Structure, structure
from vibroimpact.identification.uncertainty import Spread
from vibroimpact.identification.untouched_stops import Untouched
from vibroimpact.model import Oscillator
from vibroimpact.model.rig import Rig

_SILENT = 1e-6
"""Residuals that are smaller are those of made-up data without noise."""


class Fit(NamedTuple):
    """All that was found."""

    problem: Problem
    x: Array
    outcome: SearchResult
    around: Spread
    curves: list[Profile]
    rivals: list[Rival]
    """Other places that fit as well."""
    untouched: Untouched


def labelled(fit: Fit, samples: dict[str, Array | None], confidence: float) -> xr.Dataset:
    """Put a fit into a dataset."""
    problem, x, outcome, around, curves, rivals, idle = fit
    count = len(problem.free)
    values = x[:count] * problem.scale[:count]
    keys = [one.key for one in problem.free]
    data = xr.Dataset(coords={"parameter": keys, "test": [t.name for t in problem.tests]})
    data["fitted_value"] = ("parameter", values)
    data["standard_error"] = ("parameter", around.error)
    data["start_value"] = ("parameter", [one.start for one in problem.free])
    data["parameter_units"] = ("parameter", [one.quantity.symbol for one in problem.free])
    twice = ("parameter", "other_parameter")
    data = data.assign_coords(other_parameter=keys)
    data["covariance"] = (twice, around.covariance)
    data["correlation"] = (twice, around.correlation)
    interval, is_open = _intervals(problem, values, around, curves, confidence, idle)
    data = data.assign_coords(bound=["low", "high"])
    data["interval"] = (("parameter", "bound"), interval)
    data["interval_open"] = (("parameter", "bound"), is_open)
    if curves:
        longest = max(len(c.value) for c in curves)
        for name, of in (("profile_value", "value"), ("profile_rise", "rise")):
            table = np.full((count, longest), np.nan)
            for row, curve in zip(table, curves, strict=True):
                row[: len(curve.value)] = getattr(curve, of)
            data[name] = (("parameter", "profile_point"), table)
    for name, drawn in samples.items():
        if drawn is not None:
            data[name] = ((name.replace("_value", "_draw"), "parameter"), drawn)
    others = [(one, one.x[:count] * problem.scale[:count]) for one in rivals]
    others = [(one, values) for one, values in others if outside(values, interval)]
    outcome = outcome._replace(alike=came_to(outcome.near, x, [one.x for one, _ in others], count))
    if others:
        table = np.array([values for _, values in others])
        data["alternative_value"] = (("alternative", "parameter"), table)
        data["alternative_rise"] = ("alternative", [one.rise for one, _ in others])
        data["alternative_mirrored"] = ("alternative", [int(one.mirrored) for one, _ in others])
    judged = _points(data, problem, x)
    # Of normal residuals whose deviation was found, too, up to what all models have in common.
    number = int(problem.measured.sum())
    groups = list(zip(data["point_test"].values, data["point_variable"].values, strict=True))
    likelihood, distinct = 0.0, list(dict.fromkeys(groups))
    for group in distinct:
        part = data["fit_residual"].values[[one == group for one in groups]]
        size = max(float(np.nanmean(part**2)), _SILENT**2 * 1e-6)
        likelihood -= 0.5 * len(part) * (np.log(2.0 * np.pi * size) + 1.0)
    known = len(x) + len(distinct)
    data["log_likelihood"] = likelihood
    data["akaike"] = (
        2.0 * known - 2.0 * likelihood + 2.0 * known * (known + 1) / max(number - known - 1, 1)
    )
    data["bayes"] = known * np.log(number) - 2.0 * likelihood
    rigs = {}
    for test in problem.tests:
        rig, sensors = problem.rig_of(x, test)
        rigs[test.name] = {
            **system_parameters(rig.oscillator),
            "excitation": excitation_parameters(rig.periodic),
            "sensors": sensors,
        }
    data.attrs = {
        "rigs": json.dumps(rigs),
        "names": json.dumps([one.name for one in problem.free]),
        "confidence": confidence,
        "cost": 0.5 * float(np.sum(data["fit_residual"].values ** 2)),
        "starts": outcome.starts,
        "starts_alike": outcome.alike,
        "evaluations": outcome.evaluations,
        "robust": int(np.isfinite(problem.tail)),
    }
    data.attrs["findings"] = "\n".join(
        finding_texts.findings(data, problem, x, outcome, judged, idle)
    )
    return describe(
        data,
        "vibroimpact.identify",
        {"free": keys, "ties": dict(problem.ties), "tests": [t.name for t in problem.tests]},
    )


def rig_of(numbers: dict[str, Any]) -> Rig:
    """Read a rig from the attributes of a fit."""
    oscillator = Oscillator.model_validate(numbers["oscillator"])
    return Rig(oscillator, excitation_from(numbers["excitation"]))


def _intervals(
    problem: Problem,
    values: Array,
    around: Spread,
    curves: list[Profile],
    confidence: float,
    idle: Untouched,
) -> tuple[Array, Array]:
    if curves:
        ends = np.array([(c.low, c.high) for c in curves])
        return ends, np.array([(c.open_low, c.open_high) for c in curves], dtype=np.int64)
    wide = float(scipy.stats.t.ppf(0.5 + 0.5 * confidence, around.freedom)) * around.error
    low = np.array([one.low for one in problem.free])
    high = np.array([one.high for one in problem.free])
    ends = np.stack([np.maximum(values - wide, low), np.minimum(values + wide, high)], axis=1)
    for number in idle.all:
        ends[number] = idle.gaps.get(number, low[number]), high[number]
    return ends, np.stack([ends[:, 0] == low, ends[:, 1] == high], axis=1).astype(np.int64)


def _points(data: xr.Dataset, problem: Problem, x: Array) -> list[Structure]:
    """Enter all points, and judge each test's residuals."""
    rows: dict[str, list[Any]] = {
        name: []
        for name in (
            "point_test", "point_direction", "point_variable", "point_place", "measured_value",
            "modelled_value", "fit_residual",
        )
    }  # fmt: skip
    judged = []
    used = sum(t.points_count for t in problem.tests)
    for number, test in enumerate(problem.tests):
        rig, sensors = problem.rig_of(x, test)
        points = test.test_points(rig, sensors, problem.of_test(x, number))
        rows["point_test"] += [test.name] * len(points.place)
        rows["point_direction"] += points.direction
        rows["point_variable"] += points.variable
        rows["point_place"] += points.place.tolist()
        rows["measured_value"] += points.measured.tolist()
        rows["modelled_value"] += points.modelled.tolist()
        rows["fit_residual"] += points.residual.tolist()
        known = test.noise if test.noise > 0.0 else None
        share = max(1.0 - len(x) / used, 0.1)
        size = float(np.sqrt(np.mean(points.residual**2)))
        size = size if size > _SILENT else 0.0
        count = len(points.place)
        noise_freedom = max(TOLD[test.kind] * count, 1.0)
        judged.append(
            structure(_rows(points, test.weights), size, known, share * count, noise_freedom)
        )
    for name, values in rows.items():
        data[name] = ("point", np.array(values))
    data["noise"] = ("test", np.array(problem.sigma))
    data["data_noise"] = ("test", np.array([t.noise for t in problem.tests]))
    for name in ("correlation", "chance", "excess", "excess_chance"):
        data[f"residual_{name}"] = ("test", np.array([getattr(j, name) for j in judged]))
    data["amplitude_source"] = ("test", [t.data.attrs["amplitude_source"] for t in problem.tests])
    data["test_kind"] = ("test", [t.kind for t in problem.tests])
    return judged


def _rows(points: TestPoints, weights: dict[str, float]) -> list[ResidualSeries]:
    """Residuals of each direction and quantity in the order of their places."""
    rows = []
    keys = list(zip(points.direction, points.variable, strict=True))
    for key in dict.fromkeys(keys):
        here = np.flatnonzero([k == key for k in keys])
        here = here[np.argsort(points.place[here], kind="stable")]
        residual = points.residual[here] / weights[key[1]]
        rows.append(ResidualSeries(key[1], points.place[here], residual, points.modelled[here]))
    return rows
