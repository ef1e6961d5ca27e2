"""What records ask of assemblies: peaks by mass, link and stop, from rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.earthquakes.free_vibration import free_tail
from vibroimpact.engine import earthquakes, sections
from vibroimpact.engine.assembly.plan import Drift
from vibroimpact.engine.observers import phases
from vibroimpact.engine.observers.phases import Layout
from vibroimpact.engine.status import Status
from vibroimpact.model import Assembly, Record, equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.assembly_rig import assembly_numbers, check_laws
from vibroimpact.response.assembly_rows import coordinates
from vibroimpact.response.assembly_state import assembly_vector
from vibroimpact.response.motion_phases import Course, Followed, PartColumns, Phases, phases_layout
from vibroimpact.response.record_history import straight
from vibroimpact.response.totals import energies, extremes
from vibroimpact.tasks.threads import Progress, Tally, Workers, each

_Array = NDArray[np.float64]

PEAKS = (
    *("peak_displacement", "displacement_max", "displacement_min", "peak_acceleration"),
    *("peak_drift", "drift_max", "drift_min"),
    *("peak_force", "impulse", "impact_count"),
    "peak_transmitted_force",
)
"""Results of each run."""
ENERGIES = ("total_supplied", "total_links", "total_damping", "total_stops", "total_stored")


class AssemblyRuns(NamedTuple):
    """An assembly, a record, the numbers that it is multiplied by, and the drifts that are seen."""

    assembly: Assembly
    record: Record
    factors: _Array
    drifts: Sequence[Drift] | None = None
    """Default: those of the links."""


class Found(PartColumns):
    """What the engine found of runs: a row for each factor, and how each ended."""

    def __init__(self, rows: _Array, layout: Layout, status: list[Status]) -> None:
        self.rows, self.layout, self.status = rows, layout, status

    @property
    def impact_count(self) -> _Array:
        """Contacts begun, of rigid stops impacts, shape (factor, stop)."""
        return self.rows[:, self.layout.width :][:, : self.layout.stops]


def follow_all(
    runs: Sequence[AssemblyRuns],
    tail: float | None,
    max_events: int,
    workers: Workers,
    progress: Progress | None,
) -> list[Found]:
    """Follow assemblies through records from rest; returns the result of each run."""
    vectors = []
    for one in runs:
        check_laws(one.assembly)
        vectors.append(assembly_numbers(one.assembly, one.record, tables=True, drifts=one.drifts))
    earthquakes.respond.prepare(*vectors)
    count = sum(len(one.factors) for one in runs)
    steps = sum(len(one.factors) * (len(one.record.acceleration) - 1) for one in runs)

    def task(number: int, tally: Tally) -> Found:
        assembly, record, factors, drifts = runs[number]
        of = Layout(
            len(assembly.names),
            len(assembly.stops),
            len(assembly.links) if drifts is None else len(drifts),
        )
        rows = np.empty((len(factors), of.width + of.stops + earthquakes.BEHIND))
        earthquakes.respond(
            vectors[number],
            np.array(record.acceleration),  # which is not to be written to: another type, refused
            record.step,
            np.array(factors, dtype=np.float64),
            free_tail(Rig(assembly, record)) if tail is None else tail,
            assembly_vector(assembly, equilibrium(assembly)),
            max_events,
            0,
            0.0,
            0,
            0.0,
            tally,
            np.empty((len(record.acceleration) - 1, sections.ROW)),
            rows,
        )
        status = [Status(int(code)) for code in rows[:, earthquakes.OUTCOME]]
        return Found(rows, of, status)

    def told(done: int, total: int | None) -> None:
        assert progress is not None
        progress(done * count // (total or 1), count)

    return each(
        task,
        range(len(runs)),
        steps=steps,
        threads=workers,
        progress=None if progress is None else told,
    )


def _variables(found: Found) -> dict[str, _Array]:
    """Return the peaks of runs, shape (factor, mass, link or stop)."""
    low, high = found.of_mass(phases.U_LEAST), found.of_mass(phases.U_MOST)
    felt = np.maximum(-found.of_mass(phases.A_LEAST), found.of_mass(phases.A_MOST))
    closes, opens = found.of_drift(phases.D_LEAST), found.of_drift(phases.D_MOST)
    carried = found.rows[:, [phases.CARRIED_LEAST, phases.CARRIED_MOST]]
    return {
        "peak_displacement": np.maximum(-low, high),
        "displacement_max": high,
        "displacement_min": low,
        "peak_acceleration": felt,
        "peak_drift": np.maximum(-closes, opens),
        "drift_max": opens,
        "drift_min": closes,
        "peak_force": found.of_stop(phases.FORCE),
        "impulse": found.of_stop(phases.IMPULSE),
        "impact_count": found.impact_count,
        "peak_transmitted_force": np.abs(carried).max(axis=1),
    }


def _nothing(assembly: Assembly) -> dict[str, Any]:
    sizes = {name: len(found) for name, found in coordinates(assembly).items()}
    names = (*PEAKS, *ENERGIES)
    return {
        name: (dim, np.full(sizes[dim], np.nan)) if dim else ((), np.nan)
        for name in names
        for dim in [VARIABLES[name].part]
    }


def peaks_of_assemblies(
    runs: Sequence[AssemblyRuns],
    tail: float | None,
    max_events: int,
    workers: Workers,
    progress: Progress | None,
) -> dict[str, NDArray[Any]]:
    """Return `PEAKS` and ``status`` of assemblies with the same parts, by run, factor and part.

    All values of a run that was given up are NaN but for its status.
    """
    found = follow_all(runs, tail, max_events, workers, progress)
    columns = [_variables(one) for one in found]
    values: dict[str, NDArray[Any]] = {
        name: np.array([one[name] for one in columns]) for name in PEAKS
    }
    status = np.array([[int(code) for code in one.status] for one in found], dtype=np.int64)
    return {**values, "status": status}


def seismic_response_of_assembly(
    rig: Rig, tail: float, max_events: int, progress: Progress | None
) -> tuple[Status, xr.Dataset]:
    """Return how the response of an assembly to its record ended, and its peaks and energies."""
    assembly, record = rig.system, rig.record
    assert isinstance(assembly, Assembly)
    check_laws(assembly)
    begin = assembly_vector(assembly, equilibrium(assembly))
    final, lines = begin.copy(), straight(record, tail)
    vector = assembly_numbers(assembly, record, tables=True)
    course = Course(
        vector, record.peak, 0.0, 0.0, lines, True, final, len(lines), phases_layout(assembly)
    )
    status, rows = course.measured(max_events, progress)
    values = _nothing(assembly)
    if status is Status.DONE:
        nothing = np.empty(0)
        found = Phases(assembly, Followed(status, rows, nothing, nothing), begin, final)
        peaks = extremes(found)
        values = {name: peaks[name] for name in PEAKS} | energies(found)
    data = xr.Dataset(values, coordinates(assembly))
    data["status"] = int(status)
    return status, data
