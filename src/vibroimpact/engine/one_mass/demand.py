"""What engineers ask of an earthquake: peaks, contact forces, and where the energy went.

Of one mass; several have a row of a phase for the whole motion (`assembly.stretches`).
"""

from __future__ import annotations

import math

from vibroimpact.engine import flow
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import stack
from vibroimpact.engine.observers import phases
from vibroimpact.engine.observers.phases import ONE_MASS, begin_row
from vibroimpact.engine.one_mass.extremes import IMPULSE, NOTES, nothing
from vibroimpact.engine.state import FLIGHT, MODE

# Of the notes: first those of `extremes`, impulses summed up; then, if `EVERYTHING` is not 0, the
# work of the shaking and what is lost in the isolator and in the stops, per unit mass.
WORK, LOST, LOST_STOPS, EVERYTHING = range(NOTES, NOTES + 4)

_MASSES, _DRIFTS, _ROW = ONE_MASS.masses, ONE_MASS.drifts, ONE_MASS.width
_row = stack(_ROW)
_PUSHED = tuple(ONE_MASS.stop(phases.IMPULSE, stop) for stop in range(ONE_MASS.stops))
_LOST = tuple(
    ONE_MASS.stop(column, stop)
    for stop in range(ONE_MASS.stops)
    for column in (phases.LOSES, phases.HIT)
)


@kernel
def start_demand(plan: Vector, notes: Vector, everything: int) -> None:
    """See `flow.start_demand`."""
    nothing(plan, notes)
    for i in range(WORK, EVERYTHING):
        notes[i] = 0.0 if everything else math.nan
    notes[EVERYTHING] = everything


@kernel
def demand(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
    """Add one stretch."""
    right, left = notes[IMPULSE], notes[IMPULSE + 1]
    notes[IMPULSE], notes[IMPULSE + 1] = 0.0, 0.0
    flow.extremes(plan, before, ended, after, notes)
    if before[MODE] != FLIGHT or notes[EVERYTHING] != 0.0:
        row = _row()
        begin_row(row, _MASSES, _DRIFTS, _ROW)
        flow.measure(plan, before, ended, after, row)
        right, left = right + row[_PUSHED[0]], left + row[_PUSHED[1]]
        if notes[EVERYTHING] != 0.0:
            notes[WORK] -= row[phases.WORK]
            notes[LOST] += row[phases.LOST]
            for i in range(len(_LOST)):
                notes[LOST_STOPS] += row[_LOST[i]]
    notes[IMPULSE] += right
    notes[IMPULSE + 1] += left
