"""Following a motion without looking at it: its state later, or once a forcing cycle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch, lyapunov
from vibroimpact.engine.observers import record
from vibroimpact.engine.status import Status
from vibroimpact.model import Repeated

_Array = NDArray[np.float64]


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


def grown(
    rig: _Array,
    excitation: Repeated,
    state: _Array,
    cycles: int,
    max_events: int = 10_000,
    *,
    transient: int = 0,
    discard: int = 0,
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

    Returns
    -------
    status, rows
        Rows of `engine.lyapunov.growth`: fewer than asked for unless `Status.DONE`.
    """
    rows = np.empty((cycles, lyapunov.GROWTH))
    outcome, done = lyapunov.growth(
        rig,
        excitation.amplitude,
        excitation.frequency,
        excitation.phase,
        state,
        transient,
        discard,
        max_events,
        rows,
    )
    return Status(outcome), rows[:done]
