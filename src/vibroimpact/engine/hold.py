"""One held frequency: wait until the motion has settled, then measure it.

Settled means that the stroboscopic state repeats after n ≤ LONGEST cycles. The distance
d_n(k) = ‖s_k − s_(k−n)‖ shrinks geometrically on the way to a stable orbit; from its decay over
two blocks of cycles follows what is still missing, d_n ρⁿ / (1 − ρⁿ), and that must be below
the tolerance (docs/decisions/0004-sweep-convergence.md).
"""

from __future__ import annotations

import math

from vibroimpact.engine.dispatch import build, stiff_rate, too_much_work
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.loop import cycle
from vibroimpact.engine.memory import stack
from vibroimpact.engine.motion import Clock, Motion, aged, finite
from vibroimpact.engine.observe import UNOBSERVED
from vibroimpact.engine.observers.extremes import NOTHING
from vibroimpact.engine.pursuit import (
    PARTS,
    counts,
    disturbed,
    guess,
    guessed,
    hold_on,
    matrix_room,
    parts_of,
    pursuit_room,
    radius,
    size_of,
    trusted,
)
from vibroimpact.engine.status import (
    DONE,
    NOT_FINITE,
    NOT_SETTLED,
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
_SAFETY = 4.0  # on the estimated distance
_PATIENCE = 50  # times max_cycles, for a motion that keeps closing in
_CLOSING = 1e-3  # closer than this share of its size, a motion may be closing in
_RECENT = 0.2  # share of the cycles so far in which it must have come twice as close

_PURSUED = 48  # cycles in which a motion must have come closer to be pursued any longer
_DISTURBED = 1e-6  # of its size, a fixed point that is looked at
_WAITS = 8  # cycles behind a step ahead that was taken back

# What a hold writes.
U_LEAST, U_MOST, A_LEAST, A_MOST, HITS_RIGHT, HITS_LEFT, PERIOD, CYCLES, OUTCOME = range(9)
FORCE_RIGHT, FORCE_LEFT, IMPULSE_RIGHT, IMPULSE_LEFT = range(9, 13)
RESULTS = 13

past_memory = stack(LONGEST * 4)
distances = stack(LONGEST + 1)


@kernel
def measure(
    plan: Vector,
    motion: Motion,
    clock: Clock,
    period: float,
    cycles: int,
    max_events: int,
    result: Vector,
) -> tuple[int, Motion]:
    """Follow `cycles` forcing cycles and write their exact extremes and contact counts.

    Forces and impulses are those per unit mass.
    """
    notes = NOTHING
    outcome = DONE
    done = 0
    while done < cycles and outcome == DONE:
        section = motion
        events, motion, notes = cycle(plan, section, clock, period, max_events, notes)
        if events > max_events:  # a cycle that is given up leaves the state of its section
            outcome = TOO_MANY_EVENTS
            motion = section
        done += 1
    result[U_LEAST], result[U_MOST] = notes.u_least, notes.u_most
    result[A_LEAST], result[A_MOST] = notes.a_least, notes.a_most
    result[HITS_RIGHT], result[HITS_LEFT] = notes.hits_right / done, notes.hits_left / done
    result[FORCE_RIGHT], result[FORCE_LEFT] = notes.force_right, notes.force_left
    result[IMPULSE_RIGHT], result[IMPULSE_LEFT] = notes.impulse_right, notes.impulse_left
    return outcome, motion


@kernel
def pursue(
    plan: Vector,
    motion: Motion,
    clock: Clock,
    period: float,
    weight: float,
    tolerance: float,
    max_cycles: int,
    max_events: int,
) -> tuple[bool, int, Motion]:
    """Follow a motion of one cycle, and go ahead where it is seen where it leads.

    Returns
    -------
    found, cycles, motion
        Whether it was reached to the tolerance; else the motion is one that following gave.
    """
    room = pursuit_room()
    kept = motion  # what following gave, before going ahead
    left = math.inf  # size of the last change then
    alike, former = 0, -1  # cycles with as many events as the one before
    filled = 0  # cycles behind the last fresh start
    ahead = False  # what is followed is not what following gave
    stepped = False  # the cycle before ended with a guess
    last, before = math.inf, math.inf  # the last way, and size of the change before
    scale = 0.0
    waits, k = 0, 0
    most, was_most = 0.0, math.inf  # largest change in this block of cycles, and in the one before
    while k < max_cycles:
        if k % _PURSUED == 0:
            if most > 0.9 * was_most:
                break
            most, was_most = 0.0, most if k else math.inf
        section = motion
        events, motion, _ = cycle(plan, section, clock, period, max_events, UNOBSERVED)
        k += 1
        if events > max_events or not finite(motion):
            return False, k, kept if ahead else section
        alike = alike + 1 if events == former else 0
        former = events
        scale = max(0.5 * scale, weight * abs(motion.u), abs(motion.v))
        hold_on(room, section, motion)
        filled += 1
        change = size_of(room, PARTS, weight)
        most = max(most, change)
        if ahead and (alike == 0 or change > 0.5 * left):
            motion, ahead, stepped, alike, filled, last = kept, False, False, 0, 0, math.inf
            waits = k + _WAITS
            continue
        if stepped and change > 0.5 * before:  # there is more to it than the secants tell
            stepped, filled = False, 1
        before = change
        if alike < 2 or filled < 3:
            stepped = False
            continue
        way, moved, contracts = guess(room, weight)
        if stepped:
            go = way <= 0.5 * last
        elif ahead:
            go = contracts and way <= last
        else:
            go = filled > 3 and k >= waits and trusted(way, moved, contracts, scale)
        stepped = go
        if not go:
            continue
        if not ahead:
            kept, left = motion, change
        ahead, last = True, way
        motion = guessed(plan, room, motion)
        if _SAFETY * way <= tolerance * scale:
            used, stays = attracts(plan, motion, clock, period, weight, scale, max_events)
            return stays, k + used, motion if stays else kept
    return False, k, kept if ahead else motion


@kernel
def attracts(
    plan: Vector,
    motion: Motion,
    clock: Clock,
    period: float,
    weight: float,
    scale: float,
    max_events: int,
) -> tuple[int, bool]:
    """Whether small disturbances of a fixed point die out; and the cycles that it took to see."""
    matrix, other = matrix_room(), matrix_room()
    cycles = 0
    for j in range(PARTS):
        unit = 1.0 if j == 1 else weight
        by = _DISTURBED * scale / unit
        known = counts(plan, motion, j, period)
        after = motion
        if known:
            begun = disturbed(plan, motion, j, by)
            by = parts_of(begun, j) - parts_of(motion, j)
            known = by != 0.0
            if known:
                events, after, _ = cycle(plan, begun, clock, period, max_events, UNOBSERVED)
                cycles += 1
                if events > max_events:
                    return cycles, False
        for i in range(PARTS):
            grown = 0.0
            if known:
                grown = (parts_of(after, i) - parts_of(motion, i)) / by
                grown *= (1.0 if i == 1 else weight) / unit
            matrix[PARTS * i + j] = grown
    return cycles, radius(matrix, other) < 1.0


@kernel
def settle(
    plan: Vector,
    motion: Motion,
    clock: Clock,
    period: float,
    tolerance: float,
    max_cycles: int,
    max_events: int,
) -> tuple[int, int, int, Motion]:
    """Follow the motion until it repeats itself.

    Returns
    -------
    outcome, n, cycles, motion
        `n` is the period in forcing cycles, 0 if the motion did not settle.
    """
    weight = stiff_rate(plan)
    found, k, motion = pursue(
        plan, motion, clock, period, weight, tolerance, max_cycles, max_events
    )
    if found:
        return DONE, 1, k, motion
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
    pursued = k
    n = 0
    outcome = NOT_SETTLED
    while k < max_cycles or (
        _STALLED_CYCLES <= k - pursued < _PATIENCE * max_cycles
        and stalled * _BLOCK < _RECENT * k
        and best <= _CLOSING * scale
    ):
        at = k % LONGEST
        past[at * 4], past[at * 4 + 1] = motion.u, motion.v
        past[at * 4 + 2], past[at * 4 + 3] = motion.right, motion.left
        section = motion
        events, motion, _ = cycle(plan, section, clock, period, max_events, UNOBSERVED)
        u, v, right, left = motion.u, motion.v, motion.right, motion.left
        k += 1
        if events > max_events:
            outcome = TOO_MANY_EVENTS
            motion = section
            break
        if not finite(motion):
            outcome = NOT_FINITE
            break
        size = max(size, weight * abs(u), abs(v))
        scale = max(size, former_size)
        # Longer periods are looked for only where the simplest has not come soon.
        longest = 1 if k - pursued <= 4 * _BLOCK else LONGEST
        for i in range(1, longest + 1):
            q = (k - i) % LONGEST
            d = max(
                weight
                * max(
                    abs(u - past[q * 4]),
                    abs(right - past[q * 4 + 2]),
                    abs(left - past[q * 4 + 3]),
                ),
                abs(v - past[q * 4 + 1]),
            )
            block[i] = max(block[i], d)
        if (k - pursued) % _BLOCK:
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
                q = (k - i) % LONGEST
                d = max(weight * abs(u - past[q * 4]), abs(v - past[q * 4 + 1]))
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
    return outcome, n, k, motion


@kernel
def hold(
    plan: Vector,
    motion: Motion,
    amplitude: float,
    frequency: float,
    clock: Clock,
    options: tuple[float, int, int, int],
    result: Vector,
) -> Motion:
    """Hold one frequency: settle, then measure; return the motion at the end.

    Parameters
    ----------
    plan : ndarray
        The rig's plan, whose tables are rebuilt here.
    motion : Motion
        What is carried on.
    amplitude, frequency : float
        m/s² and Hz.
    clock : Clock
        The forcing at the stroboscopic section.
    options : tuple
        tolerance, max_cycles, window, max_events.
    result : ndarray, shape (RESULTS,)
        Written.
    """
    tolerance, max_cycles, window, max_events = options
    period = 1.0 / frequency
    build(plan, amplitude, 2.0 * math.pi * frequency)
    for i in range(RESULTS):
        result[i] = math.nan
    result[PERIOD], result[CYCLES] = 0, 0
    if too_much_work(plan, period):
        result[OUTCOME] = TOO_MUCH_WORK
        return motion
    motion = aged(motion, 0.0)  # the forcing has changed: what had died out is a transient again
    outcome, n, k, motion = settle(plan, motion, clock, period, tolerance, max_cycles, max_events)
    if outcome in (DONE, NOT_SETTLED):
        over, motion = measure(plan, motion, clock, period, n if n else window, max_events, result)
        k += n if n else window
        if over != DONE:
            outcome = over
            n = 0
            for i in range(RESULTS):
                result[i] = math.nan
    result[PERIOD], result[CYCLES], result[OUTCOME] = n, k, outcome
    return motion
