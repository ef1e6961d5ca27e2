"""A motion followed through its sections and measured: its phases, or its Fourier integrals."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.observers.fourier import BEGINS
from vibroimpact.engine.observers.phases import (
    MASSES,
    NUMBER,
    WIDTH,
    WRITTEN,
    begin_row,
    full,
    keep,
    put_back,
)
from vibroimpact.engine.sections import FULL, C, Leg, S, Schedule, loop
from vibroimpact.engine.state import copy, load, put, room, width


class Log(NamedTuple):
    """What is noted of phases, see `observers.phases`."""

    notes: Vector
    rows: Vector


@kernel
def _measured(plan: Vector, state: Vector, section: Vector, leg: Leg, log: Log) -> int:
    """Measure a leg, or nothing of it."""
    number, s, c, length, max_events = leg
    notes, rows = log.notes, log.rows
    if full(notes):
        return FULL
    written = notes[WRITTEN]
    notes[NUMBER] = number
    keep(notes, rows)
    events: int = event_loop.phases(plan, state, s, c, length, max_events, notes, rows)
    if full(notes):
        put_back(notes, rows, written)
        put(plan, section, state)
        return FULL
    if events > max_events:
        put_back(notes, rows, written)
    return events


class Integrals(NamedTuple):
    """What is noted for a spectrum, see `observers.fourier`."""

    notes: Vector
    interval: float
    """Between sections (s)."""
    lines: Vector
    out: Vector


@kernel
def _integrated(plan: Vector, state: Vector, section: Vector, leg: Leg, found: Integrals) -> int:
    number, s, c, length, max_events = leg
    found.notes[BEGINS] = number * found.interval
    events: int = event_loop.integrate(
        plan, state, s, c, length, max_events, found.notes, found.lines, found.out
    )
    return events


_follow_measured = loop(_measured)
_follow_integrated = loop(_integrated)


@kernel
def _scheduled(phase: float, sections: Vector, count: int, changes: int) -> Schedule:
    """The schedule of a table; the clock of a periodic forcing is that of a phase."""
    if not changes:
        sections[S], sections[C] = math.sin(phase), math.cos(phase)
    return Schedule(sections, count, changes != 0)


@entry(
    "UniTuple(i8, 2)(f8[::1], f8, f8, f8, f8[:, ::1], i8, f8[::1], i8, f8, i8, f8[::1],"
    " f8[:, ::1])",
    "measured",
)
def measure_motion(
    given: Any,
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
    rows: Vector,
) -> tuple[int, int]:
    """Follow a motion and measure its phases, until the end or until `rows` may overflow.

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
    state : ndarray, shape (motion.STATE,)
        Where the motion starts; carried on in place.
    first, last : int, float
        As in `sections.loop`.
    max_events : int
        Events after a section at which the motion is given up.
    notes : ndarray, shape (observers.phases.NOTES,)
        Kept between calls.
    rows : ndarray, shape (capacity, observers.phases.Layout.width)
        The phases: the one that goes on is in the row behind those that are complete.

    Returns
    -------
    next, outcome
        The section to go on with, and a `Status`.
    """
    plan = planned(given, rig)
    flow.build(plan, amplitude, omega)
    here, log = room(), Log(pointer(notes), pointer(rows))
    load(plan, pointer(state), here, 0.0, 0.0)
    if first == 0 and notes[WRITTEN] == 0.0:
        begin_row(log.rows, int(notes[MASSES]), int(notes[WIDTH]))
    schedule = _scheduled(phase, pointer(sections), len(sections), changes)
    found = _follow_measured(plan, here, schedule, first, last, max_events, log, None)
    copy(here, pointer(state), width(plan))
    return found


@entry(
    "UniTuple(i8, 2)(f8[::1], f8, f8, f8, f8[:, ::1], i8, f8[::1], i8, f8, i8, f8[::1], f8,"
    " f8[::1], f8[:, ::1])",
    "measured",
)
def integrate_motion(
    given: Any,
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
    interval: float,
    lines: Vector,
    out: Vector,
) -> tuple[int, int]:
    """Follow a motion and integrate it times exp(−iνt).

    Parameters
    ----------
    notes : ndarray, shape (2,)
        See `observers.fourier`.
    interval : float
        Between sections (s).
    lines : ndarray, shape (line,)
        ν in rad/s, rising.
    out : ndarray, shape (fourier.QUANTITIES, line)
        Added to.
    rig, amplitude, omega, phase, sections, changes, state, first, last, max_events
        As in `measure_motion`, and what is returned, too.
    """
    plan = planned(given, rig)
    flow.build(plan, amplitude, omega)
    here = room()
    load(plan, pointer(state), here, 0.0, 0.0)
    found = Integrals(pointer(notes), interval, pointer(lines), pointer(out))
    schedule = _scheduled(phase, pointer(sections), len(sections), changes)
    ended = _follow_integrated(plan, here, schedule, first, last, max_events, found, None)
    copy(here, pointer(state), width(plan))
    return ended
