"""An oscillator under a force that is a straight line: its motion in closed form, and its extremes.

All is in the unit of time 1/ω, in which it is f″ + 2ζ f′ + f = −(a + b x) with 0 ≤ ζ < 1. Its
displacement obeys that, and so do its velocity and its absolute acceleration, each with an a and a
b of its own, so that one search finds the extremes of all three.
"""

from __future__ import annotations

import math

from vibroimpact.engine.jit import kernel

_TERMS = 24
"""Of the series below x = 1, where closed forms lose digits."""
_AT_EITHER_END = 4
"""Half cycles that are searched, at the beginning and at the end of a line."""
_NEAR = 1e-9
"""Where an extreme is, as a share of a half cycle: its square is what the extreme is off by."""


@kernel
def responses(x: float, zeta: float) -> tuple[float, float, float]:
    """What an impulse, a step and a ramp of 1 have done after x: e, s and r.

    e″ + 2ζ e′ + e = 0 with e′(0) = 1, s′ = e, r′ = s, all 0 at 0.
    """
    if x < 1.0:
        before, term = 0.0, x
        impulse, step, ramp = 0.0, 0.0, 0.0
        for n in range(1, _TERMS):
            impulse += term
            part = term * x / (n + 1)
            step += part
            ramp += part * x / (n + 2)
            before, term = term, -(2.0 * zeta * n * x * term + x * x * before) / (n * (n + 1))
        return impulse, step, ramp
    rate = math.sqrt((1.0 - zeta) * (1.0 + zeta))
    faded = math.exp(-zeta * x)
    impulse = faded * math.sin(rate * x) / rate
    step = 1.0 - faded * math.cos(rate * x) - zeta * impulse
    return impulse, step, x - 2.0 * zeta * step - impulse


@kernel
def moved(
    f: float, g: float, a: float, b: float, zeta: float, reach: tuple[float, float, float]
) -> tuple[float, float]:
    """Move on: f and f′ = g after the x of which `reach` are the `responses`."""
    impulse, step, ramp = reach
    pull = f + a
    return (
        f + (impulse * g - step * pull - b * ramp),
        g - ((step + 2.0 * zeta * impulse) * g + impulse * pull + b * step),
    )


@kernel
def _turning(
    f: float,
    g: float,
    a: float,
    b: float,
    zeta: float,
    left: float,
    right: float,
    before: float,
    after: float,
) -> float:
    """|f| where f′ changes its sign between two x, between which it is monotone."""
    rising = before > 0.0
    x = left + (right - left) * before / (before - after)
    near = _NEAR * (right - left)
    for _ in range(60):
        value, slope = moved(f, g, a, b, zeta, responses(x, zeta))
        if (slope > 0.0) == rising:
            left = x
        else:
            right = x
        bend = -2.0 * zeta * slope - value - a - b * x
        further = x - slope / bend if bend != 0.0 else left
        if not left < further < right:
            further = 0.5 * (left + right)
        if abs(further - x) <= near:
            break
        x = further
    value, _ = moved(f, g, a, b, zeta, responses(x, zeta))
    return abs(value)


@kernel
def largest(
    f: float, g: float, a: float, b: float, zeta: float, end: float, last_f: float, last_g: float
) -> float:
    """The largest |f| for 0 < x ≤ end, from f and f′ = g at 0; at the end they are the last.

    f″ is a free oscillation, whose zeros are known; between two of them f′ is monotone. Of a long
    line the half cycles in the middle are left out: from cycle to cycle the maxima are the largest
    of functions that are convex in their number (a line and a decaying wave at the same phase), so
    that none of them exceeds both the first and the last; and so are the minima.
    """
    bend = -2.0 * zeta * g - f - a
    # On less than half a cycle f″ has one zero at most.
    if end < math.pi and bend * (-2.0 * zeta * last_g - last_f - a - b * end) > 0.0:
        if g * last_g < 0.0:
            return max(abs(last_f), _turning(f, g, a, b, zeta, 0.0, end, g, last_g))
        return abs(last_f)
    rate = math.sqrt((1.0 - zeta) * (1.0 + zeta))
    change = -2.0 * zeta * bend - g - b
    angle = math.atan2(bend, -(change + zeta * bend) / rate)
    if angle <= 0.0:
        angle += math.pi
    halves = math.floor((end * rate - angle) / math.pi) + 1.0
    left, slope = 0.0, g
    most = 0.0
    n = 0.0
    while left < end:
        if n == _AT_EITHER_END and n < halves - _AT_EITHER_END:
            n = halves - _AT_EITHER_END
            left = (angle + (n - 1.0) * math.pi) / rate
            _, slope = moved(f, g, a, b, zeta, responses(left, zeta))
        right = min((angle + n * math.pi) / rate, end)
        value, after = last_f, last_g
        if right < end:
            value, after = moved(f, g, a, b, zeta, responses(right, zeta))
        most = max(most, abs(value))
        if slope * after < 0.0:
            most = max(most, _turning(f, g, a, b, zeta, left, right, slope, after))
        left, slope = right, after
        n += 1.0
    return most
