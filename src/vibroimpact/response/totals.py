"""Exact extremes and energies of a whole motion."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.engine import measure
from vibroimpact.response.motion_phases import (
    Phases,
    Recorded,
    any_recorded,
    chattered,
    cut,
    impact_loss,
    relaxation_loss,
)
from vibroimpact.response.phase_measures import measured, transmitted_extremes, view


def totals(motion: xr.Dataset) -> xr.Dataset:
    """Compute the exact extremes of a motion, even between its samples, and its energies.

    Parameters
    ----------
    motion
        Dataset of `steady`, or of `simulate` with samples, including a motion through a `Record`.

    Returns
    -------
    xarray.Dataset
        The extremes and the excursions of the displacement, of the absolute acceleration and of the
        force transmitted to the base have the same names as in `sweep`. ``total_supplied`` is the
        energy that the excitation supplies over the whole motion. ``total_isolator`` is the energy
        lost in the isolator, and ``total_bumpers`` the energy lost in the stops.

        The energies are counted from ``initial_state``. If the mass starts on a rigid stop and
        moves into it, the energies include this impact, although the first sample lies after it. In
        that case a note reports the impact.

    Raises
    ------
    InputError
        If the dataset does not hold a motion with samples.
    """
    origin = any_recorded(motion)
    every = cut(motion, origin)
    rows = measured(origin, every)
    supplied, isolator, bumpers = energies(origin, every, rows)
    values = {
        **extremes(origin, every, rows),
        "total_supplied": supplied,
        "total_isolator": isolator,
        "total_bumpers": bumpers,
    }
    notes = [*noted(motion), *_begins_with_an_impact(motion), *_unmeasured(rows)]
    return describe(xr.Dataset(values), "vibroimpact.totals", motion_parameters(motion), notes)


def _unmeasured(rows: NDArray[np.float64]) -> list[str]:
    """Describe in words that some phases could not be measured, if so."""
    unknown = int(np.isnan(rows).any(axis=1).sum())
    if not unknown:
        return []
    return [
        "the extremes and energies are unknown, because the velocity changes sign too often in "
        f"{unknown} of {len(rows)} intervals between contacts and detachments"
    ]


def _begins_with_an_impact(motion: xr.Dataset) -> list[str]:
    """Describe in words that the mass starts on a rigid stop and moves into it, if so."""
    if "initial_state" not in motion or not motion.sizes.get("time"):
        return []
    before = float(motion["initial_state"].sel(component="velocity"))
    behind = float(motion["velocity"][0])
    if before == behind:
        return []
    return [
        f"the motion starts with an impact, from {before:.6g} to {behind:.6g} m/s: the energies "
        "include this impact, and the first sample is the state after it"
    ]


def extremes(origin: Recorded[Any], every: Phases, rows: NDArray[np.float64]) -> dict[str, float]:
    """Return extremes and excursions of a motion whose phases were measured."""
    side = view(every)
    face = side * origin.of_side(side, "gap")
    # A left contact is measured towards the bumper.
    least = np.where(side == -1, -rows[:, measure.X_MOST], rows[:, measure.X_LEAST]) + face
    most = np.where(side == -1, -rows[:, measure.X_LEAST], rows[:, measure.X_MOST]) + face
    high, low = float(most.max()), float(least.min())
    top, bottom = float(rows[:, measure.A_MOST].max()), float(rows[:, measure.A_LEAST].min())
    least_force, most_force = transmitted_extremes(origin, every, rows)
    return {
        "displacement_max": high,
        "displacement_min": low,
        "displacement_excursion": high - low,
        "acceleration_max": top,
        "acceleration_min": bottom,
        "acceleration_excursion": top - bottom,
        "transmitted_force_max": most_force,
        "transmitted_force_min": least_force,
        "transmitted_force_excursion": most_force - least_force,
        "eccentricity": 0.5 * (high + low),
    }


def energies(
    origin: Recorded[Any], every: Phases, rows: NDArray[np.float64]
) -> tuple[float, float, float]:
    """Return the energy (J) supplied, lost in the isolator and lost in the stops."""
    mass = origin.oscillator.mass
    rows = rows[~chattered(every)]
    stops = rows[:, [measure.LOST_RIGHT, measure.LOST_LEFT]].sum()
    lost = relaxation_loss(origin, every).sum() + impact_loss(origin, every).sum()
    return (
        -mass * float(rows[:, measure.WORK].sum()),
        mass * float(rows[:, measure.LOST].sum()),
        mass * float(stops) + float(lost),
    )
