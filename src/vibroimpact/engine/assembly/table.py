"""The functions of the flow of several masses for the rest of the engine (see `flow`)."""

from __future__ import annotations

import math

from vibroimpact.engine.assembly import advance as motion
from vibroimpact.engine.assembly import channels, free_motion, measures, section, stretches
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly import tangent as disturbances
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
mirror, undisturbed = section.mirror, free_motion.stays_free
stops, nothing, extremes, measured = (
    measures.stops_of,
    measures.start,
    measures.extremes,
    measures.write,
)
unit_disturbances, tangent = disturbances.unit_disturbances, disturbances.tangent
start_demand = stretches.start_demand
measure, demand = stretches.demanding(channels)
record, write = recording(motion.next_stretch, channels)
first_piece, next_piece, series = channels.walking(channels)


@kernel
def coordinates(plan: Vector) -> int:
    """See `flow.coordinates`."""
    return 2 * int(plan[at.MASSES])


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
def look_again(plan: Vector, again: int) -> int:
    """See `flow.look_again`."""
    return 0


@kernel
def margin(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
    """See `flow.margin`; it is not known."""
    notes[0] = math.nan
