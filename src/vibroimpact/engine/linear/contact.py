"""Contact up to the detachment or a time limit, by the same walk as in `flight`."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import expand
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import scaled_acceleration, travel
from vibroimpact.engine.linear.layout import (
    FORCE,
    FORCE_0,
    FORCE_V,
    FORCE_X,
    LATE,
    LATE_TABLES,
    NODES,
    RATE,
    REST,
    SIZE,
    TABLES,
    TAYLOR_F,
    VALID_FROM,
    H,
    Row,
)
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root
from vibroimpact.engine.linear.table_search import WITHIN, Bounds, Watched, ended, next_window, walk
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.stops.kelvin_voigt import relieved

_PRESSING = Bounds(math.inf, 0.0, 0.0, 0.0, math.inf, math.inf)


@kernel
def contact(
    plan: Vector,
    slot: int,
    stop: int,
    row: Row,
    fresh: bool,
    limit: float,
    age: float,
) -> tuple[bool, float, Row]:
    """Stay in contact until the force stops pressing, or until the limit.

    Parameters
    ----------
    slot : int
        Which table of the plan describes the motion.
    stop : int
        Which stop is pressed.
    row : Row
        The state at the start.
    fresh : bool
        The contact begins here, so that its force is not negative by construction.
    plan, limit, age
        As in `flight`.

    Returns
    -------
    left, t, row
        Whether it stops pressing, the elapsed time (s), and the state there, mirrored as given.
    """
    series = workspace()
    at = par.stop_at(stop)
    stiffness = plan[at + par.BUMPER_STIFFNESS]
    damping = plan[at + par.BUMPER_DAMPING]
    early = TABLES + SIZE * slot
    late = early + LATE_TABLES
    t = 0.0
    while True:
        table = late if age + t >= plan[late + VALID_FROM] else early
        h = plan[table + H]
        x, v, _, _ = row
        band = (
            plan[table + FORCE_X] * abs(x - plan[table + REST])
            + plan[table + FORCE_V] * abs(v)
            + plan[table + FORCE_0]
        )
        second = 8.0 * band
        span = (limit - t) * plan[table + RATE]
        clear = 0.0
        f = stiffness * x + damping * v
        if fresh and plan[table + LATE] == 0.0:
            # F(t) ≥ F + F′ t − second t²/2 keeps the first steps positive.
            slope = stiffness * (v * h) + damping * plan[table + RATE] * scaled_acceleration(
                plan, table, row
            )
            clear = 2.0 * slope / second
            if not clear >= 1.0:
                # Slow landing: search about the contact point itself, where the force is not
                # negative by construction and the series has no rounding noise.
                high = min(0.5, span)
                expand(plan, table + TAYLOR_F, row, series)
                series[0] = max(series[0], 0.0)
                y = first_root(series, Clearance(0.0, 1.0, 0.0, 0.0, False), 0.0, high)
                if y != NONE:
                    return True, h * y, relieved(travel(plan, table, y, row), damping)
                clear = max(clear, high)
        fresh = False
        force = Watched(stiffness, damping * plan[table + RATE], FORCE, 5, TAYLOR_F)
        way, i, y, end, _, _ = walk(
            plan, table, force, _PRESSING, f, band, row, span, math.inf, clear, True, series
        )
        if way != WITHIN:
            return True, t + (i + y) * h, relieved(end, damping)
        if span <= NODES:
            return False, limit, ended(plan, table, row, span)
        row = next_window(plan, table, row)
        t += NODES * h
