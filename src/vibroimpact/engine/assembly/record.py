"""A motion of several masses written down: samples at equal times, and every event at a stop.

Rows of the samples: displacements, velocities and absolute accelerations of the masses, then
clearances, forces and deformations of the stops.
"""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.advance import load_motion
from vibroimpact.engine.assembly.channels import close_stretch, piece_length, pieces
from vibroimpact.engine.assembly.measures import stops_of
from vibroimpact.engine.assembly.stretches import recorded_kind
from vibroimpact.engine.channels import (
    ABSOLUTE_ACCELERATION,
    CLEARANCE,
    DEFORMATION,
    DISPLACEMENT,
    FORCE,
    VELOCITY,
)
from vibroimpact.engine.event import GIVEN_UP, LIMIT, at_stop, stop_of
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.observers.record import (
    BEGIN,
    COLUMNS,
    COUNT,
    LAST,
    NEXT,
    NUMBER,
    WRITTEN,
    before_end,
)
from vibroimpact.engine.observers.record import STEP as BETWEEN
from vibroimpact.engine.state import EVENT, FIRST, FRESH, STEP, T

E_CYCLE, E_TIME, E_KIND, E_STOP, E_BEFORE, E_BEHIND, E_ORDERED = range(7)
"""Columns of an event: its section, the time since, what happens at which stop (`observers.record`;
CONTACT_BEGINS at a rigid stop is a rest without an impact), the modes before and after it, and
whether a rule ordered it among impacts. Displacements, velocities just before it and just after it
follow."""
E_MASSES = 7

_SAME = 1e-15
"""Share of a section within which what happens is at once, but for rounding."""
_FEW = 64
"""Events at one instant, at most, after which a state is written."""


def samples_of(masses: int, stops: int) -> int:
    """How many rows the samples have."""
    return 3 * (masses + stops)


def event_width(masses: int) -> int:
    """How many columns an event has."""
    return E_MASSES + 3 * masses


def recording(next_stretch: Any, channels: Any) -> tuple[Any, Any]:
    """Make what writes down a stretch of a flow, and what writes one state as a sample."""
    open_stretch, open_piece, value = channels.open_stretch, channels.open_piece, channels.value
    open_instant = channels.open_instant

    def put(plan: Vector, tau: float, samples: Vector, columns: int, k: int) -> None:
        row = k
        for group in range(6):
            channel, many = DISPLACEMENT, int(plan[at.MASSES])
            if group == 1:
                channel = VELOCITY
            elif group == 2:
                channel = ABSOLUTE_ACCELERATION
            elif group > 2:
                channel, many = CLEARANCE, stops_of(plan)
                if group == 4:
                    channel = FORCE
                elif group == 5:
                    channel = DEFORMATION
            for index in range(many):
                # Adding zero leaves no negative one.
                samples[row] = value(plan, channel, index, tau) + 0.0
                row += columns

    sample = kernel(put)

    def write_down(
        plan: Vector,
        before: Vector,
        ended: Vector,
        after: Vector,
        notes: Vector,
        samples: Vector,
        events: Vector,
    ) -> None:
        t, length = ended[T], ended[STEP]
        # What holds at an instant alone is not what holds after it.
        last = int(ended[EVENT]) == LIMIT
        if notes[COUNT] and (last or plan[at.AT_ONCE] == 0.0):
            step = notes[BETWEEN]
            i = int(notes[NEXT])
            reach = t + length - _SAME * notes[COUNT] * step
            if last:
                reach = math.inf
            end = before_end(i, int(notes[COUNT]), step, reach)
            if i < end:
                part, opened = piece_length(plan), -1
                open_stretch(plan)
                while i < end:
                    since = min(max(i * step - t, 0.0), length)
                    piece = min(int(since / part), pieces(plan) - 1) if part > 0.0 else 0
                    while opened < piece:
                        opened += 1
                        open_piece(plan, opened)
                    tau = min(since / part - piece, 1.0) if part > 0.0 else 0.0
                    sample(plan, tau, samples, int(notes[COLUMNS]), int(notes[BEGIN]) + i)
                    i += 1
                close_stretch(plan)
                notes[NEXT] = i
        event = int(plan[at.EVENT])
        if not (at_stop(event) and notes[WRITTEN] < notes[LAST]):
            return
        n = int(plan[at.MASSES])
        row = beyond(events, (E_MASSES + 3 * n) * int(notes[WRITTEN]))
        row[E_CYCLE], row[E_TIME] = notes[NUMBER], t + length
        row[E_KIND], row[E_STOP] = recorded_kind(plan, before[FRESH]), stop_of(event)
        row[E_BEFORE], row[E_BEHIND] = plan[at.STRETCH_MODE], plan[at.MODE]
        row[E_ORDERED] = plan[at.ORDERED] - plan[at.ORDERED_BEFORE]
        for i in range(n):
            row[E_MASSES + i] = plan[int(plan[at.END]) + i]
            row[E_MASSES + n + i] = plan[int(plan[at.END]) + n + i]
            row[E_MASSES + 2 * n + i] = plan[int(plan[at.Y]) + n + i]
        notes[WRITTEN] += 1.0

    def write(plan: Vector, state: Vector, samples: Vector, columns: int, k: int) -> None:
        clock = FIRST + 2 * int(plan[at.MASSES]) + int(plan[at.STOPS]) + 1
        ordered, undecided = plan[at.ORDERED], plan[at.UNDECIDED]
        load_motion(plan, state, state[clock], state[clock + 1])
        if open_instant(plan):
            sample(plan, 0.0, samples, columns, k)
            return
        length = plan[at.INTERVAL] if plan[at.RECORD] != 0.0 else 1.0 / plan[at.STIFF_RATE]
        for _ in range(_FEW):  # what happens at this instant comes first
            next_stretch(plan, length)
            if plan[at.AT_ONCE] == 0.0 or int(plan[at.EVENT]) == GIVEN_UP:
                break
        plan[at.ORDERED], plan[at.UNDECIDED] = ordered, undecided
        open_stretch(plan)
        open_piece(plan, 0)
        sample(plan, 0.0, samples, columns, k)
        close_stretch(plan)

    return kernel(write_down), kernel(write)
