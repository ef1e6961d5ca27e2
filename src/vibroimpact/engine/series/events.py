"""Where on a step something first falls to zero, with certainty.

What is watched is g = level + by_x x + by_v v + by_z z. A bound B on its second derivative over the
step, from the sizes of the coefficients, and its values and slopes at both ends decide the usual
cases: g stays above 0 where both values exceed B h²/8, and a slope that keeps its sign makes a zero
the only one. What is not plain that way, a grazing or a start from zero, is searched with the
certificate of the linear flow (`linear.roots`).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vibroimpact.engine.jit import Vector, inlined, kernel, not_inlined
from vibroimpact.engine.linear.flight import leave
from vibroimpact.engine.linear.layout import ORDER
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root
from vibroimpact.engine.linear.table_search import ABOVE, BELOW
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.series.layout import (
    A_A,
    A_T,
    A_V,
    A_X,
    ASKED,
    DEGREE,
    FOUND,
    X,
    Z,
)
from vibroimpact.engine.stops.kelvin_voigt import relaxed

NEVER = math.inf

PIECES = 2
"""In a step."""

_CLOSE = 3e-9
"""Of a step: a change of a root's estimate that makes the next one less than rounding."""

UNSURE = -1.0

_FINEST = 2.0**-7
"""Of a step: parts that are no longer are left to the search."""

_NEAR = 1e-8
"""Of a step: over so short a time a state follows from its rates to rounding."""


class Line(NamedTuple):
    """g as a function of the state."""

    level: float
    by_x: float
    by_v: float
    by_z: float


class Ends(NamedTuple):
    """A step of length h: the state and its rates at both ends, and bounds on x″, x‴ and z″."""

    h: float
    x: float
    v: float
    a: float
    z: float
    r: float
    x1: float
    v1: float
    a1: float
    z1: float
    r1: float
    bend: float
    jerk: float
    bend_z: float


class FreeFace(NamedTuple):
    """A stop's face that the mass may meet: what widens its clearance and how fast that fades.

    The memory is that of a time `since` before the step. `launched` says that the clearance
    vanishes at the step's beginning by construction, `released` that its rate and the rate of that
    do, too.
    """

    memory: float
    rate: float
    since: float
    launched: bool
    released: bool


FIXED = FreeFace(0.0, 0.0, 0.0, False, False)


def _shift(centre: float) -> np.ndarray:
    """Take a step's series to one about another point, in pieces: row m gives coefficient m."""
    table = np.zeros((ORDER, DEGREE + 1))
    for m in range(ORDER):
        for n in range(m, DEGREE + 1):
            table[m, n] = math.comb(n, m) * centre ** (n - m) / PIECES**m
    return table


_QUARTERS = np.array([_shift(0.25 * j) for j in range(5)])


@kernel
def shifted(plan: Vector, source: int, quarter: int, series: Vector) -> None:
    """Write a series of the step about so many quarters of it, in pieces."""
    for m in range(ORDER):
        even = 0.0
        odd = 0.0
        for n in range(m, DEGREE, 2):
            even += _QUARTERS[quarter, m, n] * plan[source + n]
            odd += _QUARTERS[quarter, m, n + 1] * plan[source + n + 1]
        if (DEGREE - m) % 2 == 0:
            even += _QUARTERS[quarter, m, DEGREE] * plan[source + DEGREE]
        series[m] = even + odd


@inlined
def verdict(g0: float, g1: float, d0: float, d1: float, bend: float, h: float) -> int:
    """Return 0 if g stays above 0 on (0, h], 1 if it falls to 0 once, 2 if neither is certain."""
    if min(g0, g1) > 0.125 * h * h * bend:
        return 0
    if abs(d0 + d1) > h * bend and d0 * d1 > 0.0:
        if d1 > 0.0:
            return 0 if g0 >= 0.0 else 2
        if g0 > 0.0:
            return 1 if g1 <= 0.0 else 0
    return 2


@inlined
def summed(plan: Vector, at: int, t: float) -> tuple[float, float, float]:
    """Value, rate and its rate of a series at a time, in two chains each."""
    square = t * t
    even, even1, even2 = plan[at + DEGREE], 0.0, 0.0
    odd, odd1, odd2 = plan[at + DEGREE - 1], 0.0, 0.0
    for n in range(DEGREE - 2, -1, -2):
        even2 = even2 * square + even1
        even1 = even1 * square + even
        even = even * square + plan[at + n]
        if n > 0:
            odd2 = odd2 * square + odd1
            odd1 = odd1 * square + odd
            odd = odd * square + plan[at + n - 1]
    # Of t²: d/dt = 2t d/d(t²).
    x = even + t * odd
    v = 2.0 * t * even1 + (odd + 2.0 * square * odd1)
    a = (2.0 * even1 + 8.0 * square * even2) + t * (6.0 * odd1 + 8.0 * square * odd2)
    return x, v, a


