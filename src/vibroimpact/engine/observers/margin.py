"""How far a motion is from grazing: the least clearance it leaves, or depth it reaches."""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import horner, relaxed
from vibroimpact.engine.linear.layout import H
from vibroimpact.engine.linear.pieces import begin, expanded, following, more
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import FLIGHT, Stretch
from vibroimpact.engine.observe import observer


@kernel
def turning_point(series: Vector, high: float) -> float:
    """Where a series turns, on [−1/2, high], at whose ends its slope differs."""
    low = -0.5
    _, first = horner(series, low)
    for _ in range(60):
        middle = 0.5 * (low + high)
        _, slope = horner(series, middle)
        if slope * first > 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


class Margin(NamedTuple):
    """The least clearance left, or minus the least depth reached, where the mass turns (m)."""

    least: float


@observer(Margin)
def margin(plan: Vector, notes: Margin, stretch: Stretch) -> Margin:
    """Take the turning points of one stretch into account."""
    before = stretch.before
    gap_r, rate_r = plan[par.BUMPER + par.GAP], plan[par.BUMPER + par.RATE]
    gap_l, rate_l = plan[par.BUMPER + par.WIDTH + par.GAP], plan[par.BUMPER + par.WIDTH + par.RATE]
    best = notes.least
    series = workspace()
    cursor = begin(plan, before, stretch.step)
    while more(cursor):
        high, _, _ = expanded(plan, cursor, series)
        _, first = horner(series, -0.5)
        _, last = horner(series, high)
        if first * last < 0.0:
            y = turning_point(series, high)
            value, _ = horner(series, y)
            at = cursor.t + (cursor.i + 0.5 + y) * plan[cursor.table + H]
            if before.mode != FLIGHT:
                found = -value
            elif first > 0.0:
                found = gap_r + relaxed(before.right, rate_r, at) - value
            else:
                found = gap_l + relaxed(before.left, rate_l, at) + value
            if abs(found) < abs(best):
                best = found
        cursor = following(plan, cursor)
    return Margin(best)
