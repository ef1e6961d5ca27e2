"""Free of a bumper until it is touched: the first contact, or a time limit.

In flight both bumpers are free, and x is the displacement; pressed on one side, the mass may be
free of the other, and x is then the pressed bumper's deformation. In both cases a contact begins
where x leaves the range between two levels, which the free bumpers' deformations widen.
"""

from __future__ import annotations

import math

from vibroimpact.engine.forcing.dispatch import expand
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.evaluate import band, travel
from vibroimpact.engine.linear.layout import (
    LATE,
    LATE_TABLES,
    NODE,
    NODES,
    RATE,
    SIZE,
    TABLES,
    TAYLOR,
    VALID_FROM,
    WIDTH,
    H,
    Row,
)
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root
from vibroimpact.engine.linear.table_search import (
    ABOVE,
    BELOW,
    WITHIN,
    Bounds,
    Watched,
    bends,
    ended,
    next_window,
    search,
    walk,
)
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.stops.kelvin_voigt import relaxed

_WEAK_PULL = 0.45  # theory, section 3.3
_LEAST = 1e-300  # in place of no bend at all: nothing is divided by 0

_AHEAD = 2.0
"""How many steps after a detachment are bounded closely."""

_DISPLACEMENT = Watched(1.0, 0.0, NODE, WIDTH, TAYLOR)


@inlined
def faded(bounds: Bounds, t: float) -> Bounds:
    """The same levels when the memories have faded for so long."""
    upper, lower, memory_upper, memory_lower, rate_upper, rate_lower = bounds
    return Bounds(
        upper,
        lower,
        relaxed(memory_upper, rate_upper, t),
        relaxed(memory_lower, rate_lower, t),
        rate_upper,
        rate_lower,
    )


@kernel
def parted(memory: float, rate: float, speed: float, second: float) -> float:
    """For how many steps a stop just left is surely not met again (theory, section 3.3).

    `second` is the most that the motion is bent towards it, and all are per step.
    """
    second = max(second, _LEAST)
    if memory > 0.0:
        q = second / (rate * rate * memory)
        return 2.0 * rate * memory * (1.0 - q) / second if q <= _WEAK_PULL else 0.0
    return 2.0 * max(speed, 0.0) / second


@kernel
def leave(
    series: Vector, way: int, released: bool, memory: float, rate: float, high: float
) -> float:
    """Re-contact within [0, high] of a detachment at y = 0, or NONE.

    The series is that of x from the detachment, where the clearance vanishes by construction,
    and where its slope does too if the bumper has a dashpot. Released from rest, the mass has
    neither velocity nor acceleration.
    """
    series[0] = 0.0
    sign = -1.0 if way == ABOVE else 1.0
    if memory > 0.0 or released:
        series[1] = 0.0
    if released:
        series[2] = 0.0
    return first_root(series, Clearance(0.0, sign, memory, rate, memory > 0.0), 0.0, high)


@kernel
def without(bounds: Bounds, way: int) -> Bounds:
    """The other side's bound alone."""
    upper, lower, memory_upper, memory_lower, rate_upper, rate_lower = bounds
    if way == ABOVE:
        upper, memory_upper = math.inf, 0.0
    else:
        lower, memory_lower = -math.inf, 0.0
    return Bounds(upper, lower, memory_upper, memory_lower, rate_upper, rate_lower)


@inlined
def placed(way: int, t: float, row: Row, bounds: Bounds) -> tuple[int, float, Row, float, float]:
    """The mass exactly at the bumper that it touches."""
    x, v, s, c = row
    if way == ABOVE:
        x = bounds.upper + bounds.memory_upper
    elif way == BELOW:
        x = bounds.lower - bounds.memory_lower
    return way, t, Row(x, v, s, c), bounds.memory_upper, bounds.memory_lower


@kernel
def touched(
    plan: Vector, table: int, way: int, y: float, row: Row, bounds: Bounds
) -> tuple[int, float, Row, float, float]:
    """A contact y steps behind a state."""
    later = plan[table + H] * y
    return placed(way, later, travel(plan, table, y, row), faded(bounds, later))


