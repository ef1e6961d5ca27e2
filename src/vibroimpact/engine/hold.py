"""One held frequency: wait until the motion has settled, then measure it.

Free flight that nothing can disturb any more is known at once (`linear.contact_free`); any other
motion settles first (`settling`).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine import parameters as par
from vibroimpact.engine.fixed_point import DYING
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.observers.extremes import notes_room, nothing
from vibroimpact.engine.sections import observed, repeated, row_room
from vibroimpact.engine.settling import settle
from vibroimpact.engine.state import begin_again, copy, parts_room, put, room, wind
from vibroimpact.engine.status import DONE, NOT_SETTLED, TOO_MUCH_WORK

# What a hold writes.
U_LEAST, U_MOST, A_LEAST, A_MOST, HITS_RIGHT, HITS_LEFT, PERIOD, CYCLES, OUTCOME = range(9)
FORCE_RIGHT, FORCE_LEFT, IMPULSE_RIGHT, IMPULSE_LEFT, T_LEAST, T_MOST = range(9, 15)
RESULTS = 15


follow = observed(event_loop.extremes)


@kernel
def measure(
    plan: Vector,
    state: Vector,
    s: float,
    c: float,
    period: float,
    cycles: int,
    max_events: int,
    result: Vector,
    progress: Any,
) -> int:
    """Follow `cycles` forcing cycles and write their exact extremes and contact counts.

    Forces and impulses are those per unit mass. `progress` as in `sections.loop`.
    """
    start, notes, carried, row = room(), notes_room(), notes_room(), row_room()
    cycle = repeated(row, s, c, period)
    nothing(notes)
    put(plan, state, start)
    last = float(cycles)
    done, outcome = follow(plan, state, cycle, 0, last, max_events, notes, progress)
    copy(notes, carried, 4)
    if plan[par.BASE] == 0.0:
        # The force on the base is that of ü + A_t, A_t what stands for the force on the mass: the
        # absolute acceleration of the same motion if the base moved.
        plan[par.BASE] = 1.0
        nothing(carried)
        last = float(done)
        _, outcome = follow(plan, start, cycle, 0, last, max_events, carried, progress)
        plan[par.BASE] = 0.0
    result[T_LEAST], result[T_MOST] = plan[par.LOAD] - carried[3], plan[par.LOAD] - carried[2]
    result[U_LEAST], result[U_MOST] = notes[0], notes[1]
    result[A_LEAST], result[A_MOST] = notes[2], notes[3]
    result[HITS_RIGHT], result[HITS_LEFT] = notes[4] / done, notes[5] / done
    result[FORCE_RIGHT], result[FORCE_LEFT] = notes[6], notes[7]
    result[IMPULSE_RIGHT], result[IMPULSE_LEFT] = notes[8], notes[9]
    return outcome


@kernel
def hold(
    plan: Vector,
    state: Vector,
    amplitude: float,
    frequency: float,
    s: float,
    c: float,
    options: tuple[float, int, int, int, float],
    result: Vector,
    progress: NDArray[np.int64],
) -> None:
    """Hold one frequency: settle, then measure; the state is carried to the end.

    Parameters
    ----------
    plan : ndarray
        The rig's plan, whose tables are rebuilt here.
    state : ndarray
        What is carried on.
    amplitude, frequency : float
        m/s² and Hz.
    s, c : float
        The forcing's clock at the stroboscopic section.
    options : tuple
        tolerance, max_cycles, window, max_events, transient.
    result : ndarray, shape (RESULTS,)
        Written.
    progress : ndarray
        See `settling.settle`.
    """
    tolerance, max_cycles, window, max_events, transient = options
    period = 1.0 / frequency
    for i in range(RESULTS):
        result[i] = math.nan
    flow.begin(plan, amplitude, 2.0 * math.pi * frequency)
    wind(plan, state, s, c)
    free = parts_room()
    if flow.undisturbed(plan, state, DYING, free) != 0:
        rest = plan[par.LOAD] / plan[par.STIFFNESS]
        result[U_LEAST], result[U_MOST] = rest - free[0], rest + free[0]
        result[A_LEAST], result[A_MOST] = -free[1], free[1]
        result[T_LEAST], result[T_MOST] = plan[par.LOAD] - free[2], plan[par.LOAD] + free[2]
        for i in (HITS_RIGHT, HITS_LEFT, FORCE_RIGHT, FORCE_LEFT, IMPULSE_RIGHT, IMPULSE_LEFT):
            result[i] = 0.0
        result[PERIOD], result[CYCLES], result[OUTCOME] = 1, 0, DONE
        return
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    result[PERIOD], result[CYCLES] = 0, 0
    if flow.too_much_work(plan, period) != 0:
        result[OUTCOME] = TOO_MUCH_WORK
        return
    begin_again(plan, state)
    outcome, n, k = settle(
        plan, state, s, c, period, tolerance, max_cycles, max_events, transient, progress
    )
    if outcome in (DONE, NOT_SETTLED):
        over = measure(plan, state, s, c, period, n if n else window, max_events, result, progress)
        k += n if n else window
        if over != DONE:
            outcome = over
            n = 0
            for i in range(RESULTS):
                result[i] = math.nan
    result[PERIOD], result[CYCLES], result[OUTCOME] = n, k, outcome
