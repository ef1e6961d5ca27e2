"""What all flows keep of a motion that is written down: the next sample, and the next event.

Rows of the samples and columns of the events are those of the flow (`one_mass.record_layout`,
`assembly.record`).
"""

from __future__ import annotations

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import stack

DETACHMENT, CONTACT_BEGINS, IMPACT = 0.0, 1.0, 2.0
"""What an event at a stop is, of those that are written down."""

# What is kept of a record between calls.
COLUMNS, BEGIN, STEP, COUNT, NEXT, WRITTEN, LAST, NUMBER = range(8)
note_buffer = stack(8)
"""Room for it."""


@kernel
def start_notes(
    notes: Vector,
    columns: int,
    begin: int,
    step: float,
    count: int,
    i: int,
    written: int,
    max_events: int,
    number: int,
) -> None:
    """Begin a cycle, `number`.

    Column `begin` + i of the `columns` of the samples is the next, of `count` in this cycle, `step`
    seconds apart; row `written` of the events is the next.
    """
    notes[COLUMNS], notes[BEGIN], notes[STEP], notes[COUNT] = columns, begin, step, count
    notes[NEXT], notes[WRITTEN], notes[LAST] = i, written, written + max_events
    notes[NUMBER] = number


@kernel
def before_end(i: int, n: int, step: float, end: float) -> int:
    """The first of the samples from i to n that does not come before a time."""
    last = n
    if end < n * step:
        last = max(i, int(end / step))
        while last > i and (last - 1) * step >= end:
            last -= 1
        while last < n and last * step < end:
            last += 1
    return last
