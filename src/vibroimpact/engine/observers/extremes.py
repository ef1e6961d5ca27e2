"""Exact extremes of displacement, absolute acceleration and contact forces over a stretch.

The largest sample is never the maximum. Each piece's series is walked with
steps on which either the slope or the curvature provably keeps its sign, so that every local
extreme is found and polished (docs/theory.md, section 4).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from vibroimpact.engine.dispatch import (
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
    rest_level,
)
from vibroimpact.engine.event import begins_contact, stop_of
from vibroimpact.engine.forcing.dispatch import pull_series
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.layout import ORDER, RATE
from vibroimpact.engine.linear.roots import jet
from vibroimpact.engine.linear.window_bounds import Enclosed, chords
from vibroimpact.engine.memory import stack, workspace
from vibroimpact.engine.motion import (
    FLIGHT,
    LEFT,
    Motion,
    direction,
    facing,
    main_stop,
    stretch_of,
)
from vibroimpact.engine.stops.rigid import rigid, struck

_SMALLEST = 2.0**-27  # a parabola rises by less than rounding over it


def searching(jet: Any) -> Any:
    """Make the search for the extremes of a function over [low, high].

    `jet(of, y)` gives its value, its first two derivatives, and a bound on the third one from there
    on. It extends [least, most], and returns as `series_extremes`.
    """

    def search(
        of: Any, low: float, high: float, least: float, most: float
    ) -> tuple[float, float, float, float]:
        at_least = low
        at_most = low
        p = low
        width = high - low
        f, f1, f2, third = jet(of, p)
        least, most = min(least, f), max(most, f)
        if not third < math.inf:
            return least, most, at_least, at_most  # of a motion that runs away
        while p < high:
            width = min(width, high - p)
            steep = abs(f1) > abs(f2) * width + 0.5 * third * width * width
            if not (steep or abs(f2) >= third * width or width < _SMALLEST):
                width *= 0.5
                continue
            g, g1, g2, beyond = jet(of, p + width)
            if not steep and f1 * g1 < 0.0:
                # One critical point: regula falsi kept in its bracket by Newton's slope.
                a, b = p, p + width
                y = a - f1 * width / (g1 - f1)
                for _ in range(60):
                    e, e1, e2, _ = jet(of, y)
                    if e < least:
                        least, at_least = e, y
                    if e > most:
                        most, at_most = e, y
                    if e1 * f1 > 0.0:
                        a = y
                    else:
                        b = y
                    new = y - e1 / e2 if e2 != 0.0 else 0.5 * (a + b)
                    if not a < new < b:
                        new = 0.5 * (a + b)
                    if abs(new - y) < 1e-10:  # the value is then right to 1e-20
                        break
                    y = new
            p += width
            if g < least:
                least, at_least = g, p
            if g > most:
                most, at_most = g, p
            f1, f2, third = g1, g2, beyond
            width *= 4.0
        return least, most, at_least, at_most

    return inlined(search)


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
    found: tuple[float, float, float, float] = _search((series, third), low, high, least, most)
    return found


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
        _, found, _, _ = series_extremes(series, -0.5, part.high, 0.0, most)
        return found
    way = direction(before.mode) * facing(stop)
    rate = plan[cursor.table + RATE]
    pull_series(plan, cursor.table, part.s, part.c, series)
    least, largest, _, _ = series_extremes(series, -0.5, part.high, math.inf, -math.inf)
    pulled = least if way > 0.0 else -largest
    force: float = rest_level(plan, before, stop) - pulled * rate * rate
    return max(most, force)


U_LEAST, U_MOST, A_LEAST, A_MOST, HITS_RIGHT, HITS_LEFT = range(6)
"""Of the notes: range of the displacement (m) and of the absolute acceleration (m/s²), contacts
begun."""
FORCE_RIGHT, FORCE_LEFT, IMPULSE_RIGHT, IMPULSE_LEFT = range(6, 10)
"""Then the largest force of a stop, infinite of a rigid one that is struck, and the largest
impulse of an impact on a rigid one, per unit mass (m/s², m/s)."""
NOTES = 10

T_LEAST, T_MOST = NOTES, NOTES + 1
MEASURES = NOTES + 2
"""What is measured are the notes, contacts per cycle, and the range of the force on the base per
unit mass (m/s²)."""

notes_room = stack(NOTES)
"""Room for them."""


@kernel
def nothing(plan: Vector, notes: Vector) -> None:
    """See `flow.nothing`."""
    for i in range(HITS_RIGHT, NOTES):
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
    series, room = workspace(), chords()
    sign = direction(before.mode)
    x, pressed = coordinate(plan, before), FORCE_RIGHT + main_stop(before.mode)
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
            within, seen = bound_window(plan, cursor, before, seen, room)
            x_least, x_most, least_a, most_a, force = seen
            notes[pressed] = force
        if within:
            cursor = next_piece(plan, cursor)
            continue
        held = enclosed(plan, cursor, room)
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
                    at = FORCE_RIGHT + stop
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
            notes[FORCE_RIGHT + stop] = math.inf
            notes[IMPULSE_RIGHT + stop] = max(notes[IMPULSE_RIGHT + stop], change)
    if begins_contact(event):
        notes[HITS_RIGHT + stop_of(event)] += 1.0
