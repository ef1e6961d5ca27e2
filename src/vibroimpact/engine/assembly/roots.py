"""The first root of a Bernstein polynomial plus an exponential that decays, with proof.

f(x) = Σ b_j B_j(x) + d exp(−X x) on [0, 1], d ≥ 0. On a piece, the exponential is at least the
parabola that touches it at the left end and meets it at the right one, which has three terms in
Bernstein form. If all coefficients of the lower bound are positive, f has no root; if the slope's
upper bound is negative everywhere and f is not positive at the end, it has one. Otherwise the piece
is halved. What goes below zero by no more than rounding, or for less than 2⁻⁴⁶ of the step, is a
touch and is passed over.
"""

from __future__ import annotations

import math

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.vectors import halve
from vibroimpact.engine.jit import Vector, inlined, kernel, not_inlined
from vibroimpact.engine.memory import beyond, stack

NONE = 9.0
_D = at.DEGREE
_BINOMIALS = tuple(float(math.comb(at.DEGREE, i)) for i in range(at.DEGREE + 1))
_NARROW = 2.0**-46
_terms = stack(at.DEGREE + 1)
_MOST_SPLITS = 10_000
"""No polynomial needs so many but by an error; `UNDECIDED` counts those that do."""
_CLOSE = 2e-6
"""A step by less than this, as a share of the place, leaves its cube: less than rounding."""
_LONG = 4.0
"""Relaxation times on a piece from which its memory is left out of the lower bound."""


@not_inlined
def first_fall(
    b: Vector,
    d: float,
    x_rate: float,
    end: float,
    zeros: int,
    noise: float,
    plan: Vector,
    grows: bool = False,
) -> float:
    """The first x ≤ end at which f falls through zero, or NONE; b is overwritten.

    `zeros`: the order of the zero at 0 that is there by construction; `noise`: by how much f may be
    below zero by rounding; `grows`: from a zero at 0 on, before which terms are exact.
    """
    if zeros == 0 and b[0] + d <= 0.0:  # rounding has put it below zero, or it is on its way there
        if _D * (b[1] - b[0]) - x_rate * d < -noise:
            return 0.0
        zeros = 1
    begin_at_zero(b, d, x_rate, zeros)
    buffer, widths = int(plan[at.ROOM]), int(plan[at.WIDTHS])
    left, width, waiting, splits = 0.0, 1.0, 0, 0
    while left < end:
        e = d * math.exp(-x_rate * left) if d > 0.0 and left > 0.0 else d
        x = x_rate * width
        known = zeros if left == 0.0 else 0
        last = e * math.exp(-x) if e > 0.0 else 0.0
        # Coefficients that are off by `noise`, but for the first, are a polynomial below this.
        grown = noise * min(_D * (left + width), 1.0) if grows and zeros > 0 else noise
        sunk = b[_D] + last <= -grown
        free = not sunk and positive(b, e, x, last, known, grown)
        if not free and b[_D] + last <= 0.0 and falling(b, e, x, last, known):
            if known > 0:
                return 0.0
            root = left + width * only_root(b, e, x)
            return root if root <= end else NONE
        if not free and width > _NARROW:
            splits += 1
            plan[at.SPLITS] += 1.0
            if splits > _MOST_SPLITS:
                plan[at.UNDECIDED] += 1.0
                return NONE
            # With a zero at the left, the exponential must be followed there to its curvature.
            cut = 3.0 / x if e > 0.0 and x > _LONG and known > 0 else 0.5
            if cut == 0.5:
                halve(b, beyond(plan, buffer + 16 * waiting))
            else:
                split(b, cut, beyond(plan, buffer + 16 * waiting))
            plan[widths + waiting] = width * (1.0 - cut)
            width *= cut
            waiting += 1
            continue
        if waiting == 0:
            return NONE
        waiting -= 1
        left += width
        width = plan[widths + waiting]
        for j in range(_D + 1):
            b[j] = plan[buffer + 16 * waiting + j]
    return NONE


@kernel
def begin_at_zero(b: Vector, d: float, x_rate: float, zeros: int) -> None:
    """Take the terms off that are zero by construction, but for rounding: on the whole step.

    A flight after an impact may be lower than the rounding of its clearance.
    """
    if zeros > 0:
        off = b[0] + d
        for j in range(_D + 1):
            b[j] -= off
        b[0] = -d
    if zeros > 1:
        off = b[1] - b[0] - x_rate * d / _D
        for j in range(1, _D + 1):
            b[j] -= off * j
        b[1] = b[0] + x_rate * d / _D
    if zeros > 2:
        off = b[2] - 2.0 * b[1] + b[0]
        for j in range(2, _D + 1):
            b[j] -= off * (0.5 * j * (j - 1))
        b[2] = 2.0 * b[1] - b[0]
    for k in range(3, zeros):  # without a memory
        off, times = b[k], 1.0
        for j in range(k, _D + 1):
            b[j] -= off * times
            times *= (j + 1) / (j + 1 - k)


