"""The first root of a clearance or contact force on one interval, with certainty.

The function is f(y) = offset + sign·Σ a_n yⁿ + memory·E(rate·(y − start)), y in steps of the
phase's table, with E(x) = exp(−x), or
E(x) = exp(−x) − 1 + x where f leaves a double root.

From a point p with f > 0 the search tries a width w and does one of three things
(docs/theory.md, section 3, has the proof):

1. f cannot vanish: the cubic f(p) + f′(p) s + f″(p) s²/2 − J s³/6, with J ≥ |f‴|, lies below
   f; its four Bernstein coefficients on [0, w] are positive. Advance by w.
2. f falls all the way (the same bound on f′ is negative) and f(p + w) ≤ 0: exactly one root.
   Polish it between its bounds.
3. Neither: halve w.

A width at rounding level means that f touches zero to within rounding: no crossing is
reported there, always, and the search goes on behind it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import moved, short_series, turn
from vibroimpact.engine.linear.tables import FINE, FINE_NODE, ORDER, RATE, SCALED_W, WIDTH
from vibroimpact.engine.motion import Row

NONE = 9.0
"""Returned for "no root on the interval"; a root lies in [−1/2, 1/2]."""

_SMALLEST = 2.0**-50
_MOST = 20_000
_RADIUS = 1.0 / 40.0  # steps; how far a short series reaches


@kernel
def jet(series: Vector, y: float) -> tuple[float, float, float]:
    """Value and first two derivatives of a series at y."""
    p = 0.0
    p1 = 0.0
    p2 = 0.0
    for n in range(ORDER - 1, -1, -1):
        p2 = p2 * y + p1
        p1 = p1 * y + p
        p = p * y + series[n]
    return p, p1, 2.0 * p2


class Clearance(NamedTuple):
    """f but for its series; `double` says that it leaves a double root."""

    offset: float
    sign: float
    memory: float
    rate: float
    double: bool


@kernel
def value(
    series: Vector, clearance: Clearance, start: float, y: float
) -> tuple[float, float, float]:
    """f, f′ and f″ at y."""
    offset, sign, memory, rate, double = clearance
    p, p1, p2 = jet(series, y)
    f = offset + sign * p
    f1 = sign * p1
    f2 = sign * p2
    if memory > 0.0:
        x = rate * (y - start)
        e = math.exp(-x)
        f2 += rate * rate * memory * e
        if double:
            f1 -= rate * memory * math.expm1(-x)
            if x < 0.02:  # the series keeps the digits that exp(−x) − 1 + x cancels
                f += (
                    memory
                    * x
                    * x
                    * (
                        1 / 2
                        - x * (1 / 6 - x * (1 / 24 - x * (1 / 120 - x * (1 / 720 - x / 5040))))
                    )
                )
            else:
                f += memory * (math.expm1(-x) + x)
        else:
            f1 -= rate * memory * e
            f += memory * e
    return f, f1, f2


@kernel
def third_bound(series: Vector) -> float:
    """Bound on |Σ a_n yⁿ|‴ over |y| ≤ 1/2."""
    bound = 0.0
    power = 1.0
    for n in range(3, ORDER):
        bound += n * (n - 1) * (n - 2) * abs(series[n]) * power
        power *= 0.5
    return bound


@kernel
def polish(series: Vector, clearance: Clearance, start: float, low: float, high: float) -> float:
    """The only root between `low` (f > 0) and `high` (f ≤ 0), f falling: Newton, guarded."""
    y = 0.5 * (low + high)
    for _ in range(100):
        f, f1, _ = value(series, clearance, start, y)
        if f == 0.0:
            return y
        if f > 0.0:
            low = y
        else:
            high = y
        new = y - f / f1 if f1 < 0.0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - y) <= 1e-17 or not low < new < high:
            return new
        y = new
    return y


@kernel
def first_root(series: Vector, clearance: Clearance, low: float, high: float) -> float:
    """The first y in [low, high] at which f falls through zero, or NONE.

    `double` says that f and f′ vanish at `low` by construction, with a₀ = a₁ = offset = 0;
    otherwise f(low) ≥ 0 up to rounding, zero included.
    """
    _, _, memory, rate, double = clearance
    polynomial = third_bound(series)
    start = low
    p = low
    width = high - low
    for _ in range(_MOST):  # far more than any motion above the range of denormals needs
        if p >= high:
            break
        width = min(width, high - p)
        f, f1, f2 = value(series, clearance, start, p)
        if double and p == start:
            f = 0.0
            f1 = 0.0
        elif f <= 0.0:
            if f1 < 0.0:
                return p
            f = 0.0  # on the point of parting, to within rounding
        jerk = polynomial
        if memory > 0.0:
            jerk += rate * rate * rate * memory * math.exp(-rate * (p - start))
        while True:
            w = width
            b1 = f + f1 * w / 3.0
            b2 = f + 2.0 * f1 * w / 3.0 + f2 * w * w / 6.0
            b3 = f + f1 * w + 0.5 * f2 * w * w - jerk * w * w * w / 6.0
            # Where f is zero and does not fall, the next coefficients decide.
            if b1 >= 0.0 and b2 > 0.0 and b3 > 0.0:
                break
            s1 = f1 + 0.5 * f2 * w
            s2 = f1 + f2 * w + 0.5 * jerk * w * w
            if f1 < 0.0 and s1 < 0.0 and s2 < 0.0:
                end, _, _ = value(series, clearance, start, p + w)
                if end <= 0.0:
                    return polish(series, clearance, start, p, p + w)
            width = 0.5 * w
            if width < _SMALLEST:
                break
        if width < _SMALLEST:
            # A touch to within rounding; step over it.
            width = 4.0 * _SMALLEST
        p += width
        width *= 2.0
    return NONE


@kernel
def crossing_guess(earlier: float, before: float, now: float, level: float, j: int) -> float:
    """Where between nodes j − 1 and j the parabola through the last three meets the level."""
    rise = now - before
    y = (level - before) / rise
    if j > 1:
        y += 0.5 * (rise - (before - earlier)) * y * (1.0 - y) / rise
    return y


@kernel
def quick_root(
    plan: Vector,
    table: int,
    weight_x: float,
    weight_v: float,
    level: float,
    y: float,
    second: float,
    row: Row,
) -> tuple[float, Row]:
    """The first time at which weight_x·x + weight_v·x′ rises through `level`, if beyond doubt.

    Parameters
    ----------
    weight_x, weight_v : float
        The latter per step.
    y : float
        A guess, in steps after the node whose state is given; at the node the function is known
        to be below the level.
    second : float
        Bound on the second derivative, per step squared.

    Returns
    -------
    y, row
        The root and the state there; y = NONE where the root that is found is not certainly
        the first one. At a root with slope m the function stays below the level for
        2 m / second before it.
    """
    for _ in range(4):
        k = min(max(int(y * FINE + 0.5), 0), FINE - 1)
        point = moved(plan, table + FINE_NODE + k * WIDTH, row)
        a0, a1, a2, a3, a4, a5, a6 = short_series(plan, table, point)
        f0 = weight_x * a0 + weight_v * a1
        f1 = weight_x * a1 + weight_v * 2 * a2
        f2 = weight_x * a2 + weight_v * 3 * a3
        f3 = weight_x * a3 + weight_v * 4 * a4
        f4 = weight_x * a4 + weight_v * 5 * a5
        f5 = weight_x * a5 + weight_v * 6 * a6
        f6 = weight_x * a6
        inverse = 1.0 / f1
        e = (level - f0) * inverse
        b = f2 * inverse
        d = e * (1.0 - e * (b - e * (2.0 * b * b - f3 * inverse)))
        if not (f1 > 0.0 and abs(d) <= _RADIUS):
            # The guess was too far: go to the fine point nearest to the better one.
            new = min(max(k / FINE + d, 0.0), 1.0)
            if not (f1 > 0.0 and abs(d) < 1.0) or new == y:
                break
            y = new
            continue
        # Polynomials in pairs of terms: they wait for one another less than nested ones.
        dd = d * d
        dddd = dd * dd
        f = ((f0 + d * f1) + dd * (f2 + d * f3)) + dddd * ((f4 + d * f5) + dd * f6)
        slope = ((f1 + d * (2 * f2)) + dd * (3 * f3 + d * (4 * f4))) + dddd * (
            5 * f5 + d * (6 * f6)
        )
        fx = ((a0 + d * a1) + dd * (a2 + d * a3)) + dddd * ((a4 + d * a5) + dd * a6)
        # The change of the velocity alone, for step times rate need not be 1 to the last digit.
        change = (d * (2 * a2) + dd * (3 * a3 + d * (4 * a4))) + dddd * (5 * a5 + d * (6 * a6))
        fs, fc = turn(point.s, point.c, plan[table + SCALED_W] * d)
        # What is left is below 1e-8 steps. Not to wait for another division: 1 / slope to
        # second order, where that is as good.
        q = d * (2.0 * b + 3.0 * d * (f3 * inverse))
        e = (level - f) * inverse * (1.0 - q * (1.0 - q)) if abs(q) < 0.01 else (level - f) / slope
        y = k * (1.0 / FINE) + d + e
        if not abs(e) < 1e-8 or y < 0.0 or y > 1.0 or not 2.0 * slope > second * y:
            break
        fx += e * (a1 + change)
        change += e * (2 * a2 + d * (6 * a3 + d * 12 * a4))
        e *= plan[table + SCALED_W]
        fs, fc = fs + e * fc, fc - e * fs
        return y, Row(fx, point.v + change * plan[table + RATE], fs, fc)
    return NONE, row
