"""Many rigs through records, at several scales each: their peaks as plain arrays.

Every computation of many motions uses `peaks`: no dataset is made of a run, and no
history is kept.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.earthquakes.assembly_demands import peaks_of_assemblies
from vibroimpact.earthquakes.free_vibration import BLOCKS, SMALL, block, free_tail, settles
from vibroimpact.engine import earthquakes as found
from vibroimpact.engine import sections
from vibroimpact.engine.assembly.plan import Drift
from vibroimpact.engine.observers.phases import Layout
from vibroimpact.engine.one_mass import demand, extremes
from vibroimpact.model import Record, equilibrium
from vibroimpact.model.rig import Rig, one_mass_only
from vibroimpact.model.system import System
from vibroimpact.response.engine_system import engine_system
from vibroimpact.tasks.threads import Progress, Tally, Workers, each, worker_count

_Array = NDArray[np.float64]

PEAKS = (
    "peak_displacement",
    "displacement_max",
    "displacement_min",
    "peak_acceleration",
    "peak_force",
    "impulse",
    "impact_count",
)
"""Results of each run, in m, m/s², N and N s; infinite forces are those of rigid stops."""

ENERGIES = ("total_supplied", "total_isolator", "total_bumpers")
"""In J, over the record and the tail."""

RESIDUALS = ("residual_displacement", "residual_swing")
"""In m: where the mass comes to rest, and half the width of its last swing about that place."""

MAX_EVENTS = 10_000
"""Events in a step of a record at which a motion is given up."""

_AT_ONCE = 64
"""Scales of one call of the engine, at most."""


class ScaledRecord(NamedTuple):
    """An oscillator or an assembly, a record, and the numbers that the record is multiplied by."""

    system: System
    record: Record
    factors: _Array
    drifts: Sequence[Drift] | None = None
    """Drifts of an assembly that are measured. Default: those of the links."""

    @property
    def layout(self) -> Layout:
        """Where the numbers of an assembly's masses, stops and drifts stand."""
        whole = engine_system(self.system).layout
        return whole if self.drifts is None else whole._replace(drifts=len(self.drifts))


class _Prepared(NamedTuple):
    """The engine's vectors of a rig and its rest, and how many numbers are found of each run."""

    vector: _Array
    rest: _Array
    numbers: int
    moves_on: bool
    """Whether it depends on the motion where the mass comes to rest."""


def _prepared(one: ScaledRecord) -> _Prepared:
    states = engine_system(one.system)
    vector = states.numbers(one.record, tables=True, drifts=one.drifts)
    count, moves_on = demand.EVERYTHING, False
    if one.system.by_mass:
        count = one.layout.width + one.layout.stops
    else:
        moves_on = settles(one_mass_only(one.system))
    rest = states.motion_vector(states.read(None))
    return _Prepared(vector, rest, count + found.BEHIND, moves_on)