@kernel
def flight(
    plan: Vector,
    slot: int,
    row: Row,
    bounds: Bounds,
    launched: int,
    released: bool,
    limit: float,
    age: float,
) -> tuple[int, float, Row, float, float]:
    """Go until the first contact or the limit.

    Parameters
    ----------
    plan : ndarray
        From `tables.build`.
    slot : int
        Which of its tables describes the motion.
    row : Row
        The state at the start.
    bounds : Bounds
        Where the free bumpers are, and their deformations away from the mass (m, ≥ 0).
    launched : int
        ABOVE or BELOW if the mass has just left that bumper, else WITHIN.
    released : bool
        Whether it left it from rest.
    limit : float
        How long to go at most (s).
    age : float
        How long this mode has lasted already (s).

    Returns
    -------
    way, t, row, memory_upper, memory_lower
        ABOVE, BELOW or WITHIN, the elapsed time (s), the state and the deformations there.
    """
    series = workspace()
    early = TABLES + SIZE * slot
    t = 0.0
    clear_upper = 0.0  # proven free of contact for so many steps from the window's start
    clear_lower = 0.0
    while True:
        late = early + LATE_TABLES
        table = late if age + t >= plan[late + VALID_FROM] else early
        h = plan[table + H]
        x, v = row.x, row.v
        bound = band(plan, table, x, v)
        second = 8.0 * bound  # per step squared
        span = (limit - t) * plan[table + RATE]
        if not launched and t == 0.0 and (x >= bounds.upper - bound or x <= bound + bounds.lower):
            # The mass may touch a bumper: about the start itself the series is exact there,
            # and the signs of its coefficients tell a contact from a parting.
            high = min(0.5, span)
            expand(plan, table + TAYLOR, row, series)
            y, way = search(series, bounds, h, 0.0, 0.0, high)
            if y != NONE:
                return touched(plan, table, way, y, row, bounds)
            clear_upper = clear_lower = high
        if launched:
            # A lower bound of the clearance just after detachment (theory, section 3.3).
            above = launched == ABOVE
            memory = bounds.memory_upper if above else bounds.memory_lower
            rate = (bounds.rate_upper if above else bounds.rate_lower) * h
            speed = (-v if above else v) * h
            clear = parted(memory, rate, speed, second)
            if clear < 1.0 and plan[table + LATE] == 0.0:
                rise, fall = bends(plan, table, row, second, 0.0, _AHEAD)
                near = parted(memory, rate, speed, rise if above else fall)
                clear = max(clear, min(near, _AHEAD))
            if clear < 1.0:
                high = min(0.5, span)
                expand(plan, table + TAYLOR, row, series)
                # The other bumper may be as near: where both gaps are zero it is.
                y, way = search(series, without(bounds, launched), h, 0.0, 0.0, high)
                again = leave(series, launched, released, memory, rate, high)
                if again < y:
                    y, way = again, launched
                if y != NONE:
                    return touched(plan, table, way, y, row, bounds)
                clear_upper = clear_lower = high
                clear = max(clear, high)
            # The bound on the second derivative holds for this window only.
            if above:
                clear_upper = min(clear, NODES)
            else:
                clear_lower = min(clear, NODES)
            launched = WITHIN
        way, i, y, end, up, down = walk(
            plan,
            table,
            _DISPLACEMENT,
            bounds,
            x,
            bound,
            row,
            span,
            clear_upper,
            clear_lower,
            clear_upper == 0.0 and clear_lower == 0.0,
            series,
        )
        if way != WITHIN:
            upper, lower, _, _, rate_upper, rate_lower = bounds
            here = Bounds(upper, lower, up, down, rate_upper, rate_lower)
            return placed(way, t + (i + y) * h, end, faded(here, y * h))
        if span <= NODES:
            row = ended(plan, table, row, span)
            bounds = faded(bounds, limit - t)
            return WITHIN, limit, row, bounds.memory_upper, bounds.memory_lower
        row = next_window(plan, table, row)
        bounds = faded(bounds, NODES * h)
        clear_upper = clear_lower = 0.0
        t += NODES * h
