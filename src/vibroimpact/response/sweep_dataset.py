"""What the holds of sweeps measured, as a labelled dataset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.stops import shared_part_names
from vibroimpact.model.system import System
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.hold_rows import HoldRows
from vibroimpact.response.sweep_arrays import SweepPlan

_Array = NDArray[np.float64]


def sweep_dataset(
    systems: Sequence[System],
    plans: Sequence[SweepPlan],
    results: _Array,
    states: _Array,
    phase: float,
) -> xr.Dataset:
    """Label what holds measured.

    Parameters
    ----------
    systems, plans
        One for each rig: oscillators, or assemblies with parts of the same names.
    results
        Rows of `hold`, with the dims rig, direction, frequency and column.
    states
        At the end of each hold, likewise.
    phase
        That of the section, rad.
    """
    dims = ("rig", "direction", "frequency")
    first = systems[0]
    names = shared_part_names(systems)
    by_rig = [
        engine_system(one).measured(part, dims[1:], stops=names["stop"])
        for one, part in zip(systems, results, strict=True)
    ]
    variables: dict[str, Any] = {}
    for name, (of, _) in list(by_rig[0].items()):
        # What is stacked is not kept a second time.
        variables[name] = (("rig", *of), np.stack([one.pop(name)[1] for one in by_rig]))
    rows, at_end = HoldRows(results), engine_system(first)
    if not first.by_mass:
        variables |= _beside_free_flight(systems, plans, rows, variables)
    variables |= {
        "motion": (dims, np.where(rows.period > 0, "periodic", "undecided")),
        "period": (dims, rows.period),
        "cycles": (dims, rows.cycles),
        "status": (dims, rows.status.astype(np.int64)),
        "section": ((*dims, "component"), at_end.components(states, phase)),
    }
    parts = {dim: names[dim] for dim in ("mass", "stop") if dim in names}
    return xr.Dataset(variables, {**parts, "component": at_end.names})


def _beside_free_flight(
    systems: Sequence[System], plans: Sequence[SweepPlan], rows: HoldRows, known: dict[str, Any]
) -> dict[str, Any]:
    """Return η, the transmissibility, and the excursions in free flight of oscillators."""
    dims = ("rig", "direction", "frequency")
    free = np.stack([one.free for one in plans], axis=1)
    largest = np.stack([one.largest for one in plans], axis=1)
    exciting = np.array([one.exciting for one in plans])
    swing, acceleration = largest[..., np.newaxis, np.newaxis]
    masses = np.array([[engine_system(one).largest_mass] for one in systems])
    along = ("rig", "frequency")
    return {
        "eta_d": (dims, known["displacement_excursion"][1] / swing),
        "eta_a": (dims, known["acceleration_excursion"][1] / acceleration),
        "transmissibility": (dims, rows.transmitted_excursion / exciting[:, np.newaxis]),
        "free_displacement_excursion": (along, free[0]),
        "free_acceleration_excursion": (along, free[1]),
        "free_transmitted_force_excursion": (along, masses * free[2]),
        "largest_free_displacement_excursion": ("rig", largest[0]),
        "largest_free_acceleration_excursion": ("rig", largest[1]),
    }
