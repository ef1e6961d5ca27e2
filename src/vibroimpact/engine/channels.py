"""What is observed of a motion: functions of time, each a power series on each piece of a stretch.

    piece, force = piece_buffer(), series_buffer()
    more = flow.first_piece(plan, before, ended, piece)
    while more:
        order = flow.series(plan, before, piece, FORCE, stop, force)
        ...
        more = flow.next_piece(plan, before, piece)

The loop must not end early: only after the last piece is the plan as it was. The value of a channel
is Σ series[j] τʲ, j ≤ order, plus FADING · exp(−RATE τ), with τ from 0 to 1 over the piece.
"""

from __future__ import annotations

import math

from vibroimpact.engine.assembly.layout import TERMS
from vibroimpact.engine.extreme_search import searching
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import ORDER
from vibroimpact.engine.memory import stack

DISPLACEMENT, VELOCITY, ACCELERATION, ABSOLUTE_ACCELERATION, CLEARANCE, FORCE, DEFORMATION = range(
    7
)
"""Of a mass: m, m/s, m/s² relative to the base and absolute; of a stop: m, N (of one mass per unit
mass, m/s²), m. A force that holds a mass by friction at rest on a stop is below 0."""

FADING, RATE = TERMS, TERMS + 1
SERIES = TERMS + 2
"""Length of a series."""

SINCE, LENGTH, OWN = range(3)
"""Of a piece: when it begins since the beginning of the stretch, and its length (s); then what the
flow keeps there."""

series_buffer = stack(SERIES)
CURSOR_SIZE = 15
"""Most numbers of a cursor, by which one mass goes from piece to piece (`pieces.write_cursor`)."""
piece_buffer = stack(OWN + 3 + ORDER + CURSOR_SIZE)
"""Room for them: of one mass three numbers, a series and a cursor (`one_mass.channels`)."""


@kernel
def evaluate(series: Vector, order: int, tau: float) -> float:
    """The value of a series."""
    total = 0.0
    for j in range(order, -1, -1):
        total = total * tau + series[j]
    if series[FADING] > 0.0:
        total += series[FADING] * math.exp(-series[RATE] * tau)
    return total


@kernel
def _jet(of: tuple[Vector, int], tau: float) -> tuple[float, float, float, float]:
    """Value and two slopes of a series, and a bound on the third one from there on."""
    series, order = of
    f, f1, f2, third = 0.0, 0.0, 0.0, 0.0
    for j in range(order, -1, -1):
        f2 = f2 * tau + f1
        f1 = f1 * tau + f
        f = f * tau + series[j]
        third += j * (j - 1) * (j - 2) * abs(series[j])
    f2 *= 2.0
    if series[FADING] > 0.0:
        rate = series[RATE]
        left = series[FADING] * math.exp(-rate * tau)
        f, f1, f2 = f + left, f1 - rate * left, f2 + rate * rate * left
        third += rate * rate * rate * left
    return f, f1, f2, third


_search = searching(_jet)


@kernel
def extremes(
    series: Vector, order: int, least: float, most: float
) -> tuple[float, float, float, float]:
    """Exact extremes of a series on its piece, if beyond `least` and `most`; and at which τ.

    A time τ on a piece is `ended[T] + piece[SINCE] + τ piece[LENGTH]` since the section.
    """
    return _search((series, order), 0.0, 1.0, least, most)  # type: ignore[no-any-return]


@kernel
def widen(series: Vector, order: int, span: Vector) -> None:
    """Widen a range, two numbers, by the values of a series on its piece: by exact extremes."""
    span[0], span[1], _, _ = extremes(series, order, span[0], span[1])
