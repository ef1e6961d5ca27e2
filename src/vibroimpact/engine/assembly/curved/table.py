"""The functions of the flow of several masses with curved laws (see `flow`)."""

from __future__ import annotations

from vibroimpact.engine.assembly import measures, section, stretches, table
from vibroimpact.engine.assembly.channels import walking
from vibroimpact.engine.assembly.curved import advance as motion
from vibroimpact.engine.assembly.curved import channels
from vibroimpact.engine.assembly.curved import section as curved
from vibroimpact.engine.assembly.curved import tangent as disturbances
from vibroimpact.engine.assembly.record import recording
from vibroimpact.engine.jit import Vector, kernel

begin, build, advance, cycle = motion.begin, motion.build, motion.advance, table.cycle
too_much_work, stiff_rate = section.too_much_work, section.stiff_rate
parts, size, point = section.parts, section.size, section.point
coordinates, stops, numbers = table.coordinates, table.stops, table.numbers
look_again, margin, mirror = table.look_again, table.margin, curved.mirror
nothing, measured = table.nothing, table.measured
units, disturb, place, at_point = curved.units, curved.disturb, curved.place, curved.at_point
unit_disturbances, tangent = disturbances.unit_disturbances, disturbances.tangent
extremes = measures.observing(channels)
start_demand = stretches.start_demand
measure, demand = stretches.demanding(channels)
record, write = recording(motion.next_stretch, channels)
first_piece, next_piece, series = walking(channels)


@kernel
def complete(plan: Vector) -> None:
    """See `flow.complete`."""
    table.complete(plan)
    curved.complete(plan)


@kernel
def undisturbed(plan: Vector, state: Vector, dying: float, result: Vector) -> int:
    """See `flow.undisturbed`; it is not known."""
    return 0
