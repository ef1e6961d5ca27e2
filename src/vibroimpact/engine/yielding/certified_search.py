"""One interval of a table searched for all that may end a leg on it."""

from __future__ import annotations

import math

from vibroimpact.engine.event import CONTACT, DETACHMENT, LIMIT, TURN, YIELD, event_of
from vibroimpact.engine.forcing.dispatch import expand
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import moved
from vibroimpact.engine.linear.flight import leave
from vibroimpact.engine.linear.layout import MIDDLE, ORDER, RATE, TAYLOR, H, Row
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root
from vibroimpact.engine.linear.table_search import ABOVE, BELOW
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.yielding.monotone_motion import (
    AHEAD,
    BEGUN,
    BEHIND,
    FROM_AHEAD,
    FROM_BEHIND,
    LANDED,
    SOFTLY,
    MotionLimits,
)


@kernel
def careful(
    plan: Vector,
    table: int,
    leg: MotionLimits,
    row: Row,
    start: int,
    memory: float,
    behind_memory: float,
    low: float,
    high: float,
) -> tuple[int, float]:
    """What comes first between `low` and `high` steps behind a node, and when; LIMIT if nothing.

    `row` is the state at the node and the memories are those there. At a beginning (`start`) the
    series are those about the node itself, whose leading coefficients are exact.
    """
    way, stop, yields, _, rate, behind, _, behind_rate, push_x, push_v, push_0 = leg
    x, asked = workspace(), workspace()
    h, per_second = plan[table + H], plan[table + RATE]
    middle = 0.0
    if not start & BEGUN:
        middle = 0.5
        row = moved(plan, table + MIDDLE, row)
    expand(plan, table + TAYLOR, row, x)
    low, high = low - middle, high - middle
    if start & BEGUN and row.v == 0.0:
        x[1] = 0.0
        if start & SOFTLY or way * x[2] < 0.0:  # by rounding, for it goes that way
            x[2] = 0.0
    for n in range(ORDER - 1):
        asked[n] = (n + 1) * x[n + 1]
    asked[ORDER - 1] = 0.0
    event = TURN
    first = first_root(asked, Clearance(0.0, way, 0.0, 0.0, False), low, high)
    if push_x != 0.0:
        for n in range(ORDER):
            asked[n] = way * (push_x * x[n] + push_v * per_second * asked[n])
        asked[0] += push_0
        if start & LANDED:
            asked[0] = max(asked[0], 0.0)
        y = first_root(asked, Clearance(0.0, 1.0, 0.0, 0.0, False), low, high)
        if y < first:
            event, first = DETACHMENT, y
    if stop < math.inf and not start & FROM_AHEAD:
        y = first_root(x, Clearance(stop, -way, memory, rate * h, False), low, high)
        if y < first:
            event, first = event_of(CONTACT, AHEAD), y
    if yields < math.inf:
        y = first_root(x, Clearance(yields, -way, 0.0, 0.0, False), low, high)
        if y < first:
            event, first = YIELD, y
    if behind_memory > 0.0 and not start & FROM_BEHIND:
        clearance = Clearance(-behind, way, behind_memory, behind_rate * h, False)
        y = first_root(x, clearance, low, high)
        if y < first:
            event, first = event_of(CONTACT, BEHIND), y
    if start & (FROM_AHEAD | FROM_BEHIND):
        ahead = start & FROM_AHEAD != 0
        side = ABOVE if (way > 0.0) == ahead else BELOW
        if ahead:
            behind_memory, behind_rate = memory, rate
        y = leave(x, side, start & SOFTLY != 0, behind_memory, behind_rate * h, high)
        if y < first:
            event, first = event_of(CONTACT, AHEAD if ahead else BEHIND), y
    return (event, first + middle) if first != NONE else (LIMIT, NONE)