def peaks(
    shaken: Sequence[ScaledRecord],
    *,
    tail: float | None = None,
    energies: bool = False,
    residuals: bool = False,
    max_events: int = MAX_EVENTS,
    threads: Workers = None,
    progress: Progress | None = None,
    by_line: bool = False,
) -> dict[str, NDArray[Any]]:
    """Return the peaks of rigs through records, at several scales each, from their rest.

    With `energies` and `residuals`, `ENERGIES` and `RESIDUALS` of oscillators are found, too; the
    former take several times as long.

    Parameters
    ----------
    shaken
        The rigs with their records; all have the same number of factors, and assemblies parts of
        the same names.
    tail
        Duration of free vibration after each record (s); None for that of `free_tail`.
    by_line
        Whether progress counts the steps of the records, in the place of runs.

    Returns
    -------
    dict of ndarray, shape (shaken, factor)
        `PEAKS`, further requested quantities, and ``status``: a `Status` each, 0 where the run was
        done. All values of another run are NaN but for its status. Values of stops have the
        right and the left side as a further axis, 0 where the rig has no stop. Of assemblies the
        peaks are `assembly_demands.PEAKS`, with the masses, links or stops as a further axis.
    """
    count = len(shaken[0].factors) if shaken else 0
    ready = [_prepared(one) for one in shaken]
    rows = np.full((len(shaken), count, ready[0].numbers if ready else 0), np.nan)
    workers = worker_count(threads)
    # Few rigs with many scales are dealt out, too.
    few = max(1, min(_AT_ONCE, -(-count * len(shaken) // (4 * workers))))
    parts = [(n, slice(i, i + few)) for n in range(len(shaken)) for i in range(0, count, few)]
    found.respond.prepare(*(one.vector for one in ready))
    items = [
        (shaken[n]._replace(factors=np.array(shaken[n].factors[some], dtype=float)), ready[n])
        for n, some in parts
    ]

    def task(item: tuple[ScaledRecord, _Prepared], tally: Tally) -> _Array:
        (system, record, factors, _), engine = item
        rig = Rig(system, record)
        mine = np.empty((len(factors), engine.numbers))
        rests = residuals and engine.moves_on
        found.respond(
            engine.vector,
            np.array(record.acceleration),  # which is not to be written to: another type, refused
            record.step,
            factors,
            free_tail(rig) if tail is None else tail,
            engine.rest,
            max_events,
            int(energies),
            block(rig) if rests else 0.0,
            BLOCKS if rests else 0,
            SMALL,
            tally,
            np.empty((len(record.acceleration) - 1, sections.ROW)),
            mine,
        )
        return mine

    runs = len(shaken) * count
    steps = count * sum(len(one.record.acceleration) - 1 for one in shaken)
    report = partial(_by_run, progress, runs) if progress and not by_line else progress
    rows_of_parts = each(task, items, steps=steps, threads=threads, progress=report)
    for (n, some), mine in zip(parts, rows_of_parts, strict=True):
        rows[n, some] = mine
    if shaken and shaken[0].system.by_mass:
        return peaks_of_assemblies(rows, shaken[0].layout)
    return _named(shaken, rows, energies, residuals)


def _by_run(progress: Progress, runs: int, done: int, total: int | None) -> None:
    """Count runs, from the steps of all their records that are done."""
    progress(done * runs // (total or 1), runs)


def _named(
    shaken: Sequence[ScaledRecord], rows: _Array, energies: bool, residuals: bool
) -> dict[str, NDArray[Any]]:
    """The engine's numbers of oscillators in SI units, by name."""
    oscillators = [one_mass_only(one.system) for one in shaken]
    mass = np.array([one.mass for one in oscillators])[:, np.newaxis]
    farthest = np.maximum(rows[..., extremes.U_MOST], -rows[..., extremes.U_LEAST])
    status = [
        engine_system(one.system).judged(row[:, found.OUTCOME], far)
        for one, row, far in zip(shaken, rows, farthest, strict=True)
    ]
    acceleration = np.maximum(rows[..., extremes.A_MOST], -rows[..., extremes.A_LEAST])
    columns: list[_Array] = [
        farthest,
        rows[..., extremes.U_MOST],
        rows[..., extremes.U_LEAST],
        acceleration,
        mass[..., np.newaxis] * rows[..., extremes.by_stop(extremes.FORCE)],
        mass[..., np.newaxis] * rows[..., extremes.by_stop(extremes.IMPULSE)],
        rows[..., extremes.by_stop(extremes.HITS)],
    ]
    values: dict[str, NDArray[Any]] = dict(zip(PEAKS, columns, strict=True))
    if energies:
        sums = (demand.WORK, demand.LOST, demand.LOST_STOPS)
        values |= {name: mass * rows[..., at] for name, at in zip(ENERGIES, sums, strict=True)}
    if residuals:
        rest, swing = rows[..., found.REST], rows[..., found.SWING]
        for n, one in enumerate(oscillators):
            if not settles(one):
                done = rows[n, :, found.OUTCOME] == 0.0
                rest[n] = np.where(done, equilibrium(one).displacement, np.nan)
                swing[n] = np.where(done, 0.0, np.nan)
        values |= {RESIDUALS[0]: rest, RESIDUALS[1]: swing}
    values["status"] = np.array(status, dtype=np.int64).reshape(farthest.shape)
    return values