@inlined
def positive(b: Vector, e: float, x: float, last: float, known: int, noise: float) -> bool:
    """Whether f is proved positive on (0, 1], but for its known zeros at 0."""
    is_positive = True
    if e == 0.0 or x > _LONG:
        if e > 0.0 and known > 0:
            return False
        for j in range(_D + 1):
            is_positive &= (b[j] > -noise) | (j < known)
        return is_positive
    if x > 0.1:
        bowl = last - e * (1.0 - x)
    else:
        bowl = e * x * x * (0.5 - x * (1 / 6 - x * (1 / 24 - x * (1 / 120 - x / 720))))
    for j in range(_D + 1):
        line = j * (1.0 / _D)
        square = line * ((j - 1) * (1.0 / (_D - 1)))
        is_positive &= (b[j] + e * (1.0 - x * line) + bowl * square > -noise) | (j < known)
    return is_positive


@inlined
def falling(b: Vector, e: float, x: float, last: float, known: int) -> bool:
    """Whether f is proved to fall all the way; a slope that is zero by construction may be so."""
    is_falling = True
    for j in range(_D):
        is_falling &= (_D * (b[j + 1] - b[j]) - x * last < 0.0) | ((e == 0.0) & (j < known - 1))
    return is_falling


@kernel
def split(b: Vector, cut: float, right: Vector) -> None:
    """De Casteljau: b becomes the part before the cut, `right` the part after it."""
    rest = 1.0 - cut
    for k in range(_D):
        right[_D - k] = b[_D]
        for j in range(_D, k, -1):
            b[j] = b[j] * cut + rest * b[j - 1]
    right[0] = b[_D]


@kernel
def only_root(b: Vector, e: float, x: float) -> float:
    """The root of a falling f in [0, 1], by Halley's method within a bracket."""
    low, high, t = 0.0, 1.0, 1.0
    before, memory = b[0] + e, e
    decay = math.exp(-x / _D) if e > 0.0 else 0.0
    for j in range(1, _D + 1):  # where the control polygon crosses
        memory *= decay
        here = b[j] + memory
        if here <= 0.0:
            t = (j - 1 + before / (before - here)) / _D if before > 0.0 else 0.0
            break
        before = here
    near, c = t <= 0.5, _terms()
    for i in range(_D + 1):
        c[i] = _BINOMIALS[i] * (b[i] if near else b[_D - i])
    for _ in range(60):
        f, slope, bend = value(c, t if near else 1.0 - t)
        slope = slope if near else -slope
        if e > 0.0:
            memory = e * math.exp(-x * t)
            f += memory
            slope -= x * memory
            bend += x * x * memory
        if f > 0.0:
            low = t
        else:
            high = t
        # Halley's step, or Newton's where the curve bends too much.
        new = low
        if slope < 0.0:
            square = slope * slope
            curved = 2.0 * square - f * bend
            halley = curved > square
            new = t - (2.0 * f * slope if halley else f) / (curved if halley else slope)
        if not low <= new <= high:
            new = 0.5 * (low + high)
        if abs(new - t) <= _CLOSE * max(t, 0.0625):
            return new
        t = new
    return t


@inlined
def value(c: Vector, x: float) -> tuple[float, float, float]:
    """Value, slope and second derivative of Σ c_i xⁱ (1 − x)^(D − i), near 0.

    It is (1 − x)^D S(r) with r = x / (1 − x); even and odd powers are summed apart.
    """
    rest = 1.0 - x
    once = 1.0 / rest
    ratio = x * once
    again = ratio * ratio
    even, odd, even_slope, odd_slope, even_bend, odd_bend = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(_D - 1, -1, -2):
        even_bend = even_bend * again + even_slope
        odd_bend = odd_bend * again + odd_slope
        even_slope = even_slope * again + even
        odd_slope = odd_slope * again + odd
        even = even * again + c[i]
        odd = odd * again + c[i + 1]
    total = even + ratio * odd
    slope = odd + 2.0 * ratio * (even_slope + ratio * odd_slope)
    bent = 6.0 * odd_slope + 8.0 * ratio * (even_bend + ratio * odd_bend)
    bend = 2.0 * even_slope + ratio * bent
    square = rest * rest
    fourth = square * square
    before = fourth * fourth * fourth * rest  # rest^(D − 2)
    turned = _D * rest * total - slope
    return (
        before * square * total,
        -before * turned,
        before * once * (bend * once + (_D - 1.0) * (turned - slope)),
    )
