"""Many rigs through records, at several scales each: their peaks as plain arrays.

Every computation of many motions uses `peaks`: no dataset is made of a run, and no
history is kept.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.earthquakes.free_vibration import BLOCKS, SMALL, block, free_tail, settles
from vibroimpact.engine import earthquakes as found
from vibroimpact.engine import sections
from vibroimpact.engine.observers import demand, extremes
from vibroimpact.model import Oscillator, Record, equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_rig, engine_state
from vibroimpact.response.softening_limit import judged
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
"""Contacts and detachments in a step of a record at which a motion is given up."""

_FOUND = demand.EVERYTHING + found.BEHIND
"""What the engine finds of a run."""

_AT_ONCE = 64
"""Scales of one call of the engine, at most."""


class Shaken(NamedTuple):
    """A rig, a record, and the numbers that the record is multiplied by."""

    oscillator: Oscillator
    record: Record
    factors: _Array


def peaks(
    shaken: Sequence[Shaken],
    *,
    tail: float | None = None,
    energies: bool = False,
    residuals: bool = False,
    max_events: int = MAX_EVENTS,
    threads: Workers = None,
    progress: Progress | None = None,
    by_line: bool = False,
) -> dict[str, NDArray[np.generic]]:
    """Return the peaks of rigs through records, at several scales each, from their rest.

    Parameters
    ----------
    shaken
        The rigs with their records; all have the same number of factors.
    tail
        Duration of free vibration after each record (s); None for that of `free_tail`.
    energies
        Whether `ENERGIES` are found, too, which takes several times as long.
    residuals
        Whether `RESIDUALS` are found, too.
    max_events
        See `MAX_EVENTS`.
    threads
        Number of threads (default: one per processor); or a cluster. It does not affect the result.
    progress
        Called from the calling thread with the runs done and all there are.
    by_line
        Whether progress counts the steps of the records, in the place of runs.

    Returns
    -------
    dict of ndarray, shape (shaken, factor)
        `PEAKS`, further requested quantities, and ``status``: a `Status` each, 0 where the run was
        done. All values of another run are NaN but for its status. Values of stops have the
        right and the left side as a further axis, 0 where the rig has no stop.
    """
    count = len(shaken[0].factors) if shaken else 0
    rows = np.full((len(shaken), count, _FOUND), np.nan)
    workers = worker_count(threads)
    # Few rigs with many scales are dealt out, too.
    few = max(1, min(_AT_ONCE, -(-count * len(shaken) // (4 * workers))))
    parts = [(n, slice(i, i + few)) for n in range(len(shaken)) for i in range(0, count, few)]
    vectors = [engine_rig(Rig(one.oscillator, one.record)) for one in shaken]
    starts = [engine_state(one.oscillator, equilibrium(one.oscillator)) for one in shaken]
    found.respond.prepare(*vectors)
    items = [
        (shaken[n]._replace(factors=np.array(shaken[n].factors[some])), vectors[n], starts[n])
        for n, some in parts
    ]

    def task(item: tuple[Shaken, _Array, _Array], tally: Tally) -> _Array:
        (rig, record, factors), vector, start = item
        mine = np.empty((len(factors), _FOUND))
        rests = residuals and settles(rig)
        found.respond(
            vector,
            np.array(record.acceleration),  # which is not to be written to: another type, refused
            record.step,
            factors,
            free_tail(Rig(rig, record)) if tail is None else tail,
            start,
            max_events,
            int(energies),
            block(Rig(rig, record)),
            BLOCKS if rests else 0,
            SMALL,
            tally,
            np.empty((len(record.acceleration) - 1, sections.ROW)),
            mine,
        )
        return mine

    steps = count * sum(len(one.record.acceleration) - 1 for one in shaken)
    told = progress if by_line else _by_run(progress, len(shaken) * count)
    done = each(task, items, steps=steps, threads=threads, progress=told)
    for (n, some), mine in zip(parts, done, strict=True):
        rows[n, some] = mine
    return _named(shaken, rows, energies, residuals)


def _by_run(progress: Progress | None, runs: int) -> Progress | None:
    """Progress that counts runs, from that which counts the steps of all their records."""
    return progress and (lambda done, total: progress(done * runs // (total or 1), runs))


def _named(
    shaken: Sequence[Shaken], rows: _Array, energies: bool, residuals: bool
) -> dict[str, NDArray[np.generic]]:
    """The engine's numbers in SI units, by name."""
    mass = np.array([one.oscillator.mass for one in shaken])[:, np.newaxis]
    farthest = np.maximum(rows[..., extremes.U_MOST], -rows[..., extremes.U_LEAST])
    status = [
        judged(one.oscillator, row[:, found.OUTCOME], far)
        for one, row, far in zip(shaken, rows, farthest, strict=True)
    ]
    acceleration = np.maximum(rows[..., extremes.A_MOST], -rows[..., extremes.A_LEAST])
    columns: list[_Array] = [
        farthest,
        rows[..., extremes.U_MOST],
        rows[..., extremes.U_LEAST],
        acceleration,
        mass[..., np.newaxis] * rows[..., [extremes.FORCE_RIGHT, extremes.FORCE_LEFT]],
        mass[..., np.newaxis] * rows[..., [extremes.IMPULSE_RIGHT, extremes.IMPULSE_LEFT]],
        rows[..., [extremes.HITS_RIGHT, extremes.HITS_LEFT]],
    ]
    values: dict[str, NDArray[np.generic]] = dict(zip(PEAKS, columns, strict=True))
    if energies:
        sums = (demand.WORK, demand.LOST, demand.LOST_STOPS)
        values |= {name: mass * rows[..., at] for name, at in zip(ENERGIES, sums, strict=True)}
    if residuals:
        rest, swing = rows[..., found.REST], rows[..., found.SWING]
        for n, one in enumerate(shaken):
            if not settles(one.oscillator):
                done = rows[n, :, found.OUTCOME] == 0.0
                rest[n] = np.where(done, equilibrium(one.oscillator).displacement, np.nan)
                swing[n] = np.where(done, 0.0, np.nan)
        values |= {RESIDUALS[0]: rest, RESIDUALS[1]: swing}
    values["status"] = np.array(status, dtype=np.int64).reshape(farthest.shape)
    return values
