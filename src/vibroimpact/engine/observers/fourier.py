"""The Fourier integrals of a motion, stretch by stretch, by the quadrature of its pieces."""

from __future__ import annotations

import math

from vibroimpact.engine import event_loop, flow
from vibroimpact.engine.assembly.layout import STEP as TURNED
from vibroimpact.engine.channels import (
    ABSOLUTE_ACCELERATION,
    DISPLACEMENT,
    LENGTH,
    SINCE,
    VELOCITY,
    evaluate,
    piece_room,
    series_room,
)
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.quadrature import ABSCISSAE, WEIGHTS
from vibroimpact.engine.state import T

TURN = 8.0
"""What a line and a piece's series may turn (rad) over the points of one quadrature, for 12 points
to be exact to rounding."""

BEGINS, COUNT, INTERVAL = range(3)
"""Of the notes: when the section is (s), since the motion's beginning, the number of lines, and the
time between sections (s)."""
NOTES = 3

# Rows of what is found, a row a real number for each line: the integrals of u, u̇ and the absolute
# acceleration times cos and −sin νt. Of several masses, a row is one for each mass.
QUANTITIES = 6


@kernel
def _add(
    plan: Vector,
    before: Vector,
    ended: Vector,
    after: Vector,
    notes: Vector,
    lines: Vector,
    out: Vector,
) -> None:
    """Add the integrals of a stretch; `out` has QUANTITIES rows of a number for each line."""
    count, masses = int(notes[COUNT]), flow.coordinates(plan) // 2
    piece, of_u, of_v, of_a = piece_room(), series_room(), series_room(), series_room()
    row = masses * count
    more = flow.first_piece(plan, before, ended, piece)
    while more:
        length, begun = piece[LENGTH], notes[BEGINS] + ended[T] + piece[SINCE]
        parts = 1 + int(lines[count - 1] * length / (TURN - TURNED))
        for i in range(masses):
            flow.series(plan, before, piece, DISPLACEMENT, i, of_u)
            order = flow.series(plan, before, piece, VELOCITY, i, of_v)
            last = flow.series(plan, before, piece, ABSOLUTE_ACCELERATION, i, of_a)
            for k in range(parts * len(WEIGHTS)):
                tau = (k // len(WEIGHTS) + ABSCISSAE[k % len(WEIGHTS)]) / parts
                share = WEIGHTS[k % len(WEIGHTS)] * length / parts
                u, v = evaluate(of_u, order, tau), evaluate(of_v, order, tau)
                a = evaluate(of_a, last, tau)
                for line in range(count):
                    angle = lines[line] * (begun + tau * length)
                    cosine, sine = share * math.cos(angle), share * math.sin(angle)
                    at = i * count + line
                    out[at] += u * cosine
                    out[row + at] -= u * sine
                    out[2 * row + at] += v * cosine
                    out[3 * row + at] -= v * sine
                    out[4 * row + at] += a * cosine
                    out[5 * row + at] -= a * sine
        more = flow.next_piece(plan, before, piece)


integrate = event_loop.observed(_add)
