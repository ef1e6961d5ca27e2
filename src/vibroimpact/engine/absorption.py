"""Many states followed from section to section until each is caught where no motion leaves again.

A trap is an ellipsoid around a point of the section, or a set of cells of the plane of u and u̇ of
the first mass.
That nothing leaves it is for others to show (`attraction.absorbing_ellipsoids`).
"""

from __future__ import annotations

import math
from typing import Any

from numpy import int64
from numpy.typing import NDArray

from vibroimpact.engine import flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.sections import advance
from vibroimpact.engine.state import FIRST, copy, load, state_buffer, width
from vibroimpact.engine.status import (
    DONE,
    NOT_SETTLED,
    STOPPED,
    TOO_MUCH_WORK,
)

OWNER, REACH, CENTRE = 0, 1, 2
"""Of a trap: whose it is, its half width in u (m), the parts of its centre, and the matrix of
the form that is at most 1 within."""

LOW_U, LOW_V, STEP_U, STEP_V = range(4)
"""Of the cells: corner of the first one, and their sides (m, m/s)."""
GRID = 4

CAUGHT, CYCLES, OUTCOME = range(3)
"""Of a result: whose trap (−1: none), forcing cycles followed, a `Status`."""
RESULT = 3


def form_of(parts: int) -> int:
    """Where the form begins in a trap of states with so many parts."""
    return CENTRE + parts


def trap_width(parts: int) -> int:
    """Length of such a trap."""
    return form_of(parts) + parts * parts


@kernel
def holds(trap: Vector, state: Vector, parts: int) -> bool:
    """Whether a state at the section lies in a trap."""
    if not abs(state[FIRST] - trap[CENTRE]) <= trap[REACH]:
        return False
    form, first = 0.0, CENTRE + parts
    for i in range(parts):
        row = 0.0
        for j in range(parts):
            row += trap[first + parts * i + j] * (state[FIRST + j] - trap[CENTRE + j])
        form += row * (state[FIRST + i] - trap[CENTRE + i])
    return form <= 1.0


@entry(
    "void(f8[::1], f8, f8, f8, i8, i8, boolean, f8[:, ::1], f8[:, ::1], i8[:, ::1], f8[::1],"
    " f8[:, ::1], i8[:, ::1], i8[::1])"
)
def caught(
    memory: Any,
    rig: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    max_cycles: int,
    max_events: int,
    anew: bool,
    points: Vector,
    traps: Vector,
    cells: NDArray[int64],
    grid: Vector,
    states: Vector,
    results: NDArray[int64],
    progress: NDArray[int64],
) -> None:
    """Follow states, each until it is caught or for so many forcing cycles.

    Parameters
    ----------
    rig, amplitude, frequency, phase
        As in `batch.sweep`.
    max_cycles, max_events
        Forcing cycles for each state; events in one at which it is given up.
    anew : bool
        Whether the states are those of `points`, put where they can be, rather than `states`.
    points : ndarray, shape (n, parts) or (0, parts)
        Parts of states (`state.Parts.of_point`), the deformations away from the mass.
    traps : ndarray, shape (k, trap_width(parts))
    cells : ndarray of int, shape (rows, columns)
        Whose each cell is, −1 if nobody's: rows along u̇, columns along u.
    grid : ndarray, shape (GRID,)
        Where the cells are.
    states : ndarray, shape (n, state.width)
        Carried on in place.
    results : ndarray of int, shape (n, RESULT)
        Written.
    progress : ndarray of int, shape (2,)
        [0] is raised by one a state; all stops when [1] becomes nonzero.
    """
    plan = planned(memory, rig)
    period = 1.0 / frequency
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    s, c = math.sin(phase), math.cos(phase)
    here, section = state_buffer(), state_buffer()
    slow = flow.too_much_work(plan, period) != 0
    parts = flow.parts(plan)
    velocity = FIRST + flow.coordinates(plan) // 2
    for n in range(len(states)):
        load(plan, pointer(states[n]), here, s, c)
        if anew:
            for i in range(parts):
                here[FIRST + i] = points[n, i]
            flow.place(plan, here)
        owner, k = -1, 0
        outcome = TOO_MUCH_WORK if slow else NOT_SETTLED
        while not slow:
            if progress[1] != 0:
                outcome = STOPPED
                break
            for i in range(len(traps)):
                if holds(traps[i], here, parts):
                    owner = int(traps[i, OWNER])
                    break
            if owner < 0 and len(cells):
                column = math.floor((here[FIRST] - grid[LOW_U]) / grid[STEP_U])
                row = math.floor((here[velocity] - grid[LOW_V]) / grid[STEP_V])
                if 0 <= row < cells.shape[0] and 0 <= column < cells.shape[1]:
                    owner = cells[row, column]
            if owner >= 0:
                outcome = DONE
                break
            if k >= max_cycles:
                break
            _, outcome = advance(plan, here, section, s, c, period, max_events)
            k += 1
            if outcome != DONE:
                break
            outcome = NOT_SETTLED
        copy(here, pointer(states[n]), width(plan))
        results[n, CAUGHT], results[n, CYCLES], results[n, OUTCOME] = owner, k, outcome
        progress[0] += 1
