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
reported there, always, and the search continues after it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import ORDER

NONE = 9.0
"""Returned for "no root on the interval"; a root lies in [−1/2, 1/2]."""

_SMALLEST = 2.0**-50
_MOST = 20_000


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
    """f but for its series; `sign` is 1 or −1, `double` says that it leaves a double root."""

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
