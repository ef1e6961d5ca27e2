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
from vibroimpact.engine.fixed_point import DYING
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.one_mass import extremes
from vibroimpact.engine.sections import observed, repeated, row_room
from vibroimpact.engine.settling import settle
from vibroimpact.engine.state import begin_again, measures_room, put, room, wind
from vibroimpact.engine.status import DONE, NOT_SETTLED, TOO_MUCH_WORK

PERIOD, CYCLES, OUTCOME = range(3)
"""Of what a hold writes: the period in forcing cycles, 0 if it did not settle, the cycles used, a
`Status`."""
MEASURED = 3
"""Then what `flow.measured` writes, here of one mass; HITS, FORCE and IMPULSE are those of stop 0,
which those of others follow."""
U_LEAST, U_MOST, A_LEAST, A_MOST, HITS, FORCE, IMPULSE, T_LEAST, T_MOST = (
    MEASURED + i
    for i in (
        extremes.U_LEAST,
        extremes.U_MOST,
        extremes.A_LEAST,
        extremes.A_MOST,
        extremes.HITS,
        extremes.FORCE,
        extremes.IMPULSE,
        extremes.T_LEAST,
        extremes.T_MOST,
    )
)
RESULTS = MEASURED + extremes.MEASURES


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

    `progress` as in `sections.loop`.
    """
    start, row = room(), row_room()
    notes, other = measures_room(), measures_room()
    cycle = repeated(row, s, c, period)
    flow.nothing(plan, notes)
    put(plan, state, start)
    last = float(cycles)
    done, outcome = follow(plan, state, cycle, 0, last, max_events, notes, progress)
    seen = notes
    if flow.look_again(plan, 1) != 0:
        seen = other
        flow.nothing(plan, other)
        last = float(done)
        _, outcome = follow(plan, start, cycle, 0, last, max_events, other, progress)
        flow.look_again(plan, 0)
    flow.measured(plan, notes, seen, done, beyond(result, MEASURED))
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
    result : ndarray, shape (MEASURED and what is measured,)
        Written.
    progress : ndarray
        See `settling.settle`.
    """
    tolerance, max_cycles, window, max_events, transient = options
    period = 1.0 / frequency
    for i in range(len(result)):
        result[i] = math.nan
    flow.begin(plan, amplitude, 2.0 * math.pi * frequency)
    wind(plan, state, s, c)
    free = flow.undisturbed(plan, state, DYING, beyond(result, MEASURED))
    if free == 1:
        result[PERIOD], result[CYCLES], result[OUTCOME] = 1, 0, DONE
        return
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    result[PERIOD], result[CYCLES] = 0, 0
    if flow.too_much_work(plan, period) != 0:
        result[OUTCOME] = TOO_MUCH_WORK
        return
    begin_again(plan, state)
    outcome, n, k = DONE, 1, 0
    if not free:
        outcome, n, k = settle(
            plan, state, s, c, period, tolerance, max_cycles, max_events, transient, progress
        )
    if outcome in (DONE, NOT_SETTLED):
        over = measure(plan, state, s, c, period, n if n else window, max_events, result, progress)
        k += n if n else window
        if over != DONE:
            outcome = over
            n = 0
            for i in range(len(result)):
                result[i] = math.nan
    result[PERIOD], result[CYCLES], result[OUTCOME] = n, k, outcome
