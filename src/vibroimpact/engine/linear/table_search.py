"""The walk over a table's nodes to the first time at which a function leaves its range.

The function q = weight_x·x + weight_v·x′ is linear in the state: the displacement in flight, the
contact force in contact. It stays between two levels, each of which a relaxing bumper may still
push outwards by memory·exp(−rate t). An interval on which the node values and a bound on the
second derivative leave no room for a crossing costs a few products; a clean crossing is solved by
`crossing.quick_root`; any other interval is searched by `roots.first_root`
(docs/theory.md, section 3).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine.forcing.dispatch import expand, product, short_series
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.crossing import crossing_guess, quick_root
from vibroimpact.engine.linear.evaluate import moved, node, travel
from vibroimpact.engine.linear.layout import (
    FOURTH,
    FOURTH_0,
    LATE,
    MIDDLE,
    NODE,
    NODES,
    WIDTH,
    H,
    Row,
)
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root
from vibroimpact.engine.motion import LEFT, RIGHT
from vibroimpact.engine.state import FLIGHT
from vibroimpact.engine.stops.kelvin_voigt import relaxed

ABOVE, BELOW, WITHIN = RIGHT, LEFT, FLIGHT
"""Where the function goes: the bit of the stop that is met there."""


class Watched(NamedTuple):
    """The function, and where a table keeps its rows (a row a node, so far apart) and series."""

    weight_x: float
    weight_v: float
    rows: int
    apart: int
    series: int


class Bounds(NamedTuple):
    """Levels, their memories (≥ 0) and the rates at which those fade (1/s)."""

    upper: float
    lower: float
    memory_upper: float
    memory_lower: float
    rate_upper: float
    rate_lower: float


@kernel
def search(
    series: Vector, bounds: Bounds, h: float, low_upper: float, low_lower: float, high: float
) -> tuple[float, int]:
    """First crossing on an interval with this series: (y, ABOVE or BELOW), or (NONE, WITHIN).

    The memories are those at `low_upper` and `low_lower`, where the search of each side begins.
    """
    above = NONE
    below = NONE
    if low_upper < high and bounds.upper < math.inf:
        clearance = Clearance(bounds.upper, -1.0, bounds.memory_upper, bounds.rate_upper * h, False)
        above = first_root(series, clearance, low_upper, high)
    if low_lower < high and bounds.lower > -math.inf:
        clearance = Clearance(-bounds.lower, 1.0, bounds.memory_lower, bounds.rate_lower * h, False)
        below = first_root(series, clearance, low_lower, high)
    if above == NONE and below == NONE:
        return NONE, WITHIN
    if above <= below:
        return above, ABOVE
    return below, BELOW


@kernel
def bends(
    plan: Vector, table: int, row: Row, second: float, low: float, high: float
) -> tuple[float, float]:
    """How much x″ and −x″ can be from `low` to `high` steps about a state, or 0 (early tables).

    x″ and x‴ are known at the state, and x⁗ is bounded where |x″| is, here by `second` (all per
    step): next to a stop this says far more than what the energy allows for a whole window.
    """
    _, _, a2, a3, _, _, _ = short_series(plan, table, row)
    fourth = plan[table + FOURTH] * second + plan[table + FOURTH_0]
    left_out = 0.5 * fourth * max(low * low, high * high)
    one, two = 2.0 * a2 + 6.0 * a3 * low, 2.0 * a2 + 6.0 * a3 * high
    return max(max(one, two) + left_out, 0.0), max(left_out - min(one, two), 0.0)


@inlined
def walk(
    plan: Vector,
    table: int,
    watched: Watched,
    bounds: Bounds,
    q: float,
    band: float,
    start: Row,
    span: float,
    clear_upper: float,
    clear_lower: float,
    within: bool,
    series: Vector,
) -> tuple[int, int, float, Row, float, float]:
    """Walk over one window of NODES intervals, or `span` of them.

    Parameters
    ----------
    q, band : float
        The function at the start, and the bound on what it bends over an interval, q″ h²/8.
    start : Row
        The state at the window's start.
    clear_upper, clear_lower : float
        Proven free of a crossing for so many steps.
    within : bool
        Whether the function lies within its range at the start, and not on its border.

    Returns
    -------
    way, i, y, row, up, down
        ABOVE or BELOW, the time i + y in steps and the state there, and the memories at node i;
        WITHIN if nothing happens.
    """
    upper, lower, memory_upper, memory_lower, rate_upper, rate_lower = bounds
    h = plan[table + H]
    second = 8.0 * band  # per step squared
    early = plan[table + LATE] == 0.0
    closely = early and watched.weight_v == 0.0 and watched.weight_x == 1.0
    top = upper - band
    bottom = lower + band
    before = q
    earlier = q  # at the node before that, for the guess
    j = 0
    done = -1
    while True:
        # Find the next node next to which a crossing cannot be excluded.
        while True:
            if (q > top and j + 1.0 > clear_upper) or (q < bottom and j + 1.0 > clear_lower):
                break
            if j >= span or j == NODES:
                j = -1
                break
            earlier = before
            before = q
            q = product(plan, table + watched.rows + j * watched.apart, start)
            j += 1
        if j < 0:
            break
        if j - 1 <= done:  # what lies before it has been looked at
            if j >= span or j == NODES:
                break
            earlier = before
            before = q
            q = product(plan, table + watched.rows + j * watched.apart, start)
            j += 1
        i = done = j - 1
        near = node(plan, table, i, start)
        up = relaxed(memory_upper, rate_upper, i * h)
        down = relaxed(memory_lower, rate_lower, i * h)
        up_after = relaxed(memory_upper, rate_upper, j * h)
        down_after = relaxed(memory_lower, rate_lower, j * h)
        crossed = q > upper + up_after or q < lower - down_after
        rise, fall = second, second
        if closely and not crossed:
            rise, fall = bends(plan, table, near, second, 0.0, 1.0)
        # Where both ends lie within, it would have to bulge out between them.
        over = not max(q, before) + 0.125 * fall < upper + up_after
        under = not min(q, before) - 0.125 * rise > lower - down_after
        if not (over or under):
            continue
        y = NONE
        end = near
        way = WITHIN
        if early and (i > 0 or within):
            # The usual case: it has crossed at the next node, or at the one behind that.
            first, from_up, from_down = near, up, down
            older, here, there, back = earlier, before, q, 0.0
            if not crossed and j < NODES and j < span:
                first, from_up, from_down = node(plan, table, j, start), up_after, down_after
                older, here, back = before, q, 1.0
                there = product(plan, table + watched.rows + j * watched.apart, start)
            inside = lower - from_down < here < upper + from_up
            # No memory may be left on that side, and the other one is out of the question.
            no_below = (back == 0.0 or not under) and min(here, upper) - band > lower
            no_above = (back == 0.0 or not over) and max(here, lower) + band < upper
            if inside and from_up == 0.0 and no_below and there > upper:
                way = ABOVE
            elif inside and from_down == 0.0 and no_above and there < lower:
                way = BELOW
            if way != WITHIN:
                sign, level = (1.0, upper) if way == ABOVE else (-1.0, lower)
                w, wv = sign * watched.weight_x, sign * watched.weight_v
                guess = crossing_guess(older, here, there, level, j + int(back))
                y, slope, end = quick_root(plan, table, w, wv, sign * level, guess, first)
                # With a slope m it has been within for 2 m / bend before.
                if y != NONE and not 2.0 * slope > second * (y + back):
                    bend = second
                    if closely:
                        rise, fall = bends(plan, table, first, second, -back, 1.0)
                        bend = rise if way == ABOVE else fall
                    if not 2.0 * slope > bend * (y + back):
                        y = NONE
                if y != NONE:
                    if i + back + y > span:
                        break
                    return way, i + int(back), y, end, from_up, from_down
        if y == NONE:
            expand(plan, table + watched.series, moved(plan, table + MIDDLE, near), series)
            low_upper = max(0.0, clear_upper - i)
            low_lower = max(0.0, clear_lower - i)
            bounded = Bounds(
                upper if over else math.inf,
                lower if under else -math.inf,
                relaxed(up, rate_upper, low_upper * h),
                relaxed(down, rate_lower, low_lower * h),
                rate_upper,
                rate_lower,
            )
            high = min(0.5, span - i - 0.5)
            y, way = search(series, bounded, h, low_upper - 0.5, low_lower - 0.5, high)
            if y != NONE:
                return way, i, y + 0.5, travel(plan, table, y + 0.5, near), up, down
    return WITHIN, NODES, 0.0, start, 0.0, 0.0


@inlined
def ended(plan: Vector, table: int, start: Row, span: float) -> Row:
    """The state `span` ≤ NODES steps behind a window's start."""
    i = min(int(span), NODES - 1)
    return travel(plan, table, span - i, node(plan, table, i, start))


@inlined
def next_window(plan: Vector, table: int, start: Row) -> Row:
    """The state at the end of a window."""
    return moved(plan, table + NODE + (NODES - 1) * WIDTH, start)
