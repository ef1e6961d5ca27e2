"""Exact extremes of displacement and absolute acceleration over a stretch of one phase.

The largest sample is never the maximum. On each table interval the long series is walked with
steps on which either the slope or the curvature provably keeps its sign, so that every local
extreme is found and polished (docs/theory.md, section 4).
"""

from __future__ import annotations

from vibroimpact.engine.crossing import series
from vibroimpact.engine.evaluate import absolute_acceleration, expand, moved, node
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.phase import (
    MIDDLE,
    NODE,
    NODES,
    ORDER,
    RATE,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SCRATCH,
    SIZE,
    TABLES,
    TAYLOR,
    VALID_FROM,
    WIDTH,
    H,
)

_SMALLEST = 2.0**-27  # a parabola rises by less than rounding over it


@kernel
def series_extremes(
    plan: Vector, low: float, high: float, least: float, most: float
) -> tuple[float, float, float, float]:
    """Extend [least, most] by the values of the series in the scratch over [low, high].

    Returns
    -------
    least, most, at_least, at_most
        The range, and where on the interval its ends lie (`low` where it was as wide before).
    """
    at_least = low
    at_most = low
    third = 0.0
    power = 1.0
    for n in range(3, ORDER):
        third += n * (n - 1) * (n - 2) * abs(plan[SCRATCH + n]) * power
        power *= 0.5
    p = low
    width = high - low
    f, f1, f2 = series(plan, p)
    least, most = min(least, f), max(most, f)
    while p < high:
        width = min(width, high - p)
        steep = abs(f1) > abs(f2) * width + 0.5 * third * width * width
        if not (steep or abs(f2) > third * width or width < _SMALLEST):
            width *= 0.5
            continue
        g, g1, g2 = series(plan, p + width)
        if not steep and f1 * g1 < 0.0:
            # One critical point: regula falsi kept in its bracket by Newton's slope.
            a, b = p, p + width
            y = a - f1 * width / (g1 - f1)
            for _ in range(60):
                e, e1, e2 = series(plan, y)
                if e < least:
                    least, at_least = e, y
                if e > most:
                    most, at_most = e, y
                if e1 * f1 > 0.0:
                    a = y
                else:
                    b = y
                new = y - e1 / e2 if e2 != 0.0 else 0.5 * (a + b)
                if not a < new < b:
                    new = 0.5 * (a + b)
                if abs(new - y) < 1e-10:  # the value is then right to 1e-20
                    break
                y = new
        p += width
        if g < least:
            least, at_least = g, p
        if g > most:
            most, at_most = g, p
        f1, f2 = g1, g2
        width *= 4.0
    return least, most, at_least, at_most


@kernel
def acceleration_series(plan: Vector, table: int) -> None:
    """Turn the series of x in the scratch into that of ü + A sin θ = d − k x − c x′, times h²."""
    for n in range(ORDER):
        after = plan[SCRATCH + n + 1] * (n + 1) if n + 1 < ORDER else 0.0
        plan[SCRATCH + n] = (
            -plan[table + SCALED_K] * plan[SCRATCH + n] - plan[table + SCALED_C] * after
        )
    plan[SCRATCH] += plan[table + SCALED_D]


@kernel
def stretch_extremes(
    plan: Vector, mode: int, x: float, v: float, s: float, c: float, length: float, age: float
) -> tuple[float, float, float, float]:
    """Extremes of x and of the absolute acceleration over `length` seconds of one phase.

    In contact x, v, s, c and the result are measured towards the bumper, as in
    `contact.contact`. One-sided values at both ends count.

    Returns
    -------
    x_least, x_most, a_least, a_most
    """
    x_least, x_most = x, x
    table = TABLES + SIZE * mode
    acceleration = absolute_acceleration(plan, mode, x, v)
    a_least, a_most = acceleration, acceleration
    t = 0.0
    while t < length:
        late = table + 3 * SIZE
        now = late if age + t >= plan[late + VALID_FROM] else table
        span = (length - t) * plan[now + RATE]
        square = plan[now + RATE] * plan[now + RATE]
        for i in range(NODES):
            if i >= span:
                break
            nx, nv, ns, nc = node(plan, now, i, x, v, s, c)
            mx, mv, ms, mc = moved(plan, now + MIDDLE, nx, nv, ns, nc)
            expand(plan, now + TAYLOR, mx, mv, ms, mc)
            high = min(0.5, span - i - 0.5)
            x_least, x_most, _, _ = series_extremes(plan, -0.5, high, x_least, x_most)
            acceleration_series(plan, now)
            least, most, _, _ = series_extremes(plan, -0.5, high, a_least / square, a_most / square)
            a_least, a_most = least * square, most * square
        x, v, s, c = moved(plan, now + NODE + (NODES - 1) * WIDTH, x, v, s, c)
        t += NODES * plan[now + H]
    return x_least, x_most, a_least, a_most
