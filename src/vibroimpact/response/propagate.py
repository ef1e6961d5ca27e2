"""Following a motion without looking at it: its state later, or once a forcing cycle."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch, hold, lyapunov
from vibroimpact.engine import motion as layout
from vibroimpact.engine.memory import TERMS
from vibroimpact.engine.observers import record
from vibroimpact.engine.status import Status
from vibroimpact.model import Repeated
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import CYCLES, Progress, Tally, watched

_Array = NDArray[np.float64]

_ROWS = 16_384
"""Cycles of one call of the engine, at most: their rows take 1 MB."""


def moved_on(
    rig: _Array, excitation: Repeated, vector: _Array, cycles: float, max_events: int = 10_000
) -> tuple[Status, _Array]:
    """The engine's state some forcing cycles later; of use only if `Status.DONE`."""
    later = vector.copy()
    _, _, outcome = batch.trajectory(
        rig,
        excitation.amplitude,
        excitation.frequency,
        excitation.phase,
        later,
        0.0,
        cycles,
        0,
        max_events,
        np.empty((record.SAMPLE, 0)),
        np.empty((max_events + 1, record.EVENT)),
    )
    return Status(outcome), later


def hold_once(
    rig: _Array,
    excitation: Repeated,
    state: _Array,
    tolerance: float,
    max_cycles: int,
    window: int,
    max_events: int,
    progress: Progress | None = None,
) -> tuple[_Array, _Array]:
    """Hold one frequency until the motion has settled; Ctrl-C ends it.

    Parameters
    ----------
    rig, excitation
        What vibrates, and what shakes it.
    state
        Of the engine, at the section.
    tolerance, max_cycles, window, max_events
        As in `engine.batch.sweep`.
    progress
        Called with the cycles done and `max_cycles`.

    Returns
    -------
    result, reached
        As `engine.batch.sweep` writes them for one frequency.
    """
    result, reached = np.empty((1, hold.RESULTS)), np.zeros((1, layout.STATE))

    def hold_it(tally: Tally) -> None:
        batch.sweep(
            rig,
            np.array([excitation.amplitude]),
            np.array([excitation.frequency]),
            excitation.phase,
            state.copy(),
            tolerance,
            max_cycles,
            window,
            max_events,
            hold.PATIENT,
            result,
            reached,
            tally,
        )

    watched(hold_it, max_cycles, progress, CYCLES)
    return result[0], reached[0]


def grown(
    rig: _Array,
    excitation: Repeated,
    state: _Array,
    cycles: int,
    max_events: int = 10_000,
    *,
    transient: int = 0,
    discard: int = 0,
    progress: Progress | None = None,
) -> tuple[Status, _Array]:
    """Sections of a motion, and the growth of disturbances, cycle by cycle.

    Parameters
    ----------
    rig, excitation
        What vibrates, and what shakes it.
    state
        Of the engine; it is carried on.
    cycles
        How many rows.
    max_events
        Contacts and detachments in one forcing cycle at which it is given up.
    transient, discard
        Cycles before that, without and with disturbances.
    progress
        Called now and then with the cycles done and all there are.

    Returns
    -------
    status, rows
        Rows of `engine.lyapunov.growth`: fewer than asked for unless `Status.DONE`.
    """
    rows = np.empty((cycles, lyapunov.GROWTH))
    done = 0

    def keep(some: _Array) -> None:
        nonlocal done
        rows[done : done + len(some)] = some
        done += len(some)

    status = grow(
        rig,
        excitation,
        state,
        cycles,
        keep,
        max_events,
        transient=transient,
        discard=discard,
        progress=progress,
    )
    return status, rows[:done]


def grow(
    rig: _Array,
    excitation: Repeated,
    state: _Array,
    cycles: int,
    keep: Callable[[_Array], None],
    max_events: int = 10_000,
    *,
    transient: int = 0,
    discard: int = 0,
    progress: Progress | None = None,
) -> Status:
    """As `grown`, some cycles at a time, so that no more rows are in memory than are kept.

    Parameters
    ----------
    keep
        Called with the rows that follow, which are overwritten afterwards.
    """
    rows = np.empty((min(cycles, _ROWS), lyapunov.GROWTH))
    disturbances = np.zeros((2, TERMS))
    first = -transient - discard
    calls = Calls(cycles - first, progress, _ROWS)
    at, outcome = first, int(Status.DONE)
    while at < cycles and outcome == Status.DONE:
        outcome, after = lyapunov.growth(
            rig,
            excitation.amplitude,
            excitation.frequency,
            excitation.phase,
            state,
            disturbances,
            at == first,
            at,
            first + int(calls.end(at - first)),
            discard,
            max_events,
            rows,
        )
        if after > 0:
            keep(rows[: after - max(at, 0)])
        at = after
    if progress and at == cycles:
        progress(cycles - first, cycles - first)
    return Status(outcome)
