"""The demand of records on a rig: its peaks at many scales of one record, without its history.

Each record is followed line by line, as `recorded.follow` does, and the base stands still after it.
Nothing is allocated: a call is as good for one scale as for many.
"""

from __future__ import annotations

import math
from typing import Any

from numpy.typing import NDArray

from vibroimpact.engine.dispatch import build, too_much_work
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flows import planned
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.loop import cycle
from vibroimpact.engine.motion import Motion, aged, finite, unpacked
from vibroimpact.engine.observers.demand import Demand, unseen
from vibroimpact.engine.status import DONE, NOT_FINITE, STOPPED, TOO_MANY_EVENTS, TOO_MUCH_WORK

# What is found of a run, the observer's numbers first; then where the mass comes to rest, half the
# width of its last swing about that place (m), and how the run ended, a `Status`.
U_LEAST, U_MOST, A_LEAST, A_MOST, FORCE_RIGHT, FORCE_LEFT = range(6)
IMPULSE_RIGHT, IMPULSE_LEFT, HITS_RIGHT, HITS_LEFT, WORK, LOST, LOST_STOPS = range(6, 13)
REST, SWING, OUTCOME = range(13, 16)
FOUND = 16

_SHORT = 1e-9
"""Share of a step that is none."""
_TOLD = 64
"""Lines of the record after which it is counted how many are done."""
_SAME = 1e-9
"""Relative change of the swing from block to block below which it does not die out."""


@kernel
def _outcome(events: int, max_events: int, motion: Motion) -> int:
    if events > max_events:
        return TOO_MANY_EVENTS
    return DONE if finite(motion) else NOT_FINITE


@kernel
def _shaken(
    plan: Vector,
    motion: Motion,
    record: Vector,
    step: float,
    scale: float,
    max_events: int,
    notes: Demand,
    counter: NDArray[Any],
) -> tuple[int, Motion, Demand]:
    """Along the record's lines."""
    outcome = DONE
    done = counter[0]
    for i in range(len(record) - 1):
        if counter[1] != 0:
            return STOPPED, motion, notes
        if i % _TOLD == 0:
            counter[0] = done + i
        begins = scale * record[i]
        clock = (begins, (scale * record[i + 1] - begins) / step)
        # The slope changes here: what had died out is a transient again.
        events, motion, notes = cycle(plan, aged(motion, 0.0), clock, step, max_events, notes)
        outcome = _outcome(events, max_events, motion)
        if outcome != DONE:
            break
    return outcome, motion, notes


@kernel
def _freely(
    plan: Vector,
    motion: Motion,
    step: float,
    length: float,
    max_events: int,
    notes: Demand,
    counter: NDArray[Any],
) -> tuple[int, Motion, Demand]:
    """While the base stands still."""
    outcome = DONE
    whole = int(length / step)
    rest = length - whole * step
    count = whole + (1 if rest > _SHORT * step else 0)
    for i in range(count):
        if counter[1] != 0:
            return STOPPED, motion, notes
        lasts = step if i < whole else rest
        events, motion, notes = cycle(plan, aged(motion, 0.0), (0.0, 0.0), lasts, max_events, notes)
        outcome = _outcome(events, max_events, motion)
        if outcome != DONE:
            break
    return outcome, motion, notes


@kernel
def _settled(
    plan: Vector,
    motion: Motion,
    step: float,
    block: float,
    blocks: int,
    small: float,
    max_events: int,
    counter: NDArray[Any],
) -> tuple[int, float, float]:
    """Where the free motion comes to rest, and half the width of its last swing about it.

    It is followed block by block until it swings by less than `small`, or by no less than before:
    what nothing damps goes on round the place where it would rest.
    """
    outcome = DONE
    middle, swing = motion.u, math.inf
    for _ in range(blocks):
        notes = unseen(0)
        outcome, motion, notes = _freely(plan, motion, step, block, max_events, notes, counter)
        if outcome != DONE:
            break
        last = swing
        swing = 0.5 * (notes.u_most - notes.u_least)
        middle = 0.5 * (notes.u_most + notes.u_least)
        if swing <= small or abs(last - swing) <= _SAME * swing:
            break
    return outcome, middle, swing


