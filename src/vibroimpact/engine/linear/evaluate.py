"""The motion of one phase at any time, from its table."""

from __future__ import annotations

import math

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.tables import (
    AMPLITUDE,
    COSINE,
    FINE,
    FINE_NODE,
    FORGOTTEN,
    LATE,
    LEFT_OUT,
    MIDDLE,
    NODE,
    ORDER,
    RATE,
    RESTING,
    ROW_V,
    SCALED_A,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SCALED_W,
    SINE,
    SIZE,
    TABLES,
    TAYLOR,
    WIDTH,
    H,
)
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import Row

_RADIUS = 1.0 / 40.0  # steps; how far a short series reaches


@kernel
def relaxed(deformation: float, rate: float, t: float) -> float:
    """A free bumper's deformation after the time t."""
    if deformation > 0.0:
        x = rate * t
        return deformation * math.exp(-x) if x < FORGOTTEN else 0.0
    return 0.0


@kernel
def turn(s: float, c: float, angle: float) -> tuple[float, float]:
    """The phasor (sin θ, cos θ) turned by a small angle (at most half a step)."""
    q = angle * angle
    sine = angle * (
        1 - q * (1 / 6 - q * (1 / 120 - q * (1 / 5040 - q * (1 / 362880 - q / 39916800))))
    )
    cosine = 1 - q * (
        1 / 2 - q * (1 / 24 - q * (1 / 720 - q * (1 / 40320 - q * (1 / 3628800 - q / 479001600))))
    )
    return s * cosine + c * sine, c * cosine - s * sine


@kernel
def product(plan: Vector, at: int, row: Row) -> float:
    """One linear function of the state row."""
    x, v, s, c = row
    pairs: float = (plan[at] * x + plan[at + 1] * v) + (plan[at + 2] * s + plan[at + 3] * c)
    total: float = pairs + plan[at + 4]
    return total


@kernel
def moved(plan: Vector, at: int, row: Row) -> Row:
    """The state at a node or fine point from the state at its origin."""
    x, v, s, c = row
    cosine = plan[at + COSINE]
    sine = plan[at + SINE]
    return Row(
        product(plan, at, row) + (plan[at + LEFT_OUT] * x + plan[at + LEFT_OUT + 1] * v),
        product(plan, at + ROW_V, row)
        + (plan[at + LEFT_OUT + 2] * x + plan[at + LEFT_OUT + 3] * v),
        s * cosine + c * sine,
        c * cosine - s * sine,
    )


@kernel
def node(plan: Vector, table: int, i: int, row: Row) -> Row:
    """The state at node i of the window."""
    if i == 0:
        return row
    return moved(plan, table + NODE + (i - 1) * WIDTH, row)


@kernel
def expand(plan: Vector, at: int, row: Row, series: Vector) -> None:
    """Write the long series about a state.

    `at` is where TAYLOR (for x) or TAYLOR_F (for the contact force) of a table begins.
    """
    x, v, s, c = row
    for n in range(ORDER):
        series[n] = (
            (plan[at + n] * x + plan[at + ORDER + n] * v)
            + (plan[at + 2 * ORDER + n] * s + plan[at + 3 * ORDER + n] * c)
        ) + plan[at + 4 * ORDER + n]


@kernel
def horner(series: Vector, y: float) -> tuple[float, float]:
    """Value and slope of a long series at y."""
    p = series[ORDER - 1]
    p1 = 0.0
    for n in range(ORDER - 2, -1, -1):
        p1 = p1 * y + p
        p = p * y + series[n]
    return p, p1


@kernel
def short_series(
    plan: Vector, table: int, row: Row
) -> tuple[float, float, float, float, float, float, float]:
    """Taylor coefficients a₀…a₆ of x in steps, from the equation of motion (early tables).

    Written so that each coefficient waits for one product only.
    """
    x, v, s, c = row
    sc = plan[table + SCALED_C]
    sk = plan[table + SCALED_K]
    wh = plan[table + SCALED_W]
    ww = wh * wh
    force = plan[table + SCALED_A] * s
    force1 = plan[table + SCALED_A] * wh * c
    a1 = v * plan[table + H]
    a2 = ((plan[table + SCALED_D] - force) * (1 / 2) - (sk * (1 / 2)) * x) - (sc * (1 / 2)) * a1
    a3 = (-force1 * (1 / 6) - (sk * (1 / 6)) * a1) - (sc * (1 / 3)) * a2
    a4 = (force * (ww * (1 / 24)) - (sk * (1 / 12)) * a2) - (sc * (1 / 4)) * a3
    a5 = (force1 * (ww * (1 / 120)) - (sk * (1 / 20)) * a3) - (sc * (1 / 5)) * a4
    a6 = (-force * (ww * ww * (1 / 720)) - (sk * (1 / 30)) * a4) - (sc * (1 / 6)) * a5
    return x, a1, a2, a3, a4, a5, a6


@kernel
def absolute_acceleration(plan: Vector, mode: int, row: Row) -> float:
    """ü + A_t from the state, mirrored as it is; at rest it is A_t."""
    x, v, s, _ = row
    table = TABLES + SIZE * mode
    if plan[table + RESTING] != 0.0:
        base: float = plan[AMPLITUDE] * s
        return base
    rate = plan[table + RATE]
    scaled: float = (plan[table + SCALED_D] - plan[table + SCALED_K] * x) - plan[
        table + SCALED_C
    ] * (v * plan[table + H])
    acceleration: float = scaled * (rate * rate)
    return acceleration


@kernel
def travel(plan: Vector, table: int, y: float, row: Row) -> Row:
    """The state y steps after a node, 0 ≤ y ≤ 1."""
    if plan[table + LATE] == 0.0:
        k = min(int(y * FINE + 0.5), FINE - 1)
        row = moved(plan, table + FINE_NODE + k * WIDTH, row)
        d = y - k * (1.0 / FINE)
        # The last fine point serves up to the end of the interval: d is 1/FINE at most.
        if d > _RADIUS:
            row = moved(plan, table + FINE_NODE + WIDTH, row)
            d -= 1.0 / FINE
        a0, a1, a2, a3, a4, a5, a6 = short_series(plan, table, row)
        x = a0 + d * (a1 + d * (a2 + d * (a3 + d * (a4 + d * (a5 + d * a6)))))
        # The change alone is scaled: step times rate need not be 1 to the last digit.
        change = d * (2 * a2 + d * (3 * a3 + d * (4 * a4 + d * (5 * a5 + d * (6 * a6)))))
        v = row.v + change * plan[table + RATE]
        s, c = turn(row.s, row.c, plan[table + SCALED_W] * d)
    else:
        row = moved(plan, table + MIDDLE, row)
        series = workspace()
        expand(plan, table + TAYLOR, row, series)
        x, v = horner(series, y - 0.5)
        v *= plan[table + RATE]
        s, c = turn(row.s, row.c, plan[table + SCALED_W] * (y - 0.5))
    return Row(x, v, s, c)
