"""A motion from section to section: the loop of all entries that follow one through a schedule.

A schedule is a table with a row for each section: the clock that the forcing has there, and the
time to the next section. After its last row it begins anew: a periodic forcing has a single row, a
record one for each of its straight lines, at which the clock is A_t and its slope.

What is done along each is a function of the loop (`loop`, `observed`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from vibroimpact.engine import flow
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import beyond, stack
from vibroimpact.engine.state import begin_again, finite, put, state_buffer, wind
from vibroimpact.engine.status import DONE, NOT_FINITE, STOPPED, TOO_MANY_EVENTS

S, C, LASTS = range(3)
"""Columns of a schedule."""
ROW = 3

row_buffer = stack(ROW)
"""Room for a schedule of a single row."""

FULL = -1
"""In the place of a number of events: there is no room to note a section, which is not followed."""


class Schedule(NamedTuple):
    """Sections, and how the forcing goes on after each."""

    rows: Vector
    """Their table."""
    size: int
    """How many rows it has."""
    changes: bool
    """Whether the forcing changes at each section: what had died out is a transient again."""


@kernel
def repeated(row: Vector, s: float, c: float, period: float) -> Schedule:
    """The schedule of a periodic forcing, in a room for one row."""
    row[S], row[C], row[LASTS] = s, c, period
    return Schedule(row, 1, False)


class Leg(NamedTuple):
    """What is followed at once."""

    number: int
    """Of its section."""
    s: float
    c: float
    """The clock at its section."""
    length: float
    """To the next section, or to the end of the motion (s)."""
    max_events: int
    """Events at which it is given up."""


@kernel
def advance(
    plan: Vector, state: Vector, section: Vector, s: float, c: float, length: float, max_events: int
) -> tuple[int, int]:
    """Carry a state on from a section, which is kept in `section`: the events, and a `Status`.

    A motion that is given up stays at the section.
    """
    put(plan, state, section)
    events = flow.cycle(plan, state, s, c, length, max_events)
    return events, _ended(plan, state, section, events, max_events)


@kernel
def _ended(plan: Vector, state: Vector, section: Vector, events: int, max_events: int) -> int:
    if events > max_events:
        put(plan, section, state)
        return TOO_MANY_EVENTS
    return DONE if finite(plan, state) else NOT_FINITE


def loop(watch: Any) -> Callable[..., tuple[int, int]]:
    """Make the loop over a kernel `watch(plan, state, section, leg, notes)`.

    It carries the state on along a leg, and returns the number of events, or `FULL`; `section` is a
    copy of the state.
    """

    def follow(
        plan: Vector,
        state: Vector,
        schedule: Schedule,
        first: int,
        last: float,
        max_events: int,
        notes: Any,
        progress: Any,
    ) -> tuple[int, int]:
        section = state_buffer()
        number, outcome = first, DONE
        i = first % schedule.size
        while number < last and outcome == DONE:
            row = beyond(schedule.rows, ROW * i)
            if schedule.changes:
                begin_again(plan, state)
                wind(plan, state, row[S], row[C])
            put(plan, state, section)
            length = min(1.0, last - number) * row[LASTS]
            events = watch(
                plan, state, section, Leg(number, row[S], row[C], length, max_events), notes
            )
            if events == FULL:
                break
            outcome = _ended(plan, state, section, events, max_events)
            number += 1
            i = i + 1 if i + 1 < schedule.size else 0
            if progress is not None:  # noqa: SIM102 - the compiler leaves out what None makes needless
                if progress[1] != 0:
                    outcome = STOPPED
        return number, outcome

    follow.__doc__ = """Follow a motion through sections.

    Parameters
    ----------
    first, last
        Number of the first section, and of that before which it ends; the last may be incomplete.
    max_events
        Events after a section at which the motion is given up.
    notes
        What is noted, passed on.
    progress : ndarray or None
        It stops when [1] becomes nonzero; None if it cannot take long.

    Returns
    -------
    next, outcome
        The section to go on with, and a `Status`.
    """
    return kernel(follow)


def observed(cycle: Any) -> Callable[..., tuple[int, int]]:
    """Make the loop of an observer (`event_loop.observed`) whose notes are one vector."""

    @kernel
    def watch(plan: Vector, state: Vector, section: Vector, leg: Leg, notes: Vector) -> Any:
        _, s, c, length, max_events = leg
        return cycle(plan, state, s, c, length, max_events, notes)

    return loop(watch)
