"""A motion under a record: a straight line of base acceleration after the other.

Each line is followed as a forcing cycle is, from its own beginning, so that nothing accumulates.
"""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import flow, sections
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.recording import write_down
from vibroimpact.engine.sections import Schedule
from vibroimpact.engine.state import copy, load, state_buffer, width
from vibroimpact.engine.status import TOO_MUCH_WORK

BEGINS, SLOPE, LASTS = sections.S, sections.C, sections.LASTS
"""Columns of a line: A_t at its beginning (m/s²), its slope (m/s³) and how long it lasts (s)."""
LINE = sections.ROW


@entry(
    "UniTuple(i8, 3)(f8[::1], f8, f8, f8[:, ::1], f8[::1], i8, i8, f8, i8, f8[:, ::1], f8[:, ::1])",
    "recorded",
)
def follow(
    memory: Any,
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
    state : ndarray
        Where the motion starts, with the clock; carried on in place.
    first : int
        Line to begin with.
    samples : int
        Samples in an interval; 0 for none.
    interval : float
        Between the record's samples (s).
    max_events : int
        Events in one line at which the motion is given up.
    out : ndarray, shape (record.SAMPLE, samples from line 0 to the end, and one for the end)
    events : ndarray, shape (capacity > max_events, record.EVENT)

    Returns
    -------
    next, count, outcome
        The line to go on with, the number of events written, a `Status`.
    """
    plan = planned(memory, rig)
    flow.build(plan, most, steepest / most if most > 0.0 else 0.0)
    if flow.too_much_work(plan, interval) != 0:
        return first, 0, TOO_MUCH_WORK
    here = state_buffer()
    load(plan, pointer(state), here, 0.0, 0.0)
    summary = write_down(
        plan,
        here,
        Schedule(pointer(lines), len(lines), True),
        first,
        float(len(lines)),
        samples,
        interval,
        max_events,
        True,
        pointer(out),
        out.shape[1],
        pointer(events),
        len(events),
    )
    copy(here, pointer(state), width(plan))
    return summary
