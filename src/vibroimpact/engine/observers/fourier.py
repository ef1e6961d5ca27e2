"""The Fourier integrals of a motion, stretch by stretch, by the quadrature of its pieces."""

from __future__ import annotations

import math

from vibroimpact.engine.dispatch import (
    accelerated,
    begin,
    displacement,
    expanded,
    has_piece,
    next_piece,
)
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import horner
from vibroimpact.engine.linear.layout import ORDER, RATE, H
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import Stretch, direction
from vibroimpact.engine.observers.measure import ABSCISSAE, WEIGHTS

TURN = 8.0
"""What a line may turn (rad) over the points of one quadrature, for 12 points to be exact to
rounding."""

BEGINS, COUNT, INTERVAL = range(3)
"""Of the notes: when the section is (s), since the motion's beginning, the number of lines, and the
time between sections (s)."""
NOTES = 3

# Rows of what is found, a row a real number for each line: the integrals of u, u̇ and the absolute
# acceleration times cos and −sin νt. Of several masses, a row is one for each mass.
QUANTITIES = 6


@kernel
def integrate_stretch(
    plan: Vector, stretch: Stretch, notes: Vector, lines: Vector, out: Vector
) -> None:
    """Add the integrals of a stretch; `out` has QUANTITIES rows of a number for each line."""
    before, begun, count = stretch.before, notes[BEGINS] + stretch.t, int(notes[COUNT])
    series, forces = workspace(), workspace()
    sign = direction(before.mode)
    fastest = lines[count - 1]
    cursor = begin(plan, before, stretch.step)
    while has_piece(plan, cursor):
        h = plan[cursor.table + H]
        rate = plan[cursor.table + RATE]
        high, s, c = expanded(plan, cursor, series)
        for n in range(ORDER):
            forces[n] = series[n]
        unit = accelerated(plan, cursor, s, c, forces)
        parts = 1 + int(fastest * h / TURN)
        width = (high + 0.5) / parts
        for part in range(parts):
            for n in range(len(WEIGHTS)):
                y = width * (part + ABSCISSAE[n]) - 0.5
                x, slope = horner(series, y)
                a, _ = horner(forces, y)
                u, v = displacement(plan, before.mode, x), sign * slope * rate
                a *= sign * unit
                share = WEIGHTS[n] * width * h
                t = begun + cursor.t + (cursor.i + 0.5 + y) * h
                for k in range(count):
                    angle = lines[k] * t
                    cosine, sine = share * math.cos(angle), share * math.sin(angle)
                    out[k] += u * cosine
                    out[count + k] -= u * sine
                    out[2 * count + k] += v * cosine
                    out[3 * count + k] -= v * sine
                    out[4 * count + k] += a * cosine
                    out[5 * count + k] -= a * sine
        cursor = next_piece(plan, cursor)
