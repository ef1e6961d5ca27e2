"""A straight line between two samples of a record: the clock is A_t itself and its slope."""

from __future__ import annotations

import math

from vibroimpact.engine.forcing import harmonic
from vibroimpact.engine.forcing.wave import Wave
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import (
    AMPLITUDE,
    MOST,
    OMEGA,
    ORDER,
    SCALED_A,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SINE,
    STEEPEST,
    H,
    Row,
)

product = harmonic.product
expand = harmonic.expand
count = harmonic.count
plane = harmonic.plane
pull = harmonic.pull


@kernel
def begin(plan: Vector, amplitude: float, omega: float) -> None:
    """`amplitude` bounds |A_t| over the whole record, and `amplitude · omega` its slope."""
    plan[AMPLITUDE], plan[OMEGA] = 1.0, omega
    plan[MOST], plan[STEEPEST] = amplitude, amplitude * omega


@kernel
def pace(plan: Vector) -> float:
    """A line has no rate of its own."""
    return 0.0


@kernel
def wave(plan: Vector, n: int, mirrored: bool) -> Wave:
    """The line."""
    return Wave(1.0, 1.0, 0.0, 1.0, 0.0)


@kernel
def value(plan: Vector, s: float, c: float) -> float:
    """A_t."""
    return s


@kernel
def turned(plan: Vector, s: float, c: float, t: float) -> tuple[float, float]:
    """Further along the line."""
    return s + c * t, c


stepped = turned


@kernel
def release_time(
    plan: Vector, sign: float, level: float, s: float, c: float, limit: float
) -> tuple[float, float, float]:
    """When sign A_t first exceeds the level, within the limit: t, or infinity, and the clock."""
    push, rise = sign * s, sign * c
    if push > level or (push == level and rise >= 0.0):
        return 0.0, s, c
    if not rise > 0.0 or not (level - push) / rise < limit:
        return math.inf, s, c
    return (level - push) / rise, sign * level, c


@kernel
def short_series(
    plan: Vector, table: int, row: Row
) -> tuple[float, float, float, float, float, float, float]:
    """Taylor coefficients a₀…a₆ of x in steps, from the equation of motion (early tables)."""
    x, v, s, c = row
    sc = plan[table + SCALED_C]
    sk = plan[table + SCALED_K]
    force = plan[table + SCALED_A] * s
    force1 = plan[table + SCALED_A] * (plan[table + H] * c)
    a1 = v * plan[table + H]
    a2 = ((plan[table + SCALED_D] - force) * (1 / 2) - (sk * (1 / 2)) * x) - (sc * (1 / 2)) * a1
    a3 = (-force1 * (1 / 6) - (sk * (1 / 6)) * a1) - (sc * (1 / 3)) * a2
    a4 = -(sk * (1 / 12)) * a2 - (sc * (1 / 4)) * a3
    a5 = -(sk * (1 / 20)) * a3 - (sc * (1 / 5)) * a4
    a6 = -(sk * (1 / 30)) * a4 - (sc * (1 / 6)) * a5
    return x, a1, a2, a3, a4, a5, a6


@kernel
def turned_clock(plan: Vector, at: int, s: float, c: float) -> tuple[float, float]:
    """At a node or fine point, where SINE is the time from its origin."""
    return s + c * plan[at + SINE], c


@kernel
def turn(plan: Vector, s: float, c: float, angle: float) -> tuple[float, float]:
    """A part of a step later; the angle is a time."""
    return s + c * angle, c


nudged = turn


@kernel
def pull_series(plan: Vector, table: int, s: float, c: float, series: Vector) -> None:
    """Two terms."""
    series[0] = plan[table + SCALED_A] * s
    series[1] = plan[table + SCALED_A] * (plan[table + H] * c)
    for n in range(2, ORDER):
        series[n] = 0.0
