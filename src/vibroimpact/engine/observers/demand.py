"""What earthquake engineers ask of a motion: its peaks, the contact forces, and where energy went.

Of a flight only what may exceed the peaks so far is searched: a series is bounded by the sum of its
terms' sizes, and few pieces of a long motion pass that.
"""

from __future__ import annotations

import math

from vibroimpact.engine import flow, measure
from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import accelerated, begin, displacement, expanded, following, more
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import ORDER
from vibroimpact.engine.linear.stops import rigid
from vibroimpact.engine.memory import stack, workspace
from vibroimpact.engine.motion import BOTH, FLIGHT, LEFT, RIGHT, Motion, Stretch
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

_measures = stack(measure.MEASURES)


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
def _relaxed(plan: Vector, side: int, before: float, after: float) -> float:
    """What a free bumper loses that relaxes from one deformation to the other."""
    at = par.BUMPER + par.WIDTH * (side - 1)
    if plan[at + par.KIND] != par.KELVIN_VOIGT:
        return 0.0
    stiffness: float = plan[at + par.BUMPER_STIFFNESS]
    return 0.5 * stiffness * (before * before - after * after)


@kernel
def _losses(plan: Vector, before: Motion, after: Motion, rows: Vector) -> float:
    """What the stops lose in a stretch, pressed and relaxing."""
    lost: float = rows[measure.LOST_RIGHT] + rows[measure.LOST_LEFT]
    if not before.mode & RIGHT:
        lost += _relaxed(plan, RIGHT, before.right, after.right)
    if not before.mode & LEFT:
        lost += _relaxed(plan, LEFT, before.left, after.left)
    return lost


@kernel
def _unknown(notes: Vector) -> None:
    """Note that the motion cannot be measured: the impacts alone are known."""
    for i in range(EVERYTHING):
        if i not in (HITS_RIGHT, HITS_LEFT):
            notes[i] = math.nan


@kernel
def add(plan: Vector, notes: Vector, state: Vector, stretch: Stretch) -> None:
    """Add one stretch, which begins with this state. One-sided values at both its ends count.

    All is NaN from a stretch on that cannot be measured.
    """
    if math.isnan(notes[U_LEAST]):
        return
    before, _, event, step, arrival, after = stretch
    u_least, u_most = notes[U_LEAST], notes[U_MOST]
    a_least, a_most = notes[A_LEAST], notes[A_MOST]
    mode = before.mode
    if mode == FLIGHT and notes[EVERYTHING] == 0.0:
        series = workspace()
        cursor = begin(plan, before, step)
        while more(plan, cursor):
            high, s, c = expanded(plan, cursor, series)
            u_least, u_most = _widened(series, high, u_least, u_most)
            unit = accelerated(plan, cursor, s, c, series)
            least, most = _widened(series, high, a_least / unit, a_most / unit)
            a_least, a_most = min(a_least, least * unit), max(a_most, most * unit)
            cursor = following(plan, cursor)
    else:
        rows = _measures()
        side = RIGHT if mode & RIGHT else mode & LEFT
        flow.measure_phase(plan, state, step, side, rows)
        if math.isnan(rows[measure.WORK]):
            _unknown(notes)
            return
        low, top = (
            displacement(plan, mode, rows[measure.X_LEAST]),
            displacement(plan, mode, rows[measure.X_MOST]),
        )
        u_least, u_most = min(u_least, low, top), max(u_most, low, top)
        a_least, a_most = min(a_least, rows[measure.A_LEAST]), max(a_most, rows[measure.A_MOST])
        if notes[EVERYTHING]:
            notes[WORK] -= rows[measure.WORK]
            notes[LOST] += rows[measure.LOST]
            notes[LOST_STOPS] += _losses(plan, before, after, rows)
        if mode & RIGHT:
            notes[FORCE_RIGHT] = max(notes[FORCE_RIGHT], rows[measure.FORCE])
            notes[IMPULSE_RIGHT] += rows[measure.IMPULSE]
        if mode == BOTH:
            flow.measure_phase(plan, state, step, LEFT, rows)
        if mode & LEFT:
            notes[FORCE_LEFT] = max(notes[FORCE_LEFT], rows[measure.FORCE])
            notes[IMPULSE_LEFT] += rows[measure.IMPULSE]
    notes[U_LEAST], notes[U_MOST] = u_least, u_most
    notes[A_LEAST], notes[A_MOST] = a_least, a_most
    if event not in (RIGHT, LEFT):
        return
    right = event == RIGHT
    notes[HITS_RIGHT if right else HITS_LEFT] += 1.0
    if rigid(plan, event) and arrival != after.v:
        notes[LOST_STOPS] += 0.5 * (arrival * arrival - after.v * after.v)
        notes[FORCE_RIGHT if right else FORCE_LEFT] = math.inf
        notes[IMPULSE_RIGHT if right else IMPULSE_LEFT] += abs(arrival - after.v)
