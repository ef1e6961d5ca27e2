"""A motion written down along a schedule: samples at equal times, and its events."""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.observers.record import WRITTEN, note_buffer, start_notes
from vibroimpact.engine.sections import FULL, Leg, Schedule, loop
from vibroimpact.engine.state import put
from vibroimpact.engine.status import DONE


class Book(NamedTuple):
    """Where a motion is written."""

    notes: Vector
    """Of `observers.record`."""
    out: Vector
    """Rows of the samples, `columns` long."""
    columns: int
    events: Vector
    capacity: int
    """Rows that there are for events."""
    samples: int
    """Between two sections; 0 for none."""
    step: float
    """Time between samples (s)."""
    listed: bool
    """Whether the events are asked for."""
    sparse: bool
    """Whether little happens between two sections: they are followed first, and only then written
    down, and the state at a section itself is a sample."""


@kernel
def _write(plan: Vector, state: Vector, section: Vector, leg: Leg, book: Book) -> int:
    """Write a motion down along a leg."""
    number, s, c, length, max_events = leg
    written = int(book.notes[WRITTEN])
    if written + max_events >= book.capacity:
        return FULL
    begin = number * book.samples
    if book.sparse and book.samples:
        flow.write(plan, section, book.out, book.columns, begin)
    n = int(math.ceil(length / book.step - 1e-9)) if book.samples else 0  # noqa: RUF046
    if not book.listed or (book.sparse and n <= 1):
        events = flow.cycle(plan, state, s, c, length, max_events)
        if events == 0 or not book.listed:
            return events
        put(plan, section, state)
    i = 1 if book.sparse else 0
    start_notes(book.notes, book.columns, begin, book.step, n, i, written, max_events, number)
    count: int = event_loop.record(
        plan, state, s, c, length, max_events, book.notes, book.out, book.events
    )
    return count


follow = loop(_write)


@kernel
def write_down(
    plan: Vector,
    state: Vector,
    schedule: Schedule,
    first: int,
    last: float,
    samples: int,
    interval: float,
    max_events: int,
    sparse: bool,
    out: Vector,
    columns: int,
    events: Vector,
    capacity: int,
) -> tuple[int, int, int]:
    """Follow a motion and write it down, until the end or until `events` may overflow.

    The state at the end is the last sample. `samples` of them lie in an `interval` (s).

    Returns
    -------
    next, count, outcome
        The section to go on with, the number of events written, a `Status`.
    """
    notes = note_buffer()
    notes[WRITTEN] = 0.0
    step = interval / samples if samples else 0.0
    listed = samples != 0 or capacity > max_events + 1
    book = Book(notes, out, columns, events, capacity, samples, step, listed, sparse)
    number, outcome = follow(plan, state, schedule, first, last, max_events, book, None)
    if number >= last and samples and outcome == DONE:
        flow.write(plan, state, out, columns, columns - 1)
    return number, int(notes[WRITTEN]), outcome
