"""A motion under a record: a straight line of base acceleration after the other.

Each line is followed as a forcing cycle is, from its own beginning, so that nothing accumulates.
"""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.observers.record import WRITTEN, note_room, start_notes
from vibroimpact.engine.state import begin_again, copy, finite, load, put, room, width, wind
from vibroimpact.engine.status import NOT_FINITE, TOO_MANY_EVENTS, TOO_MUCH_WORK

# Columns of a line: A_t at its beginning (m/s²), its slope (m/s³) and how long it lasts (s).
BEGINS, SLOPE, LASTS = range(3)
LINE = 3


@entry(
    "UniTuple(i8, 3)(f8[::1], f8, f8, f8[:, ::1], f8[::1], i8, i8, f8, i8, f8[:, ::1], f8[:, ::1])",
    "recorded",
)
def follow(
    given: Any,
    rig: Vector,
    most: float,
    steepest: float,
    lines: Vector,
    state: Vector,
    first: int,
    samples: int,
    interval: float,
    max_events: int,
    out: Vector,
    events: Vector,
) -> tuple[int, int, int]:
    """Follow a motion and write it down, until the end or until `events` may overflow.

    Parameters
    ----------
    rig : ndarray
        From `parameters.rig_vector`, with the record's interval.
    most, steepest : float
        Bounds on |A_t| (m/s²) and on its slope (m/s³).
    lines : ndarray, shape (line, LINE)
        None longer than the interval.
    state : ndarray, shape (motion.STATE,)
        Where the motion starts; carried on in place.
    first : int
        Line to begin with.
    samples : int
        Samples in an interval; 0 for none.
    interval : float
        Between the record's samples (s).
    max_events : int
        Contacts and detachments in one line at which the motion is given up.
    out : ndarray, shape (record.SAMPLE, samples from line 0 to the end, and one for the end)
    events : ndarray, shape (capacity > max_events, record.EVENT)

    Returns
    -------
    next, count, outcome
        The line to go on with, the number of events written, a `Status`.
    """
    plan = planned(given, rig)
    flow.build(plan, most, steepest / most if most > 0.0 else 0.0)
    if flow.too_much_work(plan, interval) != 0:
        return first, 0, TOO_MUCH_WORK
    here, before, notes = room(), room(), note_room()
    load(plan, pointer(state), here, lines[first, BEGINS], lines[first, SLOPE])
    columns = out.shape[1]
    step = interval / samples if samples else 0.0
    listed = samples or len(events) > max_events + 1
    number = first
    count = 0
    outcome = 0
    while number < len(lines) and outcome == 0 and count + max_events < len(events):
        line = lines[number]
        s, c, length = line[BEGINS], line[SLOPE], line[LASTS]
        # The slope changes here: what had died out is a transient again.
        begin_again(plan, here)
        wind(plan, here, s, c)
        put(plan, here, before)
        if samples:
            flow.write(plan, before, pointer(out), columns, number * samples)
        n = int(math.ceil(length / step - 1e-9)) if samples else 0  # noqa: RUF046
        happened = 0
        if n <= 1:  # nothing to be seen on the line unless something happens there
            happened = flow.cycle(plan, here, s, c, length, max_events)
        if n > 1 or (happened and listed):
            put(plan, before, here)
            start_notes(notes, columns, number * samples, step, n, 1, count, max_events, number)
            happened = event_loop.record(
                plan, here, s, c, length, max_events, notes, pointer(out), pointer(events)
            )
            count = int(notes[WRITTEN])
        if happened > max_events:
            outcome = TOO_MANY_EVENTS
            put(plan, before, here)
        elif not finite(plan, here):
            outcome = NOT_FINITE
        number += 1
    if number == len(lines) and samples and outcome == 0:
        flow.write(plan, here, pointer(out), columns, columns - 1)
    copy(here, pointer(state), width(plan))
    return number, count, outcome
