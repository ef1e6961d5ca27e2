"""A motion written down: samples at equal times, and every contact and detachment."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import LIMIT, at_stop, begins_contact, kind_of, stop_of
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.memory import beyond, workspace
from vibroimpact.engine.motion import (
    BOTH,
    Motion,
    arrived,
    direction,
    facing,
    main_stop,
    stretch_of,
    unpacked,
)
from vibroimpact.engine.observers.record import (
    BEGIN,
    COLUMNS,
    CONTACT_BEGINS,
    COUNT,
    DETACHMENT,
    IMPACT,
    LAST,
    NEXT,
    NUMBER,
    STEP,
    WRITTEN,
    before_end,
)
from vibroimpact.engine.one_mass.forces import stop_deformation
from vibroimpact.engine.one_mass.motions import acceleration, begin, displacement, sample_stretch
from vibroimpact.engine.one_mass.record_layout import (
    ACCELERATION,
    BLOCK,
    CLEARANCE,
    DEFORMATION,
    DISPLACEMENT,
    E_BEFORE,
    E_BEHIND,
    E_CYCLE,
    E_DEFORMATION,
    E_KIND,
    E_MEMORY,
    E_STOP,
    E_TIME,
    E_U,
    E_V,
    EVENT,
    MEMORY,
    STOPS,
    TOUCHED,
    VELOCITY,
    U,
    samples,
)
from vibroimpact.engine.stops.kelvin_voigt import relaxed


@kernel
def clearance_of(plan: Vector, stop: int, mode: int, face: float, distance: float) -> float:
    """Clearance of a stop (the paper's eq. 4); zero in contact, NaN where there is no stop."""
    at = par.stop_at(stop)
    if plan[at + par.KIND] == par.ABSENT:
        return math.nan
    return 0.0 if mode >> stop & 1 else plan[at + par.GAP] + (face - distance)


@kernel
def write(plan: Vector, state: Vector, out: Vector, columns: int, k: int) -> None:
    """Write a state as sample k of so many columns."""
    motion = unpacked(state)
    mode, u = motion.mode, motion.u
    # Adding zero leaves no negative one.
    out[DISPLACEMENT * columns + k], out[VELOCITY * columns + k] = u + 0.0, motion.v + 0.0
    out[ACCELERATION * columns + k] = acceleration(plan, motion) + 0.0
    for stop in range(STOPS):
        way, depth = facing(stop), stop_deformation(plan, motion, stop)
        out[(DEFORMATION + stop) * columns + k] = depth + 0.0
        clear = clearance_of(plan, stop, mode, depth, way * u)
        out[(CLEARANCE + stop) * columns + k] = clear + 0.0
    out[TOUCHED * columns + k] = mode
    out[MEMORY * columns + k] = motion.z + 0.0


@kernel
def sample_stop(
    plan: Vector, before: Motion, stop: int, t: float, step: float, i: int, n: int, buffer: Vector
) -> None:
    """Write a stop's deformation and clearance at n samples; what the mass does is there."""
    mode, way = before.mode, facing(stop)
    row, clear = (DEFORMATION + stop) * BLOCK, (CLEARANCE + stop) * BLOCK
    at = par.stop_at(stop)
    other = par.stop_at(1 - stop)
    gap, rate = plan[at + par.GAP], plan[at + par.RATE]
    if mode >> stop & 1:
        # The mode's own coordinate is the deformation of the right stop where both are pressed.
        apart = gap + plan[other + par.GAP] if stop != main_stop(mode) else 0.0
        sign = way if mode == BOTH else 1.0
        for j in range(n):
            buffer[row + j] = sign * buffer[j] - apart
            buffer[clear + j] = 0.0
        return
    deformation = before.faces[stop]
    for j in range(n):
        buffer[row + j] = 0.0
    if deformation > 0.0:
        for j in range(n):
            tau = max((i + j) * step - t, 0.0)
            buffer[row + j] = relaxed(deformation, rate, tau)
    if plan[at + par.KIND] == par.ABSENT:
        gap = math.nan
    for j in range(n):
        buffer[clear + j] = gap + (buffer[row + j] - way * buffer[U * BLOCK + j])


@inlined
def put(out: Vector, to: int, buffer: Vector, start: int, n: int, sign: float) -> None:
    """Write n numbers of a block to the samples; adding zero leaves no negative one."""
    for j in range(n):
        out[to + j] = sign * buffer[start + j] + 0.0


@kernel
def sample(
    plan: Vector, notes: Vector, flat: Vector, before: Motion, t: float, reach: float
) -> None:
    """Fill the samples that fall within one stretch.

    The motion itself is not interrupted: what is sampled has no influence.
    """
    i, step = int(notes[NEXT]), notes[STEP]
    end = before_end(i, int(notes[COUNT]), step, t + reach)
    if i >= end:
        return
    series, buffer = workspace(), samples()
    mode = before.mode
    sign = direction(mode)
    count = int(notes[COLUMNS])
    remembers = plan[par.HYSTERETIC] != 0.0  # else nobody looks at that row
    cursor = begin(plan, before, reach)
    while i < end:
        n = min(end - i, BLOCK)
        cursor = sample_stretch(plan, cursor, before, t, step, i, n, series, buffer)
        for j in range(n):
            buffer[U * BLOCK + j] = displacement(plan, mode, buffer[j])
        for stop in range(STOPS):
            sample_stop(plan, before, stop, t, step, i, n, buffer)
        k = int(notes[BEGIN]) + i
        put(flat, DISPLACEMENT * count + k, buffer, U * BLOCK, n, 1.0)
        put(flat, VELOCITY * count + k, buffer, VELOCITY * BLOCK, n, sign)
        put(flat, ACCELERATION * count + k, buffer, ACCELERATION * BLOCK, n, sign)
        for row in range(DEFORMATION, TOUCHED):
            put(flat, row * count + k, buffer, row * BLOCK, n, 1.0)
        for j in range(n):
            flat[TOUCHED * count + k + j] = mode
        if remembers:
            put(flat, MEMORY * count + k, buffer, MEMORY * BLOCK, n, 1.0)
        i += n
    notes[NEXT] = i


@kernel
def recorded_kind(event: int, after: Motion) -> float:
    """What the event of a stop is in the column E_KIND, which tells rest from an impact."""
    if not begins_contact(event):
        return DETACHMENT
    return CONTACT_BEGINS if after.mode >> stop_of(event) & 1 else IMPACT


@kernel
def record(
    plan: Vector,
    state: Vector,
    ended: Vector,
    end: Vector,
    notes: Vector,
    samples: Vector,
    events: Vector,
) -> None:
    """Write down one stretch and the event that ends it."""
    before, t, event, step, arrival, after = stretch_of(state, ended, end)
    if notes[COUNT]:
        sample(plan, notes, samples, before, t, math.inf if kind_of(event) == LIMIT else step)
    if at_stop(event) and notes[WRITTEN] < notes[LAST]:
        row = beyond(events, EVENT * int(notes[WRITTEN]))
        row[E_CYCLE], row[E_TIME] = notes[NUMBER], t + step
        row[E_KIND] = recorded_kind(event, after)
        row[E_STOP] = stop_of(event)
        row[E_U], row[E_V] = after.u, arrival
        for stop in range(STOPS):
            row[E_DEFORMATION + stop] = stop_deformation(plan, after, stop)
        row[E_BEFORE] = acceleration(plan, arrived(before.mode, arrival, after))
        row[E_BEHIND] = acceleration(plan, after)
        row[E_MEMORY] = after.z
        notes[WRITTEN] += 1.0