@kernel
def state_at(plan: Vector, t: float, hysteretic: bool) -> tuple[float, float, float, float, float]:
    """x, v, a, z and z′ at a time of the step."""
    x, v, a = summed(plan, X, t)
    z, r = 0.0, 0.0
    if hysteretic:
        z, r, _ = summed(plan, Z, t)
    return x, v, a, z, r


@inlined
def state_near(plan: Vector, t: float, h: float, hysteretic: bool) -> tuple[float, float, float]:
    """x, v and z at a time of the step, from where a zero was last looked for if it is as near."""
    past = t - plan[FOUND + A_T]
    if abs(past) <= _NEAR * h:
        x, v, a = plan[FOUND + A_X], plan[FOUND + A_V], plan[FOUND + A_A]
        x, v = x + past * (v + 0.5 * past * a), v + past * a
    else:
        x, v, _ = summed(plan, X, t)
    z = 0.0
    if hysteretic:
        z, _, _ = summed(plan, Z, t)
    return x, v, z


class Span(NamedTuple):
    """g and its slope at both ends of a part of the step."""

    a: float
    b: float
    ga: float
    gb: float
    da: float
    db: float


@kernel
def polished(plan: Vector, line: Line, h: float, span: Span) -> float:
    """The only zero on a span, g falling from above 0 to below: Halley's method, guarded.

    It begins where the inverse of g, a cubic by its values and slopes at both ends, is 0.
    """
    level, by_x, by_v, by_z = line
    a, b, ga, gb, da, db = span
    fall = ga - gb
    share = ga / fall
    rest = 1.0 - share
    t = a + share * share * (3.0 - 2.0 * share) * (b - a)
    t -= share * rest * fall * (rest / da - share / db)
    if not a < t < b:
        t = a + (b - a) * share
    for _ in range(60):
        x, v, acceleration, z, r = state_at(plan, t, by_z != 0.0)
        g = level + by_x * x + by_v * v + by_z * z
        slope = by_x * v + by_v * acceleration + by_z * r
        if g > 0.0:
            a = t
        else:
            b = t
        new = a
        if slope < 0.0:
            way = g / slope
            bend = by_x * acceleration / slope  # of which that of v and z is not known
            new = t - way * (1.0 + 0.5 * way * bend)
        if abs(new - t) <= _CLOSE * h:
            plan[FOUND + A_T] = t
            plan[FOUND + A_X], plan[FOUND + A_V], plan[FOUND + A_A] = x, v, acceleration
            return min(max(new, 0.0), h)
        if not a < new < b:
            new = 0.5 * (a + b)
            if not a < new < b:
                return new
        t = new
    return t


@kernel
def bisected(plan: Vector, line: Line, h: float, bend: float, whole: Span) -> float:
    """The first zero on the step, part by part until each is plain; `UNSURE` where none becomes so.

    `bend` bounds g″, and g rises from a beginning where it is 0.
    """
    level, by_x, by_v, by_z = line
    a, b, ga, gb, da, db = whole
    _, _, _, last, _, slope = whole
    while True:
        b = 0.5 * (a + b)
        if not b - a > _FINEST * h:
            return UNSURE
        x, v, acceleration, z, r = state_at(plan, b, by_z != 0.0)
        gb = level + by_x * x + by_v * v + by_z * z
        db = by_x * v + by_v * acceleration + by_z * r
        while True:
            plain = verdict(ga, gb, da, db, bend, b - a)
            if plain == 1:
                return polished(plan, line, h, Span(a, b, ga, gb, da, db))
            if plain == 2:
                break
            if not b < h:
                return NEVER
            a, ga, da = b, gb, db
            b, gb, db = h, last, slope


@kernel
def first_in_step(plan: Vector, clearance: Clearance, launched: bool, released: bool) -> float:
    """The first root of the event function, as a share of the step, or NONE."""
    offset, sign, memory, rate, _ = clearance
    buffer = workspace()
    pace = rate / PIECES  # per piece
    for part in range(3):
        low = 0.0 if part == 0 else -0.5
        high = 0.0 if part == 2 else 0.5
        shifted(plan, ASKED, 2 * part, buffer)
        left = memory
        if memory > 0.0 and part:
            left = relaxed(memory, rate, 0.5 * part - 0.25)
        if part == 0 and launched:
            way = ABOVE if sign < 0.0 else BELOW
            y = leave(buffer, way, released, left, pace, high)
        else:
            y = first_root(buffer, Clearance(offset, sign, left, pace, False), low, high)
        if y != NONE:
            return (part + y) / PIECES
    return NONE


