"""The rows of one table: what the motion is at its nodes and points, and about any point.

They follow from the power series of x″ = −c x′ − k x + d − A_t from each unit state row.
"""

from __future__ import annotations

import math

from vibroimpact.engine.forcing.wave import Wave
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import (
    COLUMNS,
    COSINE,
    FINE,
    FINE_NODE,
    FORCE,
    LATE,
    LEFT_OUT,
    NODE,
    NODES,
    ORDER,
    ROW_V,
    SINE,
    TAYLOR,
    TAYLOR_F,
    WIDTH,
    H,
)
from vibroimpact.engine.linear.oscillation import oscillation
from vibroimpact.engine.memory import stack

_SERIES = ORDER + 6

coefficients = stack(_SERIES * COLUMNS)
"""Room for the series that the tables are made from, a row a term."""


@kernel
def _unit(wave: Wave, column: int) -> tuple[float, float]:
    """What the wave pulls if only this column of the state row is 1, and its quarter turn."""
    if column == 2:
        return wave.sine, -wave.cosine
    if column == 3:
        return wave.cosine, wave.sine
    return 0.0, 0.0


@kernel
def power_series(h: float, c: float, k: float, d: float, wave: Wave, out: Vector) -> None:
    """Taylor coefficients (times hⁿ) of x from each unit state row: out[n COLUMNS + column]."""
    wh = wave.rate * h
    squared = wave.closes * wh * wh
    for column in range(COLUMNS):
        out[column] = 1.0 if column == 0 else 0.0
        out[COLUMNS + column] = h if column == 1 else 0.0
        constant = d if column == 4 else 0.0
        now, quarter = _unit(wave, column)
        after = wh * quarter
        for n in range(_SERIES - 2):
            force = constant - wave.amplitude * now
            constant = 0.0
            out[(n + 2) * COLUMNS + column] = (
                -c * h * (n + 1) * out[(n + 1) * COLUMNS + column]
                - k * h * h * out[n * COLUMNS + column]
                + force * h * h
            ) / ((n + 1) * (n + 2))
            now, after = after, -squared * now / ((n + 1) * (n + 2))


@kernel
def swing_of(c: float, k: float, wave: Wave) -> tuple[float, float]:
    """The motion p·(what pulls) + q·(its quarter turn) that follows a wave when all else is gone.

    A line pulls x along at a distance; what is called its quarter turn is its slope.
    """
    stiff = k - wave.closes * wave.rate * wave.rate
    norm = stiff * stiff + wave.closes * c * c * wave.rate * wave.rate
    return -wave.amplitude * stiff / norm, wave.amplitude * c * wave.rate / norm


@kernel
def late_series(
    h: float, c: float, k: float, d: float, wave: Wave, fast: float, slow: float, out: Vector
) -> None:
    """As `power_series`, of what is left when the fast part has decayed.

    `fast` and `slow` are the decay rates of an overdamped phase, or `slow` is 0 for an
    oscillation that has died out altogether.
    """
    p, q = swing_of(c, k, wave)
    wh = wave.rate * h
    squared = wave.closes * wh * wh
    for column in range(COLUMNS):
        # The particular solution and d/k, and the slow mode z exp(−slow t).
        x = 1.0 if column == 0 else 0.0
        v = 1.0 if column == 1 else 0.0
        s, co = _unit(wave, column)
        one = 1.0 if column == 4 else 0.0
        turned = p * co - wave.closes * q * s
        z = 0.0
        if slow > 0.0:
            z = (v - wave.rate * turned + fast * (x - p * s - q * co - one * d / k)) / (fast - slow)
        now, after = p * s + q * co, wh * turned
        for n in range(_SERIES):
            out[n * COLUMNS + column] = now + z
            now, after = after, -squared * now / ((n + 1) * (n + 2))
            z *= -slow * h / (n + 1)
    # Of d/k and the slow mode from it next to nothing is left where the spring is weak.
    out[COLUMNS - 1] = -d / (fast * (fast - slow)) if slow > 0.0 else d / k


