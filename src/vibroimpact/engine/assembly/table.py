"""The functions of the flow of several masses for the rest of the engine (see `flow`)."""

from __future__ import annotations

import math

from vibroimpact.engine.assembly import advance as motion
from vibroimpact.engine.assembly import channels, measures, section, stretches
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly import tangent as disturbances
from vibroimpact.engine.assembly.free_motion import stays_free as in_closed_form
from vibroimpact.engine.assembly.record import recording
from vibroimpact.engine.jit import Vector, kernel

begin, build, advance, cycle = motion.begin, motion.build, motion.advance, motion.cycle
too_much_work, stiff_rate = section.too_much_work, section.stiff_rate
parts, units, size = section.parts, section.units, section.size
disturb, place, point, at_point = (
    section.disturb,
    section.place,
    section.point,
    section.at_point,
)
mirror = section.mirror
start_demand = stretches.start_demand
_measure = stretches.measuring(channels)
_write_down, write = recording(motion.next_stretch, channels)
_demand, _integrate = stretches.demanding(_measure), stretches.integrating(channels)


@kernel
def coordinates(plan: Vector) -> int:
    """See `flow.coordinates`."""
    return 2 * int(plan[at.MASSES])


@kernel
def stops(plan: Vector) -> int:
    """See `flow.stops`."""
    return int(plan[at.STOPS])


@kernel
def numbers(plan: Vector) -> int:
    """See `flow.numbers`."""
    return int(plan[at.NUMBERS])


@kernel
def complete(plan: Vector) -> None:
    """See `flow.complete`."""
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    for i in range(n):
        for block, sums in ((at.STIFFNESS, 0), (at.DAMPING, n)):
            total = 0.0
            for j in range(n):
                total += abs(plan[int(plan[block]) + i * n + j])
            plan[int(plan[at.ROW_SUMS]) + sums + i] = total
    for f in range(count):
        one = int(plan[at.STOP]) + f * at.STOP_WIDTH
        plan[one + at.RESTITUTION] = max(plan[one + at.RESTITUTION], 0.0)
        dashpot = plan[one + at.STOP_DAMPING]
        plan[one + at.RELAXATION] = (
            plan[one + at.STOP_STIFFNESS] / dashpot if dashpot > 0.0 else math.inf
        )


@kernel
def undisturbed(plan: Vector, state: Vector, dying: float, measured: Vector) -> int:
    """See `flow.undisturbed`."""
    return in_closed_form(plan, state, dying)


@kernel
def nothing(plan: Vector, notes: Vector) -> None:
    """See `flow.nothing`."""
    measures.start(plan, notes)


@kernel
def look_again(plan: Vector, again: int) -> int:
    """See `flow.look_again`."""
    return 0


@kernel
def extremes(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
    """See `flow.extremes`."""
    measures.extremes(plan, notes)


@kernel
def measured(plan: Vector, notes: Vector, other: Vector, cycles: int, result: Vector) -> None:
    """See `flow.measured`."""
    measures.write(plan, notes, cycles, result)


@kernel
def unit_disturbances(plan: Vector, state: Vector, q: Vector) -> None:
    """See `flow.unit_disturbances`."""
    disturbances.unit_disturbances(plan, int(state[at.STATE_MODE]), q)


@kernel
def tangent(
    plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector, q: Vector
) -> None:
    """See `flow.tangent`."""
    disturbances.carry_all(plan, notes, q)


@kernel
def margin(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
    """See `flow.margin`; it is not known."""
    notes[0] = math.nan


@kernel
def measure(plan: Vector, before: Vector, ended: Vector, after: Vector, row: Vector) -> None:
    """See `flow.measure`."""
    _measure(plan, before, True, row)


@kernel
def demand(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
    """See `flow.demand`."""
    _demand(plan, before, notes)


@kernel
def integrate(
    plan: Vector,
    before: Vector,
    ended: Vector,
    after: Vector,
    notes: Vector,
    lines: Vector,
    out: Vector,
) -> None:
    """See `flow.integrate`."""
    _integrate(plan, ended, notes, lines, out)


@kernel
def record(
    plan: Vector,
    before: Vector,
    ended: Vector,
    after: Vector,
    notes: Vector,
    samples: Vector,
    events: Vector,
) -> None:
    """See `flow.record`."""
    _write_down(plan, before, ended, notes, samples, events)
