"""What earthquake engineers ask of a motion: its peaks, the contact forces, and where energy went.

Of a flight only what may exceed the peaks so far is searched: a series is bounded by the sum of its
terms' sizes, and few pieces of a long motion pass that.
"""

from __future__ import annotations

import math

from vibroimpact.engine import flow
from vibroimpact.engine.dispatch import accelerated, begin, expanded, following, more
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import ORDER
from vibroimpact.engine.linear.stops import rigid
from vibroimpact.engine.memory import stack, workspace
from vibroimpact.engine.motion import FLIGHT, LEFT, RIGHT, Stretch
from vibroimpact.engine.observers import phases
from vibroimpact.engine.observers.extremes import (
    A_LEAST,
    A_MOST,
    FORCE_LEFT,
    FORCE_RIGHT,
    HITS_LEFT,
    HITS_RIGHT,
    IMPULSE_LEFT,
    IMPULSE_RIGHT,
    NOTES,
    U_LEAST,
    U_MOST,
    nothing,
    series_extremes,
)
from vibroimpact.engine.observers.measure import column

ROW = phases.ONE_MASS.width
_row = stack(ROW)
MASS_U, MASS_A = (phases.ONE_MASS.mass(one) for one in (phases.U_LEAST, phases.A_LEAST))
"""Columns of a row at which the ranges begin."""

# Of the notes: first those of `extremes`, impulses summed up; then, if `EVERYTHING` is not 0, the
# work of the shaking and what is lost in the isolator and in the stops, per unit mass.
WORK, LOST, LOST_STOPS, EVERYTHING = range(NOTES, NOTES + 4)

note_room = stack(NOTES + 4)
"""Room for them."""


@kernel
def start_notes(notes: Vector, everything: int) -> None:
    """Before anything has been seen."""
    nothing(notes)
    for i in range(WORK, EVERYTHING):
        notes[i] = 0.0
    notes[EVERYTHING] = everything


@kernel
def _widened(series: Vector, high: float, least: float, most: float) -> tuple[float, float]:
    """A range widened by a series on [−1/2, high]; not searched where its terms keep within it."""
    reach = 0.0
    power = 0.5
    for n in range(1, ORDER):
        reach += power * abs(series[n])
        power *= 0.5
    if series[0] + reach <= most and series[0] - reach >= least:
        return least, most
    least, most, _, _ = series_extremes(series, -0.5, high, least, most)
    return least, most


@kernel
def add(
    plan: Vector, notes: Vector, before: Vector, ended: Vector, after: Vector, stretch: Stretch
) -> None:
    """Add one stretch between two states. One-sided values at both its ends count."""
    begun, _, event, step, arrival, behind = stretch
    mode = begun.mode
    if mode == FLIGHT and notes[EVERYTHING] == 0.0:
        u_least, u_most = notes[U_LEAST], notes[U_MOST]
        a_least, a_most = notes[A_LEAST], notes[A_MOST]
        series = workspace()
        cursor = begin(plan, begun, step)
        while more(plan, cursor):
            high, s, c = expanded(plan, cursor, series)
            u_least, u_most = _widened(series, high, u_least, u_most)
            unit = accelerated(plan, cursor, s, c, series)
            least, most = _widened(series, high, a_least / unit, a_most / unit)
            a_least, a_most = min(a_least, least * unit), max(a_most, most * unit)
            cursor = following(plan, cursor)
        notes[U_LEAST], notes[U_MOST] = u_least, u_most
        notes[A_LEAST], notes[A_MOST] = a_least, a_most
    else:
        row = _row()
        phases.begin_row(row, 1, ROW)
        flow.measure(plan, before, ended, after, row)
        notes[U_LEAST] = min(notes[U_LEAST], row[MASS_U])
        notes[U_MOST] = max(notes[U_MOST], row[MASS_U + 1])
        notes[A_LEAST] = min(notes[A_LEAST], row[MASS_A])
        notes[A_MOST] = max(notes[A_MOST], row[MASS_A + 1])
        for side in range(1, 3):
            if mode & side:
                force, impulse = FORCE_RIGHT + side - 1, IMPULSE_RIGHT + side - 1
                notes[force] = max(notes[force], row[column(side, phases.FORCE)])
                notes[impulse] += row[column(side, phases.IMPULSE)]
            if notes[EVERYTHING]:
                notes[LOST_STOPS] += row[column(side, phases.LOSES)]
                notes[LOST_STOPS] += row[column(side, phases.HIT)]
        if notes[EVERYTHING]:
            notes[WORK] -= row[phases.WORK]
            notes[LOST] += row[phases.LOST]
    if event not in (RIGHT, LEFT):
        return
    right = event == RIGHT
    notes[HITS_RIGHT if right else HITS_LEFT] += 1.0
    if rigid(plan, event) and arrival != behind.v:
        notes[FORCE_RIGHT if right else FORCE_LEFT] = math.inf
        notes[IMPULSE_RIGHT if right else IMPULSE_LEFT] += abs(arrival - behind.v)