@kernel
def expanded_at(series: Vector, y: float, h: float, wave: Wave, plan: Vector, at: int) -> None:
    """Rows at y steps from a series."""
    for column in range(COLUMNS):
        x = 0.0
        v = 0.0
        for n in range(_SERIES - 1, 0, -1):
            x = x * y + series[n * COLUMNS + column]
            v = v * y + n * series[n * COLUMNS + column]
        plan[at + column] = x * y + series[column]
        plan[at + ROW_V + column] = v / h
    angle = wave.rate * h * y
    plan[at + COSINE] = math.cos(angle) if wave.closes != 0.0 else 1.0
    plan[at + SINE] = math.sin(angle) if wave.closes != 0.0 else angle
    for i in range(LEFT_OUT, WIDTH):
        plan[at + i] = 0.0


@kernel
def compose(plan: Vector, first: int, then: int, out: int, closes: float) -> None:
    """Rows of one stretch of time followed by another."""
    cosine, sine = plan[first + COSINE], plan[first + SINE]
    for i in range(2):
        b = then + i * ROW_V
        o = out + i * ROW_V
        for column in range(COLUMNS):
            plan[o + column] = (
                plan[b] * plan[first + column] + plan[b + 1] * plan[first + ROW_V + column]
            )
        plan[o + 2] += plan[b + 2] * cosine - closes * plan[b + 3] * sine
        plan[o + 3] += plan[b + 2] * sine + plan[b + 3] * cosine
        plan[o + 4] += plan[b + 4]
    turn_c, turn_s = plan[then + COSINE], plan[then + SINE]
    plan[out + COSINE] = cosine * turn_c - closes * sine * turn_s
    plan[out + SINE] = sine * turn_c + cosine * turn_s
    for i in range(LEFT_OUT, WIDTH):
        plan[out + i] = 0.0


@kernel
def oscillate(plan: Vector, at: int, t: float, c: float, k: float) -> None:
    """The free oscillation in the rows of the time t, in closed form."""
    x_of_x, x_of_v, v_of_x, v_of_v, out, swing, pull = oscillation(t, c, k)
    plan[at], plan[at + 1] = x_of_x, x_of_v
    plan[at + ROW_V], plan[at + ROW_V + 1] = v_of_x, v_of_v
    plan[at + LEFT_OUT], plan[at + LEFT_OUT + 1] = out, swing
    plan[at + LEFT_OUT + 2], plan[at + LEFT_OUT + 3] = pull, out


@kernel
def fill(
    plan: Vector,
    table: int,
    series: Vector,
    wave: Wave,
    stiffness: float,
    damping: float,
    contact: bool,
    c: float,
    k: float,
) -> None:
    """Lay out nodes, fine points and long series of one table."""
    h = plan[table + H]
    oscillates = plan[table + LATE] == 0.0 and k > 0.25 * c * c
    expanded_at(series, 0.0, h, wave, plan, table + FINE_NODE)
    for n in range(1, FINE):
        at = table + FINE_NODE + n * WIDTH
        if n == 1:
            expanded_at(series, 1.0 / FINE, h, wave, plan, at)
        else:
            compose(plan, table + FINE_NODE + WIDTH, at - WIDTH, at, wave.closes)
        if oscillates:
            oscillate(plan, at, n * h / FINE, c, k)
    for n in range(NODES):
        at = table + NODE + n * WIDTH
        if n == 0:
            expanded_at(series, 1.0, h, wave, plan, at)
        else:
            compose(plan, table + NODE, at - WIDTH, at, wave.closes)
        if oscillates:
            oscillate(plan, at, (n + 1) * h, c, k)
    for column in range(5):
        for n in range(ORDER):
            plan[table + TAYLOR + column * ORDER + n] = series[n * COLUMNS + column]
    if not contact:
        return
    for n in range(NODES):
        for column in range(5):
            at = table + NODE + n * WIDTH + column
            plan[table + FORCE + n * 5 + column] = stiffness * plan[at] + damping * plan[at + ROW_V]
    for column in range(5):
        for n in range(ORDER):
            plan[table + TAYLOR_F + column * ORDER + n] = (
                stiffness * series[n * COLUMNS + column]
                + damping * (n + 1) * series[(n + 1) * COLUMNS + column] / h
            )
