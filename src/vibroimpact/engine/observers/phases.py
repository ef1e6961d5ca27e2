"""A motion as its phases: a row of numbers from each event at a stop to the next.

Here rows are begun and ended, for all flows. What a stretch adds to its row is found by the flow
(`flow.measure`): a phase has several stretches where a section, or a branch of a law, divides it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import flow
from vibroimpact.engine.event import at_stop
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.state import EVENT, STEP, T, copy

# Columns of a phase: what ends it (of `record`, or NOTHING) and the number of that stop, when (the
# section's number and the time since it), how long it lasts, which stops are touched (a bit each),
# the work that the shaking takes from the masses, what the links lose, and the range of what all
# forces but the shaking give as an acceleration, of several masses the force on the base (N), and
# the impulse of an impact that ends it.
KIND, AT_STOP, SECTION, SINCE, LENGTH, TOUCHED, WORK, LOST = range(8)
CARRIED_LEAST, CARRIED_MOST, STRUCK = 8, 9, 10
SYSTEM = 11

# Then columns for each mass: ranges of the displacement and of the absolute acceleration, when the
# acceleration is largest (since the phase begins), the velocity at its end, that behind the event
# which ends it, and the largest acceleration there. The times and accelerations of one mass only.
U_LEAST, U_MOST, A_LEAST, A_MOST, A_TIME, ARRIVAL, PARTING, A_EVENT = range(8)
MASS = 8

# And for each stop: the largest force, impulse and depth while it is touched, what it loses
# (touched or not), what it loses in the event that ends the phase, and how fast it is approached at
# the end.
FORCE, IMPULSE, DEPTH, LOSES, HIT, CLOSING = range(6)
STOP = 6

# And for each drift of several masses: its range, and what the dashpot between its ends loses.
D_LEAST, D_MOST, D_LOST = range(3)
DRIFT = 3

NOTHING = -1.0
"""The column KIND of a phase that the motion's end cuts off."""


class Layout(NamedTuple):
    """Where in a row the columns are, of so many masses, stops and drifts."""

    masses: int
    stops: int
    drifts: int = 0

    @property
    def width(self) -> int:
        """Length of a row."""
        return SYSTEM + MASS * self.masses + STOP * self.stops + DRIFT * self.drifts

    def mass(self, column: int, number: int = 0) -> int:
        """Column of a mass."""
        return SYSTEM + MASS * number + column

    def stop(self, column: int, number: int) -> int:
        """Column of a stop."""
        return SYSTEM + MASS * self.masses + STOP * number + column

    def drift(self, column: int, number: int) -> int:
        """Column of a drift."""
        return SYSTEM + MASS * self.masses + STOP * self.stops + DRIFT * number + column


ONE_MASS = Layout(1, 2)
"""The right stop has the number 0, the left one 1."""

# What is kept of the rows between calls: their width, how many are complete, how many there may
# be, and the number of the section.
WIDTH, MASSES, DRIFTS, WRITTEN, CAPACITY, NUMBER = range(6)
NOTES = 6


@kernel
def begin_row(row: Vector, masses: int, drifts: int, width: int) -> None:
    """Begin a phase: nothing has been seen of it."""
    for i in range(width):
        row[i] = 0.0
    row[KIND] = NOTHING
    row[CARRIED_LEAST], row[CARRIED_MOST] = math.inf, -math.inf
    for i in range(masses):
        at = SYSTEM + MASS * i
        row[at + U_LEAST], row[at + U_MOST] = math.inf, -math.inf
        row[at + A_LEAST], row[at + A_MOST] = math.inf, -math.inf
    for i in range(drifts):
        at = width - DRIFT * (drifts - i)
        row[at + D_LEAST], row[at + D_MOST] = math.inf, -math.inf


@kernel
def note(
    plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector, rows: Vector
) -> None:
    """Add a stretch to its phase, and end that if an event at a stop does.

    The last row of the room is that of `save_phase`; in the one before it a phase can only begin.
    """
    at, width = int(notes[WRITTEN]), int(notes[WIDTH])
    if at + 2 >= int(notes[CAPACITY]):
        return
    row = beyond(rows, width * at)
    flow.measure(plan, before, ended, after, row)
    row[LENGTH] += ended[STEP]
    if not at_stop(int(ended[EVENT])):
        return
    row[SECTION], row[SINCE] = notes[NUMBER], ended[T] + ended[STEP]
    notes[WRITTEN] += 1.0
    begin_row(beyond(row, width), int(notes[MASSES]), int(notes[DRIFTS]), width)


@kernel
def full(notes: Vector) -> bool:
    """Whether rows may be missing."""
    return bool(notes[WRITTEN] + 2.0 >= notes[CAPACITY])


@kernel
def save_phase(notes: Vector, rows: Vector) -> None:
    """Keep the phase that goes on, in the last row of the room, until `put_back`."""
    width = int(notes[WIDTH])
    at, spare = width * int(notes[WRITTEN]), width * (int(notes[CAPACITY]) - 1)
    copy(beyond(rows, at), beyond(rows, spare), width)


@kernel
def put_back(notes: Vector, rows: Vector, written: float) -> None:
    """Forget what was added since `save_phase`, when so many phases were complete."""
    notes[WRITTEN] = written
    width = int(notes[WIDTH])
    at, spare = width * int(written), width * (int(notes[CAPACITY]) - 1)
    copy(beyond(rows, spare), beyond(rows, at), width)
