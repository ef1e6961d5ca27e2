"""Exact extremes of displacement, absolute acceleration and contact forces over a stretch.

The largest sample is never the maximum: each piece's series is searched (`extreme_search`), unless
its bounds lie within what was seen before.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from vibroimpact.engine.event import begins_contact, stop_of
from vibroimpact.engine.extreme_search import searching
from vibroimpact.engine.forcing.dispatch import pull_series
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.layout import ORDER, RATE
from vibroimpact.engine.linear.roots import jet
from vibroimpact.engine.linear.window_bounds import Enclosed, chords
from vibroimpact.engine.memory import stack, workspace
from vibroimpact.engine.motion import LEFT, Motion, direction, facing, main_stop, stretch_of
from vibroimpact.engine.one_mass.forces import rest_level
from vibroimpact.engine.one_mass.motions import (
    accelerated,
    acceleration,
    begin,
    bound_window,
    coordinate,
    displacement,
    enclosed,
    expanded,
    expanded_force,
    has_piece,
    next_piece,
)
from vibroimpact.engine.state import FLIGHT, ONE_MASS
from vibroimpact.engine.stops.rigid import rigid, struck


@inlined
def _jet(of: tuple[Vector, float], y: float) -> tuple[float, float, float, float]:
    series, third = of
    f, f1, f2 = jet(series, y)
    return f, f1, f2, third


_search = searching(_jet)


@kernel
def series_extremes(
    series: Vector, low: float, high: float, least: float, most: float
) -> tuple[float, float, float, float]:
    """Extend [least, most] by the values of a series over [low, high].

    Returns
    -------
    least, most, at_least, at_most
        The range, and where on the interval its ends lie (`low` where it was as wide before).
    """
    spread = 0.0
    power = 0.5
    for n in range(1, ORDER):
        spread += abs(series[n]) * power
        power *= 0.5
    if least <= series[0] - spread and series[0] + spread <= most:
        return least, most, low, low  # it lies within what was seen
    third = 0.0
    power = 1.0
    for n in range(3, ORDER):
        third += n * (n - 1) * (n - 2) * abs(series[n]) * power
        power *= 0.5
    extent: tuple[float, float, float, float] = _search((series, third), low, high, least, most)
    return extent


class Part(NamedTuple):
    """A piece: it covers −1/2 ≤ y ≤ high, and the clock in its middle is s, c."""

    high: float
    s: float
    c: float


@kernel
def pushed(
    plan: Vector, cursor: Any, before: Motion, stop: int, part: Part, series: Vector, most: float
) -> float:
    """What a stop pushes with at most on a piece, if more than `most`; it is touched.

    Per unit mass, at rest on a rigid one too; `series` is written over.
    """
    if not rigid(plan, stop):
        expanded_force(plan, cursor, before.mode, stop, series)
        _, peak, _, _ = series_extremes(series, -0.5, part.high, 0.0, most)
        return peak
    way = direction(before.mode) * facing(stop)
    rate = plan[cursor.table + RATE]
    pull_series(plan, cursor.table, part.s, part.c, series)
    least, largest, _, _ = series_extremes(series, -0.5, part.high, math.inf, -math.inf)
    pulled = least if way > 0.0 else -largest
    force: float = rest_level(plan, before, stop) - pulled * rate * rate
    return max(most, force)


U_LEAST, U_MOST, A_LEAST, A_MOST = range(4)
"""Of the notes: range of the displacement (m) and of the absolute acceleration (m/s²)."""
HITS, FORCE, IMPULSE, NOTES = (A_MOST + 1 + n * ONE_MASS.stops for n in range(4))
"""Then, a number for each stop: contacts begun, the largest force, infinite of a rigid stop that is
struck, and the largest impulse of an impact on a rigid one, per unit mass (m/s², m/s)."""

T_LEAST, T_MOST = NOTES, NOTES + 1
MEASURES = NOTES + 2
"""What is measured are the notes, contacts per cycle, and the range of the force on the base per
unit mass (m/s²)."""


def by_stop(first: int) -> list[int]:
    """Places of what is noted of each stop, from that of stop 0."""
    return [first + stop for stop in range(ONE_MASS.stops)]


notes_buffer = stack(NOTES)
"""Room for them."""


@kernel
def nothing(plan: Vector, notes: Vector) -> None:
    """See `flow.nothing`."""
    for i in range(HITS, NOTES):
        notes[i] = 0.0
    notes[U_LEAST], notes[A_LEAST] = math.inf, math.inf
    notes[U_MOST], notes[A_MOST] = -math.inf, -math.inf


@kernel
def extremes(plan: Vector, state: Vector, ended: Vector, end: Vector, notes: Vector) -> None:
    """Widen the ranges by one stretch. One-sided values at both its ends count."""
    stretch = stretch_of(state, ended, end)
    before, event, step = stretch.before, stretch.event, stretch.step
    u_least, u_most = notes[U_LEAST], notes[U_MOST]
    a_least, a_most = notes[A_LEAST], notes[A_MOST]
    series, buffer = workspace(), chords()
    sign = direction(before.mode)
    x, pressed = coordinate(plan, before), FORCE + main_stop(before.mode)
    # What was seen before, in the mode's own coordinate: a piece within it is passed over.
    offset = displacement(plan, before.mode, 0.0)
    seen_least, seen_most = sign * (u_least - offset), sign * (u_most - offset)
    seen_low, seen_high = a_least, a_most
    if before.mode == LEFT:
        seen_least, seen_most = seen_most, seen_least
        seen_low, seen_high = -a_most, -a_least
    a = sign * acceleration(plan, before)
    x_least, x_most = min(seen_least, x), max(seen_most, x)
    least_a, most_a = min(seen_low, a), max(seen_high, a)
    cursor = begin(plan, before, step)
    within = False  # all of this window
    while has_piece(plan, cursor):
        force = notes[pressed]
        if cursor.i == 0:
            seen = Enclosed(x_least, x_most, least_a, most_a, force)
            within, seen = bound_window(plan, cursor, before, seen, buffer)
            x_least, x_most, least_a, most_a, force = seen
            notes[pressed] = force
        if within:
            cursor = next_piece(plan, cursor)
            continue
        held = enclosed(plan, cursor, buffer)
        farther = not (x_least <= held.x_least and held.x_most <= x_most)
        faster = not (least_a <= held.a_least and held.a_most <= most_a)
        harder = before.mode != FLIGHT and not held.force <= force
        if not (farther or faster or harder):
            cursor = next_piece(plan, cursor)
            continue
        high, s, c = expanded(plan, cursor, series)
        if farther:
            x_least, x_most, _, _ = series_extremes(series, -0.5, high, x_least, x_most)
        if faster:
            unit = accelerated(plan, cursor, s, c, series)
            low_was, high_was = least_a / unit, most_a / unit
            least, most, _, _ = series_extremes(series, -0.5, high, low_was, high_was)
            if least < low_was:
                least_a = least * unit
            if most > high_was:
                most_a = most * unit
        if harder:
            part = Part(high, s, c)
            for stop in range(2):
                if before.mode >> stop & 1:
                    at = FORCE + stop
                    notes[at] = pushed(plan, cursor, before, stop, part, series, notes[at])
        cursor = next_piece(plan, cursor)
    new_least, new_most = x_least < seen_least, x_most > seen_most
    if before.mode == LEFT:
        new_least, new_most = new_most, new_least
        x_least, x_most, least_a, most_a = x_most, x_least, -most_a, -least_a
    if new_least:
        notes[U_LEAST] = min(u_least, displacement(plan, before.mode, x_least))
    if new_most:
        notes[U_MOST] = max(u_most, displacement(plan, before.mode, x_most))
    notes[A_LEAST], notes[A_MOST] = min(a_least, least_a), max(a_most, most_a)
    for stop in range(2):
        change = struck(stretch, stop)
        if change > 0.0:
            notes[FORCE + stop] = math.inf
            notes[IMPULSE + stop] = max(notes[IMPULSE + stop], change)
    if begins_contact(event):
        notes[HITS + stop_of(event)] += 1.0
