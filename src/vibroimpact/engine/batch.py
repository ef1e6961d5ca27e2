"""What Python calls: a whole sweep, or a stretch of trajectory.

Each frees the interpreter lock, so that threads run many at once; each is a pure function of its
arguments, so that their number changes no bit.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.opening import open_entry
from vibroimpact.engine.recording import write_down
from vibroimpact.engine.sections import advance, repeated, row_buffer
from vibroimpact.engine.state import copy, state_buffer, width
from vibroimpact.engine.status import DONE, NOT_FINITE, STOPPED, TOO_MANY_EVENTS, TOO_MUCH_WORK
from vibroimpact.engine.steady_response import OUTCOME, hold


@entry(
    "void(f8[::1], f8[::1], f8[::1], f8, f8[::1], f8, i8, i8, i8, f8,"
    " f8[:, ::1], f8[:, ::1], i8[::1])"
)
def sweep(
    memory: Any,
    rig: Vector,
    amplitudes: Vector,
    frequencies: Vector,
    phase: float,
    state: Vector,
    tolerance: float,
    max_cycles: int,
    window: int,
    max_events: int,
    transient: float,
    results: Vector,
    states: Vector,
    progress: NDArray[np.int64],
) -> None:
    """Hold one frequency after the other, carrying the state on.

    Parameters
    ----------
    rig : ndarray
        From `parameters.rig_vector`.
    amplitudes, frequencies, phase : ndarray, ndarray, float
        m/s² or what the rig's vector says, Hz in the order of the sweep, rad at the section.
    state : ndarray, shape (`state.width`,)
        Where the sweep starts; carried on in place.
    tolerance, max_cycles, window, max_events, transient
        See `settling.settle`.
    results, states : ndarray, shape (frequency, MEASURED + measures), (frequency, state.width)
        Written: the measurements (`steady_response`), and the state at the end of each hold.
    progress : ndarray, shape (2,) or (3,)
        [0] is raised by one after each hold; the sweep stops when [1] becomes nonzero; [2] is how
        many cycles of the hold are done.
    """
    options = (tolerance, max_cycles, window, max_events, transient)
    plan = planned(memory, rig)
    s, c = math.sin(phase), math.cos(phase)
    here = state_buffer()
    copy(pointer(state), here, width(plan))
    for i in range(len(frequencies)):
        if progress[1] != 0:
            for j in range(i, len(frequencies)):
                results[j, OUTCOME] = STOPPED
            break
        hold(plan, here, amplitudes[i], frequencies[i], s, c, options, results[i], progress)
        copy(here, pointer(states[i]), width(plan))
        progress[0] += 1
        outcome = results[i, OUTCOME]
        if outcome in (TOO_MANY_EVENTS, TOO_MUCH_WORK, NOT_FINITE):
            # Nothing sound to carry on: the next frequency starts where the sweep did.
            copy(pointer(state), here, width(plan))
    copy(here, pointer(state), width(plan))


@entry(
    "UniTuple(i8, 3)(f8[::1], f8, f8, f8, f8[::1], f8, f8, i8, i8, f8[:, ::1], f8[:, ::1])",
    "recorded",
)
def trajectory(
    memory: Any,
    rig: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    state: Vector,
    first: float,
    cycles: float,
    samples: int,
    max_events: int,
    out: Vector,
    events: Vector,
) -> tuple[int, int, int]:
    """Follow a motion and write it down, until the end or until `events` may overflow.

    Parameters
    ----------
    first, cycles : float
        Cycle to begin with, and how many in all; only the last may be incomplete.
    samples : int
        Samples per cycle; 0 for none.
    out : ndarray, shape (record.SAMPLE, samples from cycle 0 to the end, and one for the end)
    events : ndarray, shape (capacity > max_events, record.EVENT)
    rig, amplitude, phase, state, max_events
        As in `sweep`; the phase is that at whole cycles.

    Returns
    -------
    next, count, outcome
        The cycle to go on with, the number of events written, a `Status`.
    """
    start, here, row = int(first), state_buffer(), row_buffer()
    at = pointer(state)
    plan, s, c, period, outcome = open_entry(memory, rig, amplitude, frequency, phase, at, here)
    if outcome != DONE:
        return start, 0, outcome
    summary = write_down(
        plan,
        here,
        repeated(row, s, c, period),
        start,
        cycles,
        samples,
        period,
        max_events,
        False,
        pointer(out),
        out.shape[1],
        pointer(events),
        len(events),
    )
    copy(here, at, width(plan))
    return summary


@entry("i8(f8[::1], f8, f8, f8, f8[::1], f8, i8)")
def propagate(
    memory: Any,
    rig: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    state: Vector,
    cycles: float,
    max_events: int,
) -> int:
    """Carry a state on over some cycles, of which the last may be incomplete: a `Status`.

    The arguments are those of `trajectory`; a cycle that is given up leaves its section.
    """
    here, section = state_buffer(), state_buffer()
    at = pointer(state)
    plan, s, c, period, outcome = open_entry(memory, rig, amplitude, frequency, phase, at, here)
    number = 0.0
    while number < cycles and outcome == DONE:
        length = min(1.0, cycles - number) * period
        _, outcome = advance(plan, here, section, s, c, length, max_events)
        number += 1.0
    copy(here, at, width(plan))
    return outcome  # type: ignore[no-any-return]
