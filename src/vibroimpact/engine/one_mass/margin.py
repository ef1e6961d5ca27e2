"""How far a motion is from grazing: the least clearance it leaves, or depth it reaches.

Of an impact on a rigid stop it is the depth u̇² / 2 |ü| at which the mass would turn if the stop
were not there, to first order: it vanishes with the velocity, and beyond it a clearance is left.
"""

from __future__ import annotations

import math

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import horner
from vibroimpact.engine.linear.layout import ORDER, H
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root, jet
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import facing, stretch_of
from vibroimpact.engine.one_mass.motions import begin, expanded, has_piece, next_piece
from vibroimpact.engine.state import FLIGHT
from vibroimpact.engine.stops.kelvin_voigt import rate_of, relaxed
from vibroimpact.engine.stops.places import gap_of
from vibroimpact.engine.stops.rigid_events import impact_depth


@kernel
def leading_sign(series: Vector) -> float:
    """The sign that a series has on the first of [−1/2, 1/2]."""
    first, second, third = jet(series, -0.5)
    leading = first if first != 0.0 else second if second != 0.0 else third
    return math.copysign(1.0, leading)


@kernel
def slope_series(series: Vector, slope: Vector) -> float:
    """Write the derivative of a series; return the sign that it has on the first of [−1/2, 1/2]."""
    for n in range(ORDER - 1):
        slope[n] = (n + 1) * series[n + 1]
    slope[ORDER - 1] = 0.0
    return leading_sign(slope)


@kernel
def margin(plan: Vector, state: Vector, ended: Vector, end: Vector, notes: Vector) -> None:
    """Note the least clearance left, or minus the least depth reached, where the mass turns (m)."""
    stretch, best = stretch_of(state, ended, end), notes[0]
    before = stretch.before
    series, slope = workspace(), workspace()
    cursor = begin(plan, before, stretch.step)
    while has_piece(plan, cursor):
        high, _, _ = expanded(plan, cursor, series)
        way = slope_series(series, slope)
        y = -0.5
        # A short hop between two impacts turns twice within one piece.
        while True:
            y = first_root(slope, Clearance(0.0, way, 0.0, 0.0, False), y, high)
            if y == NONE:
                break
            value, _ = horner(series, y)
            at = cursor.t + (cursor.i + 0.5 + y) * plan[cursor.table + H]
            if before.mode != FLIGHT:
                distance = -value
            else:
                stop = 0 if way > 0.0 else 1
                left = relaxed(before.faces[stop], rate_of(plan, stop), at)
                distance = gap_of(plan, stop) + left - facing(stop) * value
            if abs(distance) < abs(best):
                best = distance
            way = -way
        cursor = next_piece(plan, cursor)
    depth = impact_depth(plan, stretch)
    if depth < abs(best):
        best = -depth
    notes[0] = best
