"""One held frequency: wait until the motion has settled, then measure it.

Free flight that nothing can disturb any more is known at once (`linear.contact_free`). Any other
motion of one cycle is pursued (`pursuit`); what is not found so is followed until it has
settled. Settled means that the stroboscopic state repeats after n ≤ LONGEST cycles. The distance
d_n(k) = ‖s_k − s_(k−n)‖ shrinks geometrically on the way to a stable orbit; from its decay over
two blocks of cycles follows what is still missing, d_n ρⁿ / (1 − ρⁿ), and that must be below
the tolerance (docs/decisions/0004-sweep-convergence.md).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine import parameters as par
from vibroimpact.engine.chaos_indicator import runs_away
from vibroimpact.engine.extrapolation import pursue
from vibroimpact.engine.fixed_point import DYING
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import beyond, stack
from vibroimpact.engine.observers.extremes import notes_room, nothing
from vibroimpact.engine.state import (
    FIRST,
    LARGEST,
    begin_again,
    copy,
    distance,
    finite,
    parts_room,
    put,
    room,
    wind,
)
from vibroimpact.engine.status import (
    DONE,
    NOT_FINITE,
    NOT_SETTLED,
    STOPPED,
    TOO_MANY_EVENTS,
    TOO_MUCH_WORK,
)

LONGEST = 16
"""Longest period, in forcing cycles, that is recognised."""

_BLOCK = 8
_STALLED_CYCLES = 96
_ROUNDING = 4e-15
_STALLED = 1e-11
_SAME = 1e-8  # states closer than this are one point of the section when counting a period
_SOON = 24.0
"""Cycles in which most motions have settled: none is asked sooner whether it is chaotic."""
_SAFETY = 4.0  # on the estimated distance
_TOLD = 256
"""Cycles after which it is counted how many are done."""
_PATIENCE = 50  # times max_cycles, for a motion that keeps closing in
_CLOSING = 1e-3  # closer than this share of its size, a motion may be closing in
_RECENT = 0.2  # share of the cycles so far in which it must have come twice as close

PATIENT = math.inf
"""As a transient: all motions are waited for."""

# What a hold writes.
U_LEAST, U_MOST, A_LEAST, A_MOST, HITS_RIGHT, HITS_LEFT, PERIOD, CYCLES, OUTCOME = range(9)
FORCE_RIGHT, FORCE_LEFT, IMPULSE_RIGHT, IMPULSE_LEFT, T_LEAST, T_MOST = range(9, 15)
RESULTS = 15

past_memory = stack(LONGEST * (FIRST + LARGEST))
distances = stack(LONGEST + 1)


@kernel
def follow(
    plan: Vector,
    state: Vector,
    s: float,
    c: float,
    period: float,
    cycles: int,
    max_events: int,
    progress: Any,
    notes: Vector,
) -> tuple[int, int]:
    """Follow `cycles` forcing cycles and note their extremes: the outcome, how many were followed.

    It stops when [1] of `progress` becomes nonzero; None if it cannot take long.
    """
    section = room()
    outcome = DONE
    done = 0
    while done < cycles and outcome == DONE:
        put(plan, state, section)
        events = event_loop.extremes(plan, state, s, c, period, max_events, notes)
        if events > max_events:  # a cycle that is given up leaves the state of its section
            outcome = TOO_MANY_EVENTS
            put(plan, section, state)
        elif not finite(plan, state):
            outcome = NOT_FINITE
        done += 1
        if progress is not None:  # noqa: SIM102 - the compiler leaves out what None makes needless
            if progress[1] != 0:
                outcome = STOPPED
    return outcome, done


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

    Forces and impulses are those per unit mass. `progress` as in `follow`.
    """
    start, notes, carried = room(), notes_room(), notes_room()
    nothing(notes)
    put(plan, state, start)
    outcome, done = follow(plan, state, s, c, period, cycles, max_events, progress, notes)
    copy(notes, carried, 4)
    if plan[par.BASE] == 0.0:
        # The force on the base is that of ü + A_t, A_t what stands for the force on the mass: the
        # absolute acceleration of the same motion if the base moved.
        plan[par.BASE] = 1.0
        nothing(carried)
        outcome, _ = follow(plan, start, s, c, period, done, max_events, progress, carried)
        plan[par.BASE] = 0.0
    result[T_LEAST], result[T_MOST] = plan[par.LOAD] - carried[3], plan[par.LOAD] - carried[2]
    result[U_LEAST], result[U_MOST] = notes[0], notes[1]
    result[A_LEAST], result[A_MOST] = notes[2], notes[3]
    result[HITS_RIGHT], result[HITS_LEFT] = notes[4] / done, notes[5] / done
    result[FORCE_RIGHT], result[FORCE_LEFT] = notes[6], notes[7]
    result[IMPULSE_RIGHT], result[IMPULSE_LEFT] = notes[8], notes[9]
    return outcome


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
    units, section = parts_room(), room()
    flow.units(plan, units)
    wide = FIRST + flow.parts(plan)
    asked = max(transient / period, _SOON)
    found, plain, gone = pursue(
        plan, state, s, c, period, units, tolerance, max_cycles, max_events, asked
    )
    if found:
        return DONE, 1, gone
    if plain:
        return NOT_SETTLED, 0, gone
    past = past_memory()
    block, former = distances(), distances()
    recent, earlier = distances(), distances()  # ratios of successive blocks
    for i in range(LONGEST + 1):
        block[i], former[i], recent[i], earlier[i] = 0.0, math.inf, math.inf, math.inf
    best = math.inf
    stalled = 0
    scale = 0.0
    size = 0.0  # of the state, in this block and in the one before
    former_size = 0.0
    k = 0
    n = 0
    outcome = NOT_SETTLED
    if gone > asked:
        asked = PATIENT
    while gone + k < max_cycles or (
        _STALLED_CYCLES <= k < _PATIENCE * max_cycles
        and stalled * _BLOCK < _RECENT * k
        and best <= _CLOSING * scale
    ):
        if k % _BLOCK == 0 and progress[1] != 0:
            outcome = STOPPED
            break
        if k % _TOLD == 0 and len(progress) > 2:
            progress[2] = gone + k
        if k % _BLOCK == 0 and gone + k >= asked:
            asked = PATIENT
            plain, beside = runs_away(plan, state, s, c, period, units, max_events)
            gone += beside
            if plain:
                break
        copy(state, beyond(past, wide * (k % LONGEST)), wide)
        put(plan, state, section)
        events = flow.cycle(plan, state, s, c, period, max_events)
        k += 1
        if events > max_events:
            outcome = TOO_MANY_EVENTS
            put(plan, section, state)
            break
        if not finite(plan, state):
            outcome = NOT_FINITE
            break
        size = max(size, flow.size(plan, state))
        scale = max(size, former_size)
        # Longer periods are looked for only where the simplest has not come soon.
        longest = 1 if k <= 4 * _BLOCK else LONGEST
        for i in range(1, longest + 1):
            d = distance(plan, state, beyond(past, wide * ((k - i) % LONGEST)), units)
            block[i] = max(block[i], d)
        if k % _BLOCK:
            continue
        for i in range(1, longest + 1):
            # ρ to the power of i, from the slowest of three successive blocks: on a rotating
            # approach a single ratio may be small by luck.
            slowest = max(block[i] / former[i], recent[i], earlier[i])
            if not former[i] < math.inf:
                slowest = math.inf
            share = slowest ** (i / _BLOCK) if slowest < 1.0 else 1.0
            small = block[i] <= _ROUNDING * scale
            if small or (
                share < 1.0 and _SAFETY * block[i] * share <= tolerance * scale * (1.0 - share)
            ):
                n = i
                break
        if n:
            # A slowly alternating approach closes on 2 before 1: take the least that fits now.
            for i in range(1, n):
                d = distance(plan, state, beyond(past, wide * ((k - i) % LONGEST)), units)
                if n % i == 0 and d <= _SAME * scale:
                    n = i
                    break
            outcome = DONE
            break
        # Rounding may keep a stiff rig from coming closer: accept where it has stalled.
        least = math.inf
        close = 0
        for i in range(1, longest + 1):
            if block[i] < least:
                least = block[i]
                close = i
        if least < 0.5 * best:
            best = least
            stalled = 0
        else:
            stalled += 1
        still = stalled * _BLOCK
        if still >= max(_STALLED_CYCLES, _RECENT * k) and least <= min(
            _STALLED * scale, 4.0 * best
        ):
            for i in range(1, close + 1):
                if block[i] <= 4.0 * least:
                    n = i
                    break
            outcome = DONE
            break
        former_size = size
        size = 0.0
        for i in range(1, LONGEST + 1):
            earlier[i] = recent[i]
            recent[i] = block[i] / former[i] if former[i] < math.inf else math.inf
            former[i] = block[i] if i <= longest else math.inf
            block[i] = 0.0
    return outcome, n, gone + k


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
        See `settle`.
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
