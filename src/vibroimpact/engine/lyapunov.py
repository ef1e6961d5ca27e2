"""Growth of disturbances: over an orbit (monodromy matrix) and on average (Lyapunov exponents)."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import beyond, pointer
from vibroimpact.engine.observers import growth as observers
from vibroimpact.engine.opening import open_entry
from vibroimpact.engine.section_map import start_notes
from vibroimpact.engine.state import (
    DAMPING,
    MODE,
    copy,
    finite,
    notes_buffer,
    parts_buffer,
    put,
    state_buffer,
    width,
)
from vibroimpact.engine.status import DONE, NOT_FINITE, TOO_MANY_EVENTS

# Columns of what one cycle shows: logarithms of the growth of two disturbances, the integral of
# the damping, and the state at the section behind the cycle.
FIRST, SECOND, DISSIPATION, SECTION = range(4)
GROWTH = SECTION + 5

_carried = event_loop.observed(observers.grow)


@entry(
    "UniTuple(i8, 2)"
    "(f8[::1], f8, f8, f8, f8[::1], f8[:, ::1], boolean, i8, i8, i8, i8, f8[:, ::1])",
    "disturbed",
)
def growth(
    memory: Any,
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
    """Follow a motion and the growth of its fastest disturbances, cycle by cycle.

    Many short calls give the same rows as a long one, to the last bit.

    Parameters
    ----------
    rig, amplitude, frequency, phase, state, max_events
        As in `batch.trajectory`; the state is carried on.
    disturbances : ndarray, shape (part, part)
        Orthonormal rows, carried on in place.
    anew : bool
        Whether the disturbances begin here, so that what they hold is not used.
    first, last : int
        Cycle to begin with, and that before which the call ends. Of cycles below 0 no row is
        written.
    discard : int
        Cycles before cycle 0 in which the disturbances turn into their directions. Before those
        nothing is watched.
    out : ndarray, shape (row, count + 1 + part)
        Written, a row a cycle from cycle `first`, or from cycle 0: the logarithm of how much each
        of `count` disturbances has grown beside those before it (NaN: see `growth.grow`), the
        integral of the damping, and the state as a point of the section. A state has as many
        exponents as parts.

    Returns
    -------
    outcome, next
        A `Status`, and the cycle to go on with.
    """
    here, section, notes = state_buffer(), state_buffer(), notes_buffer()
    at = pointer(state)
    plan, s, c, period, outcome = open_entry(memory, rig, amplitude, frequency, phase, at, here)
    parts = flow.parts(plan)
    count = out.shape[1] - 1 - parts
    weights, of_section, logarithms = parts_buffer(), parts_buffer(), parts_buffer()
    q, work = pointer(disturbances), observers.work_buffer()
    observers.weigh(plan, weights)
    rows = observers.rows_of(plan, q, work, weights, logarithms, count)
    mode = here[MODE]
    observers.weigh_section(plan, here, of_section)
    at_section = observers.rows_of(plan, q, work, of_section, logarithms, count)
    if anew:
        for i in range(parts * parts):
            q[i] = 0.0
        observers.begin_rows(plan, here, at_section, 0, count)
    number = first
    while outcome == DONE and number < last:
        # A cycle that is given up leaves the state of its section.
        put(plan, here, section)
        if number < -discard:
            events = flow.cycle(plan, here, s, c, period, max_events)
        else:
            start_notes(plan, notes)
            for i in range(count):
                logarithms[i] = 0.0
            events = _carried(plan, here, s, c, period, max_events, notes, rows)
            if here[MODE] != mode:
                mode = here[MODE]
                observers.weigh_section(plan, here, of_section)
            observers.orthonormalise(at_section, 0.0, 0.0)
            observers.add_up(plan, here, at_section)
            if number >= 0 and events <= max_events:
                row = pointer(out[number - max(first, 0)])
                copy(logarithms, row, count)
                row[count] = notes[DAMPING]
                flow.point(plan, here, beyond(row, count + 1))
        if events > max_events:
            outcome = TOO_MANY_EVENTS
        elif not finite(plan, here):
            outcome = NOT_FINITE
        if outcome != DONE:
            put(plan, section, here)
            break
        number += 1
    copy(here, at, width(plan))
    return outcome, number


@entry("i8(f8[::1], f8, f8, f8, f8[::1], i8, i8, f8[:, ::1], f8[::1])", "disturbed")
def monodromy(
    memory: Any,
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
    here, notes = state_buffer(), notes_buffer()
    at, q = pointer(state), pointer(columns)
    plan, s, c, period, outcome = open_entry(memory, rig, amplitude, frequency, phase, at, here)
    flow.unit_disturbances(plan, here, q)
    damping[0] = 0.0
    done = 0
    while outcome == DONE and done < cycles:
        start_notes(plan, notes)
        events = event_loop.tangent(plan, here, s, c, period, max_events, notes, q)
        damping[0] += notes[DAMPING]
        done += 1
        if events > max_events:
            outcome = TOO_MANY_EVENTS
        elif not finite(plan, here):
            outcome = NOT_FINITE
    copy(here, at, width(plan))
    return outcome  # type: ignore[no-any-return]
