"""The functions of the flow of several masses with curved laws (see `flow`)."""

from __future__ import annotations

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly import measures, section, stretches, table
from vibroimpact.engine.assembly.curved import advance as motion
from vibroimpact.engine.assembly.curved import channels
from vibroimpact.engine.assembly.curved import section as curved
from vibroimpact.engine.assembly.curved import tangent as disturbances
from vibroimpact.engine.assembly.record import recording
from vibroimpact.engine.event_loop import unobserved
from vibroimpact.engine.jit import Vector, kernel

begin, build, advance = motion.begin, motion.build, motion.advance
too_much_work, stiff_rate = section.too_much_work, section.stiff_rate
parts, size, point = section.parts, section.size, section.point
coordinates, numbers, look_again = table.coordinates, table.numbers, table.look_again
margin, mirror = table.margin, curved.mirror
nothing, measured = table.nothing, table.measured
units, disturb, place, at_point = curved.units, curved.disturb, curved.place, curved.at_point
start_demand = stretches.start_demand
_observed = measures.observing(channels)
_measure = stretches.measuring(channels)
_write_down, write = recording(motion.next_stretch, channels)
_demand, _integrate = stretches.demanding(_measure), stretches.integrating(channels)


@kernel
def stops(plan: Vector) -> int:
    """See `flow.stops`."""
    found: int = measures.stops_of(plan)
    return found


@kernel
def complete(plan: Vector) -> None:
    """See `flow.complete`."""
    table.complete(plan)
    curved.complete(plan)


@kernel
def undisturbed(plan: Vector, state: Vector, dying: float, measured: Vector) -> int:
    """See `flow.undisturbed`; it is not known."""
    return 0


@kernel
def cycle(plan: Vector, state: Vector, s: float, c: float, length: float, max_events: int) -> int:
    """See `flow.cycle`."""
    events: int = unobserved(plan, state, s, c, length, max_events)
    return events


@kernel
def extremes(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
    """See `flow.extremes`."""
    _observed(plan, notes)


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
