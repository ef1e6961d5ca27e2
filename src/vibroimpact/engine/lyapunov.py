"""Growth of disturbances: over an orbit (monodromy matrix) and on average (Lyapunov exponents)."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import TERMS, beyond, pointer, workspace
from vibroimpact.engine.observers.growth import start_notes
from vibroimpact.engine.section_map import start_notes as noting
from vibroimpact.engine.state import (
    DAMPING,
    copy,
    finite,
    load,
    notes_room,
    parts_room,
    put,
    room,
    width,
)
from vibroimpact.engine.status import DONE, NOT_FINITE, TOO_MANY_EVENTS, TOO_MUCH_WORK

# Columns of what one cycle shows: logarithms of the growth of two disturbances, the integral of
# the damping, and the state at the section behind the cycle.
FIRST, SECOND, DISSIPATION, SECTION = range(4)
GROWTH = SECTION + 5


@entry(
    "UniTuple(i8, 2)"
    "(f8[::1], f8, f8, f8, f8[::1], f8[:, ::1], boolean, i8, i8, i8, i8, f8[:, ::1])",
    "disturbed",
)
def growth(
    given: Any,
    rig: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    state: Vector,
    disturbances: Vector,
    anew: bool,
    first: int,
    last: int,
    discard: int,
    max_events: int,
    out: Vector,
) -> tuple[int, int]:
    """Follow a motion and the growth of its two fastest disturbances, cycle by cycle.

    Many short calls give the same rows as a long one, to the last bit.

    Parameters
    ----------
    rig, amplitude, frequency, phase, state, max_events
        As in `batch.trajectory`; the state is carried on.
    disturbances : ndarray, shape (2, memory.TERMS)
        Carried on in place.
    anew : bool
        Whether the disturbances begin here, so that what they hold is not used.
    first, last : int
        Cycle to begin with, and that before which the call ends. Of cycles below 0 no row is
        written.
    discard : int
        Cycles before cycle 0 in which the disturbances turn into their directions. Before those
        nothing is watched.
    out : ndarray, shape (row, GROWTH)
        Written, a row a cycle from cycle `first`, or from cycle 0.

    Returns
    -------
    outcome, next
        A `Status`, and the cycle to go on with.
    """
    plan = planned(given, rig)
    period = 1.0 / frequency
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    if flow.too_much_work(plan, period) != 0:
        return TOO_MUCH_WORK, first
    s, c = math.sin(phase), math.cos(phase)
    here, section, notes = room(), room(), parts_room()
    load(plan, pointer(state), here, s, c)
    q = workspace()
    w = workspace()
    for i in range(TERMS):
        q[i], w[i] = disturbances[0, i], disturbances[1, i]
    if anew:
        flow.start_growth(plan, here, q, w)
    outcome = DONE
    number = first
    while outcome == DONE and number < last:
        # A cycle that is given up leaves the state of its section.
        put(plan, here, section)
        if number < -discard:
            events = flow.cycle(plan, here, s, c, period, max_events)
        else:
            start_notes(notes, period)
            events = event_loop.growth(plan, here, s, c, period, max_events, notes, q, w)
            if number >= 0 and events <= max_events:
                row = out[number - max(first, 0)]
                row[FIRST] = notes[0]
                # A rest on a wall leaves nothing of either: the difference would be no number.
                row[SECOND] = -math.inf if notes[1] == -math.inf else notes[1] - notes[0]
                row[DISSIPATION] = notes[2]
                flow.point(plan, here, beyond(pointer(row), SECTION))
        if events > max_events:
            outcome = TOO_MANY_EVENTS
        elif not finite(plan, here):
            outcome = NOT_FINITE
        if outcome != DONE:
            put(plan, section, here)
            break
        number += 1
    copy(here, pointer(state), width(plan))
    for i in range(TERMS):
        disturbances[0, i], disturbances[1, i] = q[i], w[i]
    return outcome, number


@entry("i8(f8[::1], f8, f8, f8, f8[::1], i8, i8, f8[:, ::1], f8[::1])", "disturbed")
def monodromy(
    given: Any,
    rig: Vector,
    amplitude: float,
    frequency: float,
    phase: float,
    state: Vector,
    cycles: int,
    max_events: int,
    columns: Vector,
    damping: Vector,
) -> int:
    """Derivative of the state after some cycles with respect to the state now.

    Parameters
    ----------
    columns : ndarray, shape (parts, parts)
        Written: row i is what becomes of a unit disturbance of component i. Where the section
        lies in a contact, the pressed bumper has no disturbance of its own: its row is zero,
        and that of the displacement moves it along.
    damping : ndarray, shape (1,)
        Written: the integral of the damping per unit mass, pressed bumpers included.
    rig, amplitude, frequency, phase, state, max_events
        As in `growth`.

    Returns
    -------
    outcome
        A `Status`.
    """
    plan = planned(given, rig)
    period = 1.0 / frequency
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    outcome = DONE
    if flow.too_much_work(plan, period) != 0:
        outcome = TOO_MUCH_WORK
    s, c = math.sin(phase), math.cos(phase)
    here, notes = room(), notes_room()
    load(plan, pointer(state), here, s, c)
    q = pointer(columns)
    flow.unit_disturbances(plan, here, q)
    damping[0] = 0.0
    done = 0
    while outcome == DONE and done < cycles:
        noting(plan, notes)
        events = event_loop.tangent(plan, here, s, c, period, max_events, notes, q)
        damping[0] += notes[DAMPING]
        done += 1
        if events > max_events:
            outcome = TOO_MANY_EVENTS
        elif not finite(plan, here):
            outcome = NOT_FINITE
    copy(here, pointer(state), width(plan))
    return outcome