@entry("void(f8[::1], f8[::1], f8, f8[::1], f8, f8[::1], i8, i8, f8, i8, f8, i8[::1], f8[:, ::1])")
def respond(
    given: Any,
    rig: Vector,
    record: Vector,
    step: float,
    scales: Vector,
    tail: float,
    state: Vector,
    max_events: int,
    everything: int,
    block: float,
    blocks: int,
    small: float,
    counter: NDArray[Any],
    out: Vector,
) -> None:
    """Find what a record at several scales asks of a rig.

    Parameters
    ----------
    rig : ndarray
        From `parameters.rig_vector`, with the record's interval.
    record, step : ndarray, float
        Base acceleration (m/s²), linear between its samples, and the time between them (s).
    scales : ndarray
        Numbers that the record is multiplied by.
    tail : float
        Duration of free vibration after it (s).
    state : ndarray, shape (motion.STATE,)
        Where the motion starts.
    max_events : int
        Contacts and detachments in one line at which the motion is given up.
    everything : int
        Whether energies are found, which takes several times as long.
    block, blocks, small : float, int, float
        Behind the tail the mass is followed by so many blocks at most, each so long (s), until it
        swings by less than the share `small` of its extremes; with no blocks it is not asked where
        it rests.
    counter : ndarray
        [0] counts the lines of the record that are done, once for each scale; not 0 in [1] stops.
    out : ndarray, shape (scale, FOUND)
        Written. What is known of a run that was given up is not kept.
    """
    before, lines = counter[0], len(record) - 1
    for k in range(len(scales)):
        found = out[k]
        for i in range(FOUND):
            found[i] = math.nan
        if counter[1] != 0:
            found[OUTCOME] = STOPPED
            continue
        scale = scales[k]
        plan = planned(given, rig)
        most, steepest = abs(scale * record[0]), 0.0
        for i in range(len(record) - 1):
            ends = scale * record[i + 1]
            most = max(most, abs(ends))
            steepest = max(steepest, abs((ends - scale * record[i]) / step))
        build(plan, most, steepest / most if most > 0.0 else 0.0)
        if too_much_work(plan, step):
            found[OUTCOME] = TOO_MUCH_WORK
            counter[0] = before + (k + 1) * lines
            continue
        motion = unpacked(state, (0.0, 0.0))
        notes = unseen(everything)
        outcome, motion, notes = _shaken(
            plan, motion, record, step, scale, max_events, notes, counter
        )
        if outcome == DONE:
            outcome, motion, notes = _freely(plan, motion, step, tail, max_events, notes, counter)
        middle, swing = math.nan, math.nan
        if outcome == DONE and blocks > 0:
            size = small * max(notes.u_most, -notes.u_least)
            outcome, middle, swing = _settled(
                plan, motion, step, block, blocks, size, max_events, counter
            )
        if outcome == DONE:
            found[U_LEAST], found[U_MOST] = notes.u_least, notes.u_most
            found[A_LEAST], found[A_MOST] = notes.a_least, notes.a_most
            found[FORCE_RIGHT], found[FORCE_LEFT] = notes.force_right, notes.force_left
            found[IMPULSE_RIGHT], found[IMPULSE_LEFT] = notes.impulse_right, notes.impulse_left
            found[HITS_RIGHT], found[HITS_LEFT] = notes.hits_right, notes.hits_left
            if everything:
                found[WORK], found[LOST] = notes.work, notes.lost
                found[LOST_STOPS] = notes.lost_stops
            found[REST], found[SWING] = middle, swing
        found[OUTCOME] = outcome
        counter[0] = before + (k + 1) * lines
