"""A stretch of one mass measured: extremes, forces, impulses, work and losses, exact to rounding.

On a piece the motion is a series of 12 terms; Gauss–Legendre quadrature with 12 points integrates a
product of two such series without error, and a law's force of one to rounding.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import IMPACT, at_stop, kind_of, stop_of
from vibroimpact.engine.forcing.dispatch import pull_series, value
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import horner
from vibroimpact.engine.linear.layout import ORDER, RATE, H
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import (
    Motion,
    Stretch,
    arrived,
    direction,
    facing,
    main_stop,
    stretch_of,
)
from vibroimpact.engine.observers import record
from vibroimpact.engine.observers.phases import (
    A_EVENT,
    A_LEAST,
    A_MOST,
    A_TIME,
    ARRIVAL,
    AT_STOP,
    CARRIED_LEAST,
    CLOSING,
    DEPTH,
    FORCE,
    HIT,
    IMPULSE,
    KIND,
    LENGTH,
    LOSES,
    LOST,
    MASS,
    PARTING,
    STOP,
    STRUCK,
    SYSTEM,
    TOUCHED,
    U_LEAST,
    WORK,
)
from vibroimpact.engine.one_mass.extremes import Part, pushed, series_extremes
from vibroimpact.engine.one_mass.forces import (
    isolator_power,
    rest_level,
    stop_power,
    stop_push,
    unreturned_energy,
)
from vibroimpact.engine.one_mass.margin import leading_sign
from vibroimpact.engine.one_mass.motions import (
    accelerated,
    acceleration,
    begin,
    coordinate,
    displacement,
    expanded,
    has_piece,
    moment,
    next_piece,
)
from vibroimpact.engine.one_mass.record import recorded_kind
from vibroimpact.engine.quadrature import ABSCISSAE, WEIGHTS
from vibroimpact.engine.state import SETTLING
from vibroimpact.engine.stops.kelvin_voigt import closing_speed, relaxed_loss
from vibroimpact.engine.stops.places import total_gap
from vibroimpact.engine.stops.rigid import rigid


class Bounds(NamedTuple):
    """Between which values a quantity lies."""

    least: float
    most: float


@kernel
def column(stop: int, name: int) -> int:
    """Where in a row a stop has a column."""
    return SYSTEM + MASS + STOP * stop + name


@kernel
def widen_row(row: Vector, at: int, span: Bounds) -> None:
    """Widen a range of a row, whose columns follow each other."""
    row[at], row[at + 1] = min(row[at], span.least), max(row[at + 1], span.most)


@kernel
def positive_part(series: Vector, high: float) -> float:
    """Integral of a series over [−1/2, high], but for where it is negative."""
    way, total, y = leading_sign(series), 0.0, -0.5
    while y < high:
        end = first_root(series, Clearance(0.0, way, 0.0, 0.0, False), y, high)
        if end == NONE:
            end = high
        if way > 0.0:
            for n in range(ORDER):
                total += series[n] / (n + 1) * (end ** (n + 1) - y ** (n + 1))
        y, way = end, -way
    return total


@kernel
def pressed_impulse(
    plan: Vector, cursor: Any, before: Motion, stop: int, high: float, shaking: Vector
) -> float:
    """Impulse of a mass at rest on a rigid stop over a piece; it may be friction that holds it."""
    series = workspace()
    way = direction(before.mode) * facing(stop)
    h, rate = plan[cursor.table + H], plan[cursor.table + RATE]
    for n in range(ORDER):
        series[n] = -way * rate * rate * shaking[n]
    series[0] += rest_level(plan, before, stop)
    impulse: float = h * positive_part(series, high)
    return impulse


@kernel
def add_powers(
    plan: Vector,
    cursor: Any,
    before: Motion,
    width: float,
    series: Vector,
    shaking: Vector,
    row: Vector,
) -> None:
    """Add work, losses and impulses of what deforms on a piece, `width` steps long."""
    mode = before.mode
    sign = direction(mode)
    h, rate = plan[cursor.table + H], plan[cursor.table + RATE]
    for n in range(len(WEIGHTS)):
        y = width * ABSCISSAE[n] - 0.5
        share = WEIGHTS[n] * width * h
        x, slope = horner(series, y)
        v = slope * rate
        drive, _ = horner(shaking, y)
        here = moment(plan, cursor, before, x, sign * v, y)
        row[WORK] += share * v * (drive * rate * rate)
        row[LOST] += share * isolator_power(plan, here)
        for stop in range(2):
            if mode >> stop & 1 and not rigid(plan, stop):
                row[column(stop, IMPULSE)] += share * stop_push(plan, here, stop)
                row[column(stop, LOSES)] += share * stop_power(plan, here, stop)


@kernel
def measure_pieces(plan: Vector, before: Motion, step: float, row: Vector) -> None:
    """Add what happens between the ends of a stretch."""
    series, shaking = workspace(), workspace()
    mode = before.mode
    sign = direction(mode)
    x_least = x_most = coordinate(plan, before)
    a_least = a_most = sign * acceleration(plan, before)
    carried = Bounds(a_least, a_least)
    if plan[par.BASE] == 0.0:
        s, c = before.clock
        first = a_least + sign * value(plan, s, c)
        carried = Bounds(first, first)
    begun, at = row[LENGTH], 0.0
    cursor = begin(plan, before, step)
    while has_piece(plan, cursor):
        rate = plan[cursor.table + RATE]
        h = plan[cursor.table + H]
        high, s, c = expanded(plan, cursor, series)
        pull_series(plan, cursor.table, s, c, shaking)
        add_powers(plan, cursor, before, high + 0.5, series, shaking, row)
        x_least, x_most, _, _ = series_extremes(series, -0.5, high, x_least, x_most)
        unit = accelerated(plan, cursor, s, c, series)
        least_was, most_was = a_least / unit, a_most / unit
        least, most, at_least, at_most = series_extremes(series, -0.5, high, least_was, most_was)
        a_least, a_most = least * unit, most * unit
        since = cursor.t + (cursor.i + 0.5) * h
        if least < least_was and -least > most:
            at = since + at_least * h
        if most > most_was and most >= -least:
            at = since + at_most * h
        if plan[par.BASE] == 0.0:
            for n in range(ORDER):
                series[n] = series[n] * unit + shaking[n] * rate * rate
            least, most, _, _ = series_extremes(series, -0.5, high, carried.least, carried.most)
            carried = Bounds(least, most)
        part = Part(high, s, c)
        for stop in range(2):
            if mode >> stop & 1:
                force = column(stop, FORCE)
                row[force] = pushed(plan, cursor, before, stop, part, series, row[force])
                if rigid(plan, stop):
                    row[column(stop, IMPULSE)] += pressed_impulse(
                        plan, cursor, before, stop, high, shaking
                    )
        cursor = next_piece(plan, cursor)
    if plan[par.BASE] != 0.0:
        carried = Bounds(a_least, a_most)
    if max(-a_least, a_most) > max(-row[SYSTEM + A_LEAST], row[SYSTEM + A_MOST]):
        row[SYSTEM + A_TIME] = begun + at
    if sign < 0.0:
        a_least, a_most = -a_most, -a_least
        carried = Bounds(-carried.most, -carried.least)
    widen_row(row, SYSTEM + A_LEAST, Bounds(a_least, a_most))
    widen_row(row, CARRIED_LEAST, carried)
    low, top = displacement(plan, mode, x_least), displacement(plan, mode, x_most)
    widen_row(row, SYSTEM + U_LEAST, Bounds(min(low, top), max(low, top)))
    for stop in range(2):
        if mode >> stop & 1:
            depth = x_most
            if stop != main_stop(mode):
                depth = -x_least - total_gap(plan)
            row[column(stop, DEPTH)] = max(row[column(stop, DEPTH)], depth)


@kernel
def measure_settling(plan: Vector, before: Motion, step: float, after: Motion, row: Vector) -> None:
    """Add the rest of a chatter, which is not followed from impact to impact: both its ends.

    Its energy is what its last stop takes; nothing else moves meanwhile.
    """
    last = arrived(before.mode, before.v, after)
    measure_pieces(plan, before, 0.0, row)
    measure_pieces(plan, last, 0.0, row)
    for stop in range(2):
        if before.mode >> stop & 1:
            push = stop_push(plan, before, stop) + stop_push(plan, last, stop)
            row[column(stop, IMPULSE)] += 0.5 * step * push


@kernel
def measure_event(plan: Vector, stretch: Stretch, row: Vector) -> None:
    """Write what the event is that ends a phase, and what the stop that it is at loses."""
    before, _, event, _, arrival, after = stretch
    stop, kind = stop_of(event), recorded_kind(event, after)
    row[KIND], row[AT_STOP] = kind, stop
    if kind == record.IMPACT:
        row[STRUCK] = abs(arrival - after.v)
    behind = acceleration(plan, after)
    sharp = acceleration(plan, arrived(before.mode, arrival, after))
    row[SYSTEM + A_EVENT] = max(abs(sharp), abs(behind))
    if kind_of(event) == IMPACT:
        # The rest of a chatter ends without velocity.
        last = before.v if before.fresh & SETTLING else arrival
        row[column(stop, HIT)] = 0.5 * (last * last - after.v * after.v)


@kernel
def measure(plan: Vector, state: Vector, ended: Vector, end: Vector, row: Vector) -> None:
    """Add a stretch to the row of its phase; energies, forces and impulses per unit mass."""
    stretch = stretch_of(state, ended, end)
    before, _, event, step, arrival, after = stretch
    row[TOUCHED] = before.mode
    if before.fresh & SETTLING:
        measure_settling(plan, before, step, after, row)
    else:
        measure_pieces(plan, before, step, row)
    for stop in range(2):
        loses = column(stop, LOSES)
        if before.mode >> stop & 1:
            row[loses] += unreturned_energy(plan, before, after, stop)
        else:
            row[loses] += relaxed_loss(plan, stop, before.faces[stop], after.faces[stop])
        row[column(stop, CLOSING)] = closing_speed(plan, stop, arrival, after)
    row[SYSTEM + ARRIVAL], row[SYSTEM + PARTING] = arrival, after.v
    if at_stop(event):
        measure_event(plan, stretch, row)
