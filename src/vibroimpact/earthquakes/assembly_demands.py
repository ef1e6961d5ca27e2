"""What records ask of assemblies: peaks by mass, link and stop, from rest."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.engine import earthquakes
from vibroimpact.engine.observers import phases
from vibroimpact.engine.observers.phases import Layout
from vibroimpact.engine.status import Status
from vibroimpact.model import Assembly, equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.motion_phases import Course, PartColumns, PhaseRecord, Phases
from vibroimpact.response.record_history import straight
from vibroimpact.response.totals import energies, extremes
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]

PEAKS = (
    *("peak_displacement", "displacement_max", "displacement_min", "peak_acceleration"),
    *("peak_drift", "drift_max", "drift_min"),
    *("peak_force", "impulse", "impact_count"),
    "peak_transmitted_force",
)
"""Results of each run."""
ENERGIES = ("total_supplied", "total_links", "total_damping", "total_stops", "total_stored")


class RunColumns(PartColumns):
    """What the engine finds of runs, a row each."""

    def __init__(self, rows: _Array, layout: Layout) -> None:
        self.rows, self.layout = rows, layout


def peaks_of_assemblies(rows: _Array, layout: Layout) -> dict[str, NDArray[Any]]:
    """Return `PEAKS` and ``status`` of runs, shape (run, factor) and, if so, mass, link or stop."""
    columns = RunColumns(rows.reshape(-1, rows.shape[-1]), layout)
    low, high = columns.of_mass(phases.U_LEAST), columns.of_mass(phases.U_MOST)
    felt = np.maximum(-columns.of_mass(phases.A_LEAST), columns.of_mass(phases.A_MOST))
    closes, opens = columns.of_drift(phases.D_LEAST), columns.of_drift(phases.D_MOST)
    carried = columns.rows[:, [phases.CARRIED_LEAST, phases.CARRIED_MOST]]
    values = {
        "peak_displacement": np.maximum(-low, high),
        "displacement_max": high,
        "displacement_min": low,
        "peak_acceleration": felt,
        "peak_drift": np.maximum(-closes, opens),
        "drift_max": opens,
        "drift_min": closes,
        "peak_force": columns.of_stop(phases.FORCE),
        "impulse": columns.of_stop(phases.IMPULSE),
        "impact_count": columns.rows[:, layout.width :][:, : layout.stops],
        "peak_transmitted_force": np.abs(carried).max(axis=1),
    }
    of_runs = {name: one.reshape(*rows.shape[:-1], *one.shape[1:]) for name, one in values.items()}
    return {**of_runs, "status": rows[..., earthquakes.OUTCOME].astype(np.int64)}


def _nothing(assembly: Assembly) -> dict[str, Any]:
    sizes = {name: len(labels) for name, labels in assembly.part_names.items()}
    names = (*PEAKS, *ENERGIES)
    return {
        name: (dim, np.full(sizes[dim], np.nan)) if dim else ((), np.nan)
        for name in names
        for dim in [VARIABLES[name].part]
    }


def seismic_response_of_assembly(
    rig: Rig, tail: float, max_events: int, progress: Progress | None
) -> tuple[Status, xr.Dataset]:
    """Return how the response of an assembly to its record ended, and its peaks and energies."""
    assembly, record = rig.assembly, rig.record
    states = engine_system(assembly)
    states.check_motion(record)
    begin = states.motion_vector(equilibrium(assembly))
    final, lines = begin.copy(), straight(record, tail)
    vector = states.numbers(record, tables=True)
    course = Course(vector, record.peak, 0.0, 0.0, lines, True, final, len(lines), states.layout)
    status, rows = course.measured(max_events, progress)
    values = _nothing(assembly)
    if status is Status.DONE:
        nothing = np.empty(0)
        motion = Phases(assembly, PhaseRecord(status, rows, nothing, nothing), begin, final)
        peaks = extremes(motion)
        values = {name: peaks[name] for name in PEAKS} | energies(motion)
    data = xr.Dataset(values, assembly.part_names)
    data["status"] = int(status)
    return status, data
