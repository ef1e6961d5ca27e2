"""Where a motion settles: iterate, extrapolate where it pays, and give a verdict.

A motion of one cycle is pursued (`extrapolation`); what is not found so is followed until its state
repeats (`recurrence`), or until it is plainly chaotic (`chaos_indicator`).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import flow
from vibroimpact.engine.chaos_indicator import runs_away
from vibroimpact.engine.extrapolation import extrapolate
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.recurrence import (
    BLOCK,
    closes_in,
    compare,
    recurrence_buffer,
    remember,
    start,
    verdict,
)
from vibroimpact.engine.sections import advance
from vibroimpact.engine.state import parts_buffer, state_buffer
from vibroimpact.engine.status import DONE, NOT_SETTLED, STOPPED

PATIENT = math.inf
"""As a transient: all motions are waited for."""

_SOON = 24.0
"""Cycles in which most motions have settled: none is asked sooner whether it is chaotic."""
_REPORTED = 32 * BLOCK
"""Cycles after which it is reported how many are done."""


@kernel
def settle(
    plan: Vector,
    state: Vector,
    s: float,
    c: float,
    period: float,
    tolerance: float,
    max_cycles: int,
    max_events: int,
    transient: float,
    progress: NDArray[np.int64],
) -> tuple[int, int, int]:
    """Follow the motion until it repeats itself, or is plainly chaotic behind its transient (s).

    It stops when [1] of `progress` becomes nonzero; [2], if there is one, counts the cycles.

    Returns
    -------
    outcome, n, cycles
        `n` is the period in forcing cycles, 0 if the motion did not settle.
    """
    units, section, known = parts_buffer(), state_buffer(), recurrence_buffer()
    flow.units(plan, units)
    asked = max(transient / period, _SOON)
    has_converged, plain, gone = extrapolate(
        plan, state, s, c, period, units, tolerance, max_cycles, max_events, asked
    )
    if has_converged or plain:
        return (DONE, 1, gone) if has_converged else (NOT_SETTLED, 0, gone)
    asked = PATIENT if gone > asked else asked
    start(known)
    k = 0
    while gone + k < max_cycles or closes_in(known, k, max_cycles):
        if k % BLOCK == 0:
            if progress[1] != 0:
                return STOPPED, 0, gone + k
            if k % _REPORTED == 0 and len(progress) > 2:
                progress[2] = gone + k
            if gone + k >= asked:
                asked = PATIENT
                plain, beside = runs_away(plan, state, s, c, period, units, max_events)
                gone += beside
                if plain:
                    break
        remember(plan, state, known, k)
        _, outcome = advance(plan, state, section, s, c, period, max_events)
        k += 1
        if outcome != DONE:
            return outcome, 0, gone + k
        compare(plan, state, known, units, k)
        if k % BLOCK == 0:
            n = verdict(plan, state, known, units, k, tolerance)
            if n:
                return DONE, n, gone + k
    return NOT_SETTLED, 0, gone + k
