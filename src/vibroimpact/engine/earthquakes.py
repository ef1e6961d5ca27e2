"""The demand of records on a rig: its peaks at many scales of one record, without its history.

Each record is followed line by line (`sections`), and the base stands still after it.
Nothing is allocated: a call is as good for one scale as for many.
"""

from __future__ import annotations

import math
from typing import Any

from numpy.typing import NDArray

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.one_mass.extremes import U_LEAST, U_MOST, notes_buffer
from vibroimpact.engine.sections import LASTS, C, S, Schedule, observed, row_buffer
from vibroimpact.engine.state import FIRST, load, state_buffer
from vibroimpact.engine.status import DONE, STOPPED, TOO_MUCH_WORK

# What is found of a run: the notes of `flow.demand`, then where one mass comes to rest, half the
# width of its last swing about that place (m), and how the run ended, a `Status`.
REST, SWING, OUTCOME = range(-3, 0)
BEHIND = 3

_SHORT = 1e-9
"""Share of a step that is none."""
_REPORTED = 64
"""Lines of the record after which it is reported how many are done."""
_SAME = 1e-9
"""Relative change of the swing from block to block below which it does not die out."""


follow = observed(event_loop.demand)


@kernel
def _shaken(
    plan: Vector,
    state: Vector,
    lines: Vector,
    count: int,
    max_events: int,
    notes: Vector,
    counter: NDArray[Any],
) -> int:
    """Along the record's lines; a `Status`."""
    begun = counter[0]
    record = Schedule(lines, count, True)
    number, outcome = 0, DONE
    while number < count and outcome == DONE:
        counter[0] = begun + number
        last = min(float(number + _REPORTED), float(count))
        number, outcome = follow(plan, state, record, number, last, max_events, notes, counter)
    return outcome


def _free(follow: Any) -> Any:
    """Make the free motion while the base stands still, of a loop over sections."""

    def freely(
        plan: Vector,
        state: Vector,
        step: float,
        length: float,
        max_events: int,
        notes: Vector,
        counter: NDArray[Any],
    ) -> int:
        row = row_buffer()
        row[S], row[C], row[LASTS] = 0.0, 0.0, step
        still = Schedule(row, 1, True)
        whole = int(length / step)
        rest = length - whole * step
        last = float(whole)
        _, outcome = follow(plan, state, still, 0, last, max_events, notes, counter)
        if outcome == DONE and rest > _SHORT * step:
            row[LASTS] = rest
            _, outcome = follow(plan, state, still, 0, 1.0, max_events, notes, counter)
        return int(outcome)

    return kernel(freely)


_freely = _free(follow)
_swing_freely = _free(observed(event_loop.extremes))


@kernel
def _settled(
    plan: Vector,
    state: Vector,
    step: float,
    block: float,
    blocks: int,
    small: float,
    max_events: int,
    counter: NDArray[Any],
) -> tuple[int, float, float]:
    """Where the free motion of one mass comes to rest, and half the width of its last swing.

    It is followed block by block until it swings by less than `small`, or by no less than before:
    what nothing damps goes on round the place where it would rest.
    """
    outcome = DONE
    notes = notes_buffer()
    middle, swing = state[FIRST], math.inf
    for _ in range(blocks):
        flow.nothing(plan, notes)
        outcome = _swing_freely(plan, state, step, block, max_events, notes, counter)
        if outcome != DONE:
            break
        last = swing
        swing = 0.5 * (notes[U_MOST] - notes[U_LEAST])
        middle = 0.5 * (notes[U_MOST] + notes[U_LEAST])
        if swing <= small or abs(last - swing) <= _SAME * swing:
            break
    return outcome, middle, swing


@entry(
    "void(f8[::1], f8[::1], f8, f8[::1], f8, f8[::1], i8, i8, f8, i8, f8, i8[::1], f8[:, ::1],"
    " f8[:, ::1])",
    "measured",
)
def respond(
    memory: Any,
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
    lines: Vector,
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
        How long the motion is followed after it (s).
    state : ndarray, shape (`state.width`,)
        Where the motion starts.
    max_events : int
        Events in one line at which the motion is given up.
    everything : int
        Whether energies are found, which takes several times as long.
    block, blocks, small : float, int, float
        Behind the tail the mass is followed by so many blocks at most, each so long (s), until it
        swings by less than the share `small` of its extremes; with no blocks it is not asked where
        it rests; several masses are not.
    counter : ndarray
        [0] counts the lines of the record that are done, once for each scale; not 0 in [1] stops.
    lines : ndarray, shape (len(record) - 1, sections.ROW)
        Room for the record's lines at one scale.
    out : ndarray, shape (scale, notes of `flow.demand` + BEHIND)
        Written. What is known of a run that was given up is not kept.
    """
    before, count = counter[0], len(lines)
    here, known = state_buffer(), out.shape[1] - BEHIND
    for k in range(len(scales)):
        row = out[k]
        notes = pointer(row)
        for i in range(len(row)):
            row[i] = math.nan
        if counter[1] != 0:
            row[known + 2] = STOPPED
            continue
        scale = scales[k]
        plan = planned(memory, rig)
        most, steepest = abs(scale * record[0]), 0.0
        for i in range(count):
            begins, ends = scale * record[i], scale * record[i + 1]
            lines[i, S], lines[i, C], lines[i, LASTS] = begins, (ends - begins) / step, step
            most = max(most, abs(ends))
            steepest = max(steepest, abs(lines[i, C]))
        flow.build(plan, most, steepest / most if most > 0.0 else 0.0)
        if flow.too_much_work(plan, step) != 0:
            row[known + 2] = TOO_MUCH_WORK
            counter[0] = before + (k + 1) * count
            continue
        load(plan, pointer(state), here, 0.0, 0.0)
        flow.start_demand(plan, notes, everything)
        outcome = _shaken(plan, here, pointer(lines), count, max_events, notes, counter)
        if outcome == DONE:
            outcome = _freely(plan, here, step, tail, max_events, notes, counter)
        middle, swing = math.nan, math.nan
        if outcome == DONE and blocks > 0:
            size = small * max(notes[U_MOST], -notes[U_LEAST])
            outcome, middle, swing = _settled(
                plan, here, step, block, blocks, size, max_events, counter
            )
        if outcome == DONE:
            row[known], row[known + 1] = middle, swing
        else:
            for i in range(len(row)):
                row[i] = math.nan
        row[known + 2] = outcome
        counter[0] = before + (k + 1) * count
