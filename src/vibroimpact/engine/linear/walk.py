"""The walk over a table's nodes to the first time at which a function leaves its range.

The function q = weight_x·x + weight_v·x′ is linear in the state: the displacement in flight, the
contact force in contact. It stays between two levels, each of which a relaxing bumper may still
push outwards by memory·exp(−rate t). An interval on which the node values and a bound on the
second derivative leave no room for a crossing costs a few products; a clean crossing is solved by
`crossing.quick_root`; any other interval is searched by `crossing.first_root`
(docs/theory.md, section 3).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine.forcing.dispatch import expand, product
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.crossing import crossing_guess, quick_root
from vibroimpact.engine.linear.evaluate import moved, node, relaxed, travel
from vibroimpact.engine.linear.layout import LATE, MIDDLE, NODE, NODES, WIDTH, H
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root
from vibroimpact.engine.motion import Row

ABOVE, BELOW, WITHIN = 1, 2, 0
"""Where the function goes."""


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
    quick_from: float,
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
    quick_from : float
        From which node on the function is known to lie within its range at the nodes.

    Returns
    -------
    way, i, y, row, up, down
        ABOVE or BELOW, the time i + y in steps and the state there, and the memories at node i;
        WITHIN if nothing happens.
    """
    upper, lower, memory_upper, memory_lower, rate_upper, rate_lower = bounds
    h = plan[table + H]
    second = 8.0 * band  # per step squared
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
        i = j - 1 if j - 1 > done else j
        if i >= span or i == NODES:
            break
        near = node(plan, table, i, start)
        up = relaxed(memory_upper, rate_upper, i * h)
        down = relaxed(memory_lower, rate_lower, i * h)
        y = NONE
        end = near
        way = WITHIN
        if i == j - 1 and plan[table + LATE] == 0.0 and i >= quick_from:
            # The usual case: a clean crossing, no memory left on that side.
            if q > upper and up == 0.0 and before < upper:
                way = ABOVE
                guess = crossing_guess(earlier, before, q, upper, j)
                y, end = quick_root(
                    plan, table, watched.weight_x, watched.weight_v, upper, guess, second, near
                )
            elif q < lower and down == 0.0 and before > lower:
                way = BELOW
                guess = crossing_guess(earlier, before, q, lower, j)
                y, end = quick_root(
                    plan, table, -watched.weight_x, -watched.weight_v, -lower, guess, second, near
                )
            if y != NONE and i + y > span:
                break
        if y == NONE:
            expand(plan, table + watched.series, moved(plan, table + MIDDLE, near), series)
            low_upper = max(0.0, clear_upper - i)
            low_lower = max(0.0, clear_lower - i)
            # A side is left out where both ends of the interval clear it.
            first = before
            if i != j - 1:
                first = product(plan, table + watched.rows + i * watched.apart, start)
            here = Bounds(
                upper if max(q, first) > top else math.inf,
                lower if min(q, first) < bottom else -math.inf,
                relaxed(up, rate_upper, low_upper * h),
                relaxed(down, rate_lower, low_lower * h),
                rate_upper,
                rate_lower,
            )
            high = min(0.5, span - i - 0.5)
            y, way = search(series, here, h, low_upper - 0.5, low_lower - 0.5, high)
            if y != NONE:
                y += 0.5
                end = travel(plan, table, y, near)
        if y != NONE:
            return way, i, y, end, up, down
        done = i
        if i == j:
            if j == NODES:
                break
            earlier = before
            before = q
            q = product(plan, table + watched.rows + j * watched.apart, start)
            j += 1
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
