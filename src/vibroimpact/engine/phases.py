"""A motion followed through its sections and measured: its phases, or its Fourier integrals."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.observers.fourier import BEGINS, INTERVAL, integrate
from vibroimpact.engine.observers.phases import (
    DRIFTS,
    MASSES,
    NUMBER,
    WIDTH,
    WRITTEN,
    begin_row,
    full,
    put_back,
    save_phase,
)
from vibroimpact.engine.sections import FULL, LASTS, C, Leg, S, Schedule, loop
from vibroimpact.engine.state import copy, load, put, state_buffer, width
from vibroimpact.engine.status import TOO_MUCH_WORK


class Log(NamedTuple):
    """What is noted, see `measure_motion`."""

    notes: Vector
    lines: Vector
    out: Vector


@kernel
def _measured(plan: Vector, state: Vector, section: Vector, leg: Leg, log: Log) -> int:
    """Measure a leg, or nothing of it."""
    number, s, c, length, max_events = leg
    notes, _, rows = log
    if full(notes):
        return FULL
    written = notes[WRITTEN]
    notes[NUMBER] = number
    save_phase(notes, rows)
    events: int = event_loop.phases(plan, state, s, c, length, max_events, notes, rows)
    if full(notes):
        put_back(notes, rows, written)
        put(plan, section, state)
        return FULL
    if events > max_events:
        put_back(notes, rows, written)
    return events


@kernel
def _integrated(plan: Vector, state: Vector, section: Vector, leg: Leg, log: Log) -> int:
    number, s, c, length, max_events = leg
    notes, lines, out = log
    notes[BEGINS] = number * notes[INTERVAL]
    events: int = integrate(plan, state, s, c, length, max_events, notes, lines, out)
    return events


_follow_measured = loop(_measured)
_follow_integrated = loop(_integrated)


@entry(
    "UniTuple(i8, 2)(f8[::1], f8, f8, f8, f8[:, ::1], i8, f8[::1], i8, f8, i8, f8[::1], f8[::1],"
    " f8[:, ::1])",
    "measured",
)
def measure_motion(
    memory: Any,
    rig: Vector,
    amplitude: float,
    omega: float,
    phase: float,
    sections: Vector,
    changes: int,
    state: Vector,
    first: int,
    last: float,
    max_events: int,
    notes: Vector,
    lines: Vector,
    out: Vector,
) -> tuple[int, int]:
    """Follow a motion and measure its phases, or integrate it times exp(−iνt).

    It ends early where the rows of phases may overflow.

    Parameters
    ----------
    rig : ndarray
        From `parameters.rig_vector`.
    amplitude, omega : float
        As `flow.build` takes them.
    phase : float
        Of a periodic forcing at its sections (rad).
    sections : ndarray, shape (section, sections.ROW)
        As in `sections.Schedule`.
    changes : int
        Whether the forcing changes at each section; else it is periodic.
    state : ndarray
        Where the motion starts, with the clock; carried on in place.
    first, last : int, float
        As in `sections.loop`.
    max_events : int
        Events after a section at which the motion is given up.
    notes : ndarray
        Kept between calls: of phases, `observers.phases.NOTES`; else `observers.fourier.NOTES`.
    lines : ndarray, shape (line,)
        ν in rad/s, rising; none for phases.
    out : ndarray
        The phases, shape (capacity, observers.phases.Layout.width): the one that goes on is in the
        row behind those that are complete. Else integrals, shape (fourier.QUANTITIES, line), which
        are added to.

    Returns
    -------
    next, outcome
        The section to go on with, and a `Status`.
    """
    plan = planned(memory, rig)
    flow.build(plan, amplitude, omega)
    here, log = state_buffer(), Log(pointer(notes), pointer(lines), pointer(out))
    load(plan, pointer(state), here, 0.0, 0.0)
    schedule = Schedule(pointer(sections), len(sections), changes != 0)
    if flow.too_much_work(plan, schedule.rows[LASTS]) != 0:
        return first, TOO_MUCH_WORK
    if not changes:  # the clock of a periodic forcing is that of a phase
        schedule.rows[S], schedule.rows[C] = math.sin(phase), math.cos(phase)
    if len(lines) > 0:
        ended = _follow_integrated(plan, here, schedule, first, last, max_events, log, None)
    else:
        if first == 0 and notes[WRITTEN] == 0.0:
            begin_row(log.out, int(notes[MASSES]), int(notes[DRIFTS]), int(notes[WIDTH]))
        ended = _follow_measured(plan, here, schedule, first, last, max_events, log, None)
    copy(here, pointer(state), width(plan))
    return ended
