"""What earthquake engineers ask of a motion: its peaks, the contact forces, and where energy went.

Of a flight only what may exceed the peaks so far is searched: a series is bounded by the sum of its
terms' sizes, and few pieces of a long motion pass that.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import accelerated, begin, displacement, expanded, following, more
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import ORDER
from vibroimpact.engine.linear.stops import rigid
from vibroimpact.engine.measure import (
    A_LEAST,
    A_MOST,
    FORCE,
    IMPULSE,
    LOST,
    LOST_LEFT,
    LOST_RIGHT,
    MEASURES,
    WORK,
    X_LEAST,
    X_MOST,
    measure_phase,
)
from vibroimpact.engine.memory import stack, workspace
from vibroimpact.engine.motion import BOTH, FLIGHT, LEFT, RIGHT, Motion, Stretch
from vibroimpact.engine.observe import observer
from vibroimpact.engine.observers.extremes import series_extremes

_measures = stack(MEASURES)


class Demand(NamedTuple):
    """Extremes of displacement (m) and absolute acceleration (m/s²), and what the stops did.

    Forces, impulses and energies are per unit mass. A force is infinite where a rigid stop was
    struck. Energies are found only if `everything` is not 0.
    """

    u_least: float
    u_most: float
    a_least: float
    a_most: float
    force_right: float
    force_left: float
    impulse_right: float
    impulse_left: float
    hits_right: int
    hits_left: int
    work: float
    lost: float
    """In the isolator."""
    lost_stops: float
    everything: int


note_room = stack(len(Demand._fields))
"""Room for them, between calls."""


@kernel
def start_notes(notes: Vector, everything: int) -> None:
    """Before anything has been seen."""
    for i in range(4, 13):
        notes[i] = 0.0
    notes[0], notes[2] = math.inf, math.inf
    notes[1], notes[3] = -math.inf, -math.inf
    notes[13] = everything


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
    lost: float = rows[LOST_RIGHT] + rows[LOST_LEFT]
    if not before.mode & RIGHT:
        lost += _relaxed(plan, RIGHT, before.right, after.right)
    if not before.mode & LEFT:
        lost += _relaxed(plan, LEFT, before.left, after.left)
    return lost


@kernel
def _unknown(notes: Demand) -> Demand:
    """What is noted of a motion that cannot be measured: the impacts alone."""
    no = math.nan
    right, left = notes.hits_right, notes.hits_left
    return Demand(no, no, no, no, no, no, no, no, right, left, no, no, no, notes.everything)


@observer(Demand)
def demand(plan: Vector, notes: Demand, stretch: Stretch) -> Demand:
    """Add one stretch. One-sided values at both its ends count.

    All is NaN from a stretch on that cannot be measured.
    """
    if math.isnan(notes.u_least):
        return notes
    before, _, event, step, arrival, after = stretch
    u_least, u_most, a_least, a_most = notes.u_least, notes.u_most, notes.a_least, notes.a_most
    force_right, force_left = notes.force_right, notes.force_left
    impulse_right, impulse_left = notes.impulse_right, notes.impulse_left
    work, lost, lost_stops = notes.work, notes.lost, notes.lost_stops
    mode = before.mode
    if mode == FLIGHT and notes.everything == 0:
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
        measure_phase(plan, before, step, side, rows)
        if math.isnan(rows[WORK]):
            return _unknown(notes)
        low, top = displacement(plan, mode, rows[X_LEAST]), displacement(plan, mode, rows[X_MOST])
        u_least, u_most = min(u_least, low, top), max(u_most, low, top)
        a_least, a_most = min(a_least, rows[A_LEAST]), max(a_most, rows[A_MOST])
        if notes.everything:
            work -= rows[WORK]
            lost += rows[LOST]
            lost_stops += _losses(plan, before, after, rows)
        if mode & RIGHT:
            force_right = max(force_right, rows[FORCE])
            impulse_right += rows[IMPULSE]
        if mode == BOTH:
            measure_phase(plan, before, step, LEFT, rows)
        if mode & LEFT:
            force_left = max(force_left, rows[FORCE])
            impulse_left += rows[IMPULSE]
    if event in (RIGHT, LEFT) and rigid(plan, event) and arrival != after.v:
        struck = abs(arrival - after.v)
        lost_stops += 0.5 * (arrival * arrival - after.v * after.v)
        if event == RIGHT:
            force_right = math.inf
            impulse_right += struck
        else:
            force_left = math.inf
            impulse_left += struck
    return Demand(
        u_least,
        u_most,
        a_least,
        a_most,
        force_right,
        force_left,
        impulse_right,
        impulse_left,
        notes.hits_right + (event == RIGHT),
        notes.hits_left + (event == LEFT),
        work,
        lost,
        lost_stops,
        notes.everything,
    )
