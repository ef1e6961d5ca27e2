"""The motion of one phase at any time, from its table."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import (
    expand,
    product,
    pull,
    short_series,
    turn,
    turned_clock,
)
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.layout import (
    BAND_0,
    BAND_V,
    BAND_X,
    FINE,
    FINE_NODE,
    LATE,
    LEFT_OUT,
    MIDDLE,
    NODE,
    ORDER,
    RADIUS,
    RATE,
    REST,
    RESTING,
    ROW_V,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SCALED_W,
    SIZE,
    TABLES,
    TAYLOR,
    WIDTH,
    H,
    Row,
)
from vibroimpact.engine.memory import workspace


@kernel
def moved(plan: Vector, at: int, row: Row) -> Row:
    """The state at a node or fine point from the state at its origin."""
    s, c = turned_clock(plan, at, row.s, row.c)
    return Row(
        product(plan, at, row) + (plan[at + LEFT_OUT] * row.x + plan[at + LEFT_OUT + 1] * row.v),
        product(plan, at + ROW_V, row)
        + (plan[at + LEFT_OUT + 2] * row.x + plan[at + LEFT_OUT + 3] * row.v),
        s,
        c,
    )


@kernel
def node(plan: Vector, table: int, i: int, row: Row) -> Row:
    """The state at node i of the window."""
    if i == 0:
        return row
    return moved(plan, table + NODE + (i - 1) * WIDTH, row)


@kernel
def band(plan: Vector, table: int, x: float, v: float) -> float:
    """A bound on |x″| h²/8 for a window from the state at its start (theory, section 3)."""
    displaced = plan[table + BAND_X] * abs(x - plan[table + REST])
    return displaced + plan[table + BAND_V] * abs(v) + plan[table + BAND_0]  # type: ignore[no-any-return]


@inlined
def scaled_acceleration(plan: Vector, table: int, row: Row) -> float:
    """x″ h² of a state."""
    x, v, s, c = row
    total: float = (
        (plan[table + SCALED_D] - pull(plan, table, s, c)) - plan[table + SCALED_K] * x
    ) - plan[table + SCALED_C] * (v * plan[table + H])
    return total


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
def absolute_acceleration(plan: Vector, mode: int, row: Row) -> float:
    """Acceleration in space from the state, mirrored as it is: ü + A_t, or ü on a still base."""
    x, v, s, c = row
    table = TABLES + SIZE * mode
    rate = plan[table + RATE]
    if plan[table + RESTING] != 0.0:
        return plan[par.BASE] * (pull(plan, table, s, c) * (rate * rate))  # type: ignore[no-any-return]
    scaled: float = (plan[table + SCALED_D] - plan[table + SCALED_K] * x) - plan[
        table + SCALED_C
    ] * (v * plan[table + H])
    if plan[par.BASE] == 0.0:
        scaled -= pull(plan, table, s, c)
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
        if d > RADIUS:
            row = moved(plan, table + FINE_NODE + WIDTH, row)
            d -= 1.0 / FINE
        a0, a1, a2, a3, a4, a5, a6 = short_series(plan, table, row)
        x = a0 + d * (a1 + d * (a2 + d * (a3 + d * (a4 + d * (a5 + d * a6)))))
        # The change alone is scaled: step times rate need not be 1 to the last digit.
        change = d * (2 * a2 + d * (3 * a3 + d * (4 * a4 + d * (5 * a5 + d * (6 * a6)))))
        v = row.v + change * plan[table + RATE]
        s, c = turn(plan, row.s, row.c, plan[table + SCALED_W] * d)
    else:
        row = moved(plan, table + MIDDLE, row)
        series = workspace()
        expand(plan, table + TAYLOR, row, series)
        x, v = horner(series, y - 0.5)
        v *= plan[table + RATE]
        s, c = turn(plan, row.s, row.c, plan[table + SCALED_W] * (y - 0.5))
    return Row(x, v, s, c)
