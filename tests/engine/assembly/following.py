"""A motion of several masses followed line by line, through the table of its flow's functions."""

from __future__ import annotations

from typing import Any

import numpy as np

from vibroimpact.engine import flow
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly import record as writing
from vibroimpact.engine.entry import entry
from vibroimpact.engine.event import GIVEN_UP, LIMIT, PASSED, TURN, kind_of, stop_of
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.observers.record import BEGIN, COLUMNS, COUNT, NEXT, note_buffer
from vibroimpact.engine.observers.record import STEP as BETWEEN
from vibroimpact.engine.state import (
    EVENT,
    STEP,
    T,
    load,
    notes_buffer,
    put,
    state_buffer,
    stretch_buffer,
)

_COUNTED = [at.STEPS, at.SPLITS, at.ORDERED, at.UNDECIDED]


@entry(
    "i8(f8[::1], f8, f8, f8[::1], f8[:, ::1], i8, f8[:, ::1], f8[:, ::1], f8[:, ::1], f8[::1], f8)",
    "recorded",
    "disturbed",
)
def follow(
    memory: Any,
    rig: Vector,
    amplitude: float,
    omega: float,
    state: Vector,
    lines: Vector,
    max_events: int,
    log: Vector,
    disturbances: Vector,
    samples: Vector,
    times: Vector,
    tau: float,
) -> int:
    """Follow a motion over sections; see `follow_sections`."""
    plan = planned(memory, rig)
    flow.build(plan, amplitude, omega)
    here, there, ended, notes = state_buffer(), state_buffer(), stretch_buffer(), note_buffer()
    passed = notes_buffer()
    load(plan, pointer(state), here, 0.0, 0.0)
    count, written = 0, 0
    for i in range(8):
        notes[i] = 0.0
    notes[COLUMNS] = samples.shape[1]
    for k in range(len(lines)):
        load(plan, here, there, lines[k, 0], lines[k, 1])
        put(plan, there, here)
        t, events, length = 0.0, 0, lines[k, 2]
        while t < length:
            left = length - t
            event = flow.advance(plan, here, left, ended, there)
            ended[EVENT], ended[T] = event, t
            if event == GIVEN_UP:
                return -1 - k
            if len(disturbances):
                flow.tangent(plan, here, ended, there, passed, pointer(disturbances))
            wanted = samples.shape[1] and written < samples.shape[1] and plan[at.AT_ONCE] == 0.0
            if wanted and ended[STEP] > 0.0:
                notes[BETWEEN] = t + tau * ended[STEP]
                notes[NEXT], notes[COUNT], notes[BEGIN] = 1, 2, written - 1
                times[2 * written], times[2 * written + 1] = k, notes[BETWEEN]
                flow.record(plan, here, ended, there, notes, pointer(samples), pointer(samples))
                written += 1
            t = length if ended[STEP] == left else t + ended[STEP]
            put(plan, there, here)
            if event in (LIMIT, PASSED):
                continue
            events += 1
            if events > max_events:
                return -1 - k
            if kind_of(event) == TURN:
                continue
            if count < len(log):
                log[count, 0], log[count, 1], log[count, 2] = k, t, stop_of(event)
                log[count, 3] = kind_of(event)
            count += 1
    put(plan, here, pointer(state))
    return count


def follow_sections(
    plan: Vector,
    amplitude: float,
    omega: float,
    state: Vector,
    lines: Vector,
    *,
    max_events: int = 10_000,
    log: Vector | None = None,
    disturbances: Vector | None = None,
    samples: Vector | None = None,
    tau: float = 0.5,
) -> int:
    """Follow a motion over sections, in place.

    Parameters
    ----------
    plan
        From `plan.make_plan`; gets what the flow counts.
    state : ndarray
        See `layout`.
    lines : ndarray, shape (section, 3)
        Clock s, c at the beginning of each, and its length (s).
    max_events
        In one section, at which the motion is given up.
    log : ndarray, shape (event, 4)
        Gets of each event its section, the time since this began (s), stop, and what happened
        (`event.CONTACT`, …); what does not fit is dropped.
    disturbances : ndarray, shape (row, 2 n + stops)
        Are carried along; at most as many as they have numbers.
    samples : ndarray, shape (stretch, 2 + 3 n + 3 stops)
        Gets of each stretch its section, a time since this began, and what `assembly.record`
        writes there.
    tau
        Where on a stretch, 0 to 1.

    Returns
    -------
    Number of events, or −1 − the section where the motion was given up.
    """
    none, parts = np.zeros((0, 0)), 2 * int(plan[at.MASSES]) + int(plan[at.STOPS])
    moved = none
    if disturbances is not None:
        moved = np.zeros((parts, parts))
        moved[: len(disturbances)] = disturbances
    most = 0 if samples is None else len(samples)
    stops = int(plan[at.STOPS]) - int(plan[at.LINKS])
    seen = np.full((writing.samples_of(int(plan[at.MASSES]), stops), most), np.nan)
    times = np.full((most, 2), np.nan)
    memory = plan_of(plan, follow.groups)
    count: int = follow.on(
        memory, plan, amplitude, omega, state, lines, max_events, none if log is None else log,
        moved, seen, times.ravel(), tau,
    )  # fmt: skip
    plan[_COUNTED] = memory[_COUNTED]
    if disturbances is not None:
        disturbances[:] = moved[: len(disturbances)]
    if samples is not None:
        samples[:] = np.column_stack([times, seen.T])
    return count


def sections(phase: float, length: float, count: int) -> Vector:
    """Lines of `follow_sections` for harmonic forcing, a cycle each."""
    return np.tile([np.sin(phase), np.cos(phase), length], (count, 1))