@not_inlined
def searched(plan: Vector, line: Line, free: FreeFace, g0: float, still: bool, h: float) -> float:
    """The first zero on the step by the certificate of the linear flow; NEVER if there is none.

    `still` says that g and its rate are exactly 0 at the beginning.
    """
    level, by_x, by_v, by_z = line
    power = 1.0
    for n in range(DEGREE + 1):
        moved = by_x * plan[X + n]
        if by_v != 0.0 and n < DEGREE:
            moved += by_v * ((n + 1) * plan[X + n + 1])
        if by_z != 0.0 and n < DEGREE:
            moved += by_z * plan[Z + n]
        plan[ASKED + n] = moved * power
        power *= h
    sign = 1.0
    if free.launched:
        sign = -1.0 if by_x < 0.0 else 1.0
        if sign < 0.0:
            for n in range(DEGREE + 1):
                plan[ASKED + n] = -plan[ASKED + n]
    elif still:
        plan[ASKED], plan[ASKED + 1] = -level, 0.0
    else:
        plan[ASKED] = g0 - level
    clearance = Clearance(level, sign, free.memory, free.rate * h, False)
    y = first_in_step(plan, clearance, free.launched, free.released)
    return y * h if y != NONE else NEVER


@inlined
def first_zero(plan: Vector, line: Line, ends: Ends, g0: float) -> float:
    """When g first falls to zero on the step, from `g0` on; NEVER if it does not."""
    level, by_x, by_v, by_z = line
    g1 = level + by_x * ends.x1 + by_v * ends.v1 + by_z * ends.z1
    d0 = by_x * ends.v + by_v * ends.a + by_z * ends.r
    d1 = by_x * ends.v1 + by_v * ends.a1 + by_z * ends.r1
    bend = abs(by_x) * ends.bend + abs(by_v) * ends.jerk + abs(by_z) * ends.bend_z
    if verdict(g0, g1, d0, d1, bend, ends.h) == 0:
        return NEVER
    return zero_of(plan, line, ends.h, bend, Span(0.0, ends.h, g0, g1, d0, d1))


@not_inlined
def zero_of(plan: Vector, line: Line, h: float, bend: float, span: Span) -> float:
    """When g first falls to zero on a step on which it may; NEVER if it does not."""
    _, _, g0, g1, d0, d1 = span
    if verdict(g0, g1, d0, d1, bend, h) == 1:
        return polished(plan, line, h, span)
    if g0 > 0.0 or d0 > 0.0:
        t: float = bisected(plan, line, h, bend, span)
        if t != UNSURE:
            return t
    return searched(plan, line, FIXED, g0, False, h)


@inlined
def met(plan: Vector, level: float, sign: float, free: FreeFace, ends: Ends, faded: float) -> float:
    """When the mass first meets a face at `level` + sign x + memory exp(−rate t) = 0.

    A memory below `faded` does not move where it is met.
    """
    memory, _, _, launched, released = free
    g0 = level + sign * ends.x
    g1 = level + sign * ends.x1
    if launched and memory == 0.0:
        g0 = 0.0
    # Without a memory the clearance is less.
    d0, d1 = sign * ends.v, sign * ends.v1
    if verdict(g0, g1, d0, d1, ends.bend, ends.h) == 0 and not released:
        return NEVER
    span = Span(0.0, ends.h, g0, g1, d0, d1)
    return met_at(
        plan, Line(level, sign, 0.0, 0.0), free, ends.bend, ends.jerk, ends.a, ends.x, span, faded
    )


@not_inlined
def met_at(
    plan: Vector,
    line: Line,
    free: FreeFace,
    bend: float,
    jerk: float,
    gains: float,
    x: float,
    span: Span,
    faded: float,
) -> float:
    """When the mass first meets a face that it may meet on the step; NEVER if it does not."""
    memory, rate, since, launched, released = free
    _, h, g0, g1, d0, d1 = span
    t = UNSURE
    if verdict(g0, g1, d0, d1, bend, h) == 1:
        t = polished(plan, line, h, span)
    elif g0 >= 0.0 and not released and (g0 > 0.0 or d0 > 0.0):
        t = bisected(plan, line, h, bend, span)
    if t != UNSURE and (memory == 0.0 or relaxed(memory, rate, since + min(t, h)) <= faded):
        return t
    if t == NEVER:
        return t
    g0 = line.level + line.by_x * x
    if memory == 0.0:
        return searched(plan, line, free, 0.0 if launched else g0, False, h)
    memory = relaxed(memory, rate, since)
    if launched or (g0 < 0.0 and d0 >= rate * memory and g0 + memory >= 0.0):
        # It retreats no slower than the face relaxes. The clearance is then no less than
        # m (exp(−r t) − 1 + r t) − ∬ x″; the first part is above m r²t²/3 up to r t = 1, and above
        # its tangent there from then on.
        most = max(jerk * h - line.by_x * gains, 0.0)
        opens = memory * (0.632 * rate * h - 0.265)
        if memory * rate * rate > 1.5 * most and (rate * h < 1.0 or opens > 0.5 * most * h * h):
            return NEVER
    return searched(plan, line, FreeFace(memory, rate, 0.0, launched, released), g0, False, h)
