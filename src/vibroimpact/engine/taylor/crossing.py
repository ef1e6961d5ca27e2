"""Where in a leap something first falls to zero: plain to see, or left to steps.

What is watched is g = level + by_x x + by_v v + by_z z. Between two nodes it keeps within
B d²/8 of its chord, d apart, where B bounds its second derivative by the sizes of the leap's
spectra; so a value above that at both ends excludes a root, and a chord that is steep enough makes
it the only one. What is neither, a grazing say, is UNSURE.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.roots import NONE
from vibroimpact.engine.taylor.layout import NODES, NODES_V, NODES_Z, SPECTRA
from vibroimpact.engine.taylor.leap import SPECTRUM_A, SPECTRUM_R
from vibroimpact.engine.taylor.nodes import COUNT, PLACES, spectrum

UNSURE = -1.0

_WIDEST = 0.0956
"""Between two nodes."""

_ONE = np.array([(2.0 * n + 1.0) / (n + 1.0) for n in range(COUNT)])
_TWO = np.array([-(n + 1.0) / (n + 2.0) for n in range(COUNT)])
# Of the recurrence of Legendre's polynomials.


class Watch(NamedTuple):
    """g but for the motion; its value and slope (per leap) at the start, and value at the end."""

    level: float
    by_x: float
    by_v: float
    by_z: float
    start: float
    slope: float
    end: float


class Bends(NamedTuple):
    """Bounds on the second derivatives of x, v and z, per leap squared."""

    x: float
    v: float
    z: float


@kernel
def bends(plan: Vector, h: float, hysteretic: bool) -> Bends:
    """How much the motion can bend on this leap."""
    x, v, z = 0.0, 0.0, 0.0
    for n in range(COUNT):
        size = abs(plan[SPECTRUM_A + n])
        x += size
        v += n * (n + 1) * size
    if hysteretic:
        for n in range(COUNT):
            z += n * (n + 1) * abs(plan[SPECTRUM_R + n])
    return Bends(x * h * h, v * h, z * h)


@kernel
def first_zero(
    plan: Vector, watch: Watch, bent: Bends, h: float, before: float, skip: int = 0
) -> float:
    """The first share of the leap, below `before`, at which g falls to zero; NONE, or UNSURE.

    Where g is zero at the start it rises from there. What is before node `skip` − 1 is passed over.
    """
    level, by_x, by_v, by_z, start, slope, end = watch
    bend = abs(by_x) * bent.x + abs(by_v) * bent.v + abs(by_z) * bent.z
    dip = bend * (0.125 * _WIDEST * _WIDEST)
    least = end
    for i in range(skip, COUNT):
        value = level + by_x * plan[NODES + i] + by_v * plan[NODES_V + i] + by_z * plan[NODES_Z + i]
        least = min(least, value)
    if least > dip and start > dip:
        return NONE
    a, left = 0.0 if skip == 0 else PLACES[skip - 1], start
    for i in range(skip, COUNT + 1):
        if a >= before:
            return NONE
        b, right = 1.0, end
        if i < COUNT:
            b = PLACES[i]
            right = (
                level + by_x * plan[NODES + i] + by_v * plan[NODES_V + i] + by_z * plan[NODES_Z + i]
            )
        wide = b - a
        secant = (right - left) / wide
        even = abs(secant) > bend * wide
        if right > 0.0:
            rises = start >= 0.0 and start + wide * (slope - 0.5 * bend * wide) > 0.0
            sure = even or min(left, right) > 0.125 * bend * wide * wide
            if not (i == 0 and rises) and not (left > 0.0 and sure):
                return UNSURE
        elif left > 0.0 and even:
            return polished(plan, watch, h, a, b, left, right)
        else:
            return UNSURE
        a, left = b, right
    return NONE


@kernel
def state_at(plan: Vector, y: float, hysteretic: bool) -> tuple[float, float, float, float, float]:
    """x, v, a, z and z′ at a share of the leap, by Clenshaw's sums over the spectra."""
    t = 2.0 * y - 1.0
    x1, x2, v1, v2, a1, a2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for n in range(COUNT - 1, -1, -1):
        one, two = _ONE[n] * t, _TWO[n]
        x1, x2 = plan[SPECTRA + n] + one * x1 + two * x2, x1
        v1, v2 = plan[SPECTRA + COUNT + n] + one * v1 + two * v2, v1
        a1, a2 = plan[SPECTRUM_A + n] + one * a1 + two * a2, a1
    z1, z2, r1, r2 = 0.0, 0.0, 0.0, 0.0
    if hysteretic:
        for n in range(COUNT - 1, -1, -1):
            one, two = _ONE[n] * t, _TWO[n]
            z1, z2 = plan[SPECTRA + 2 * COUNT + n] + one * z1 + two * z2, z1
            r1, r2 = plan[SPECTRUM_R + n] + one * r1 + two * r2, r1
    return x1, v1, a1, z1, r1


@kernel
def expand_nodes(plan: Vector, hysteretic: bool) -> None:
    """Write the spectra of x, v and z."""
    spectrum(plan, NODES, SPECTRA, 1.0, 0.0, 0.0)
    spectrum(plan, NODES_V, SPECTRA + COUNT, 1.0, 0.0, 0.0)
    if hysteretic:
        spectrum(plan, NODES_Z, SPECTRA + 2 * COUNT, 1.0, 0.0, 0.0)


@kernel
def polished(
    plan: Vector, watch: Watch, h: float, a: float, b: float, left: float, right: float
) -> float:
    """The only zero between a (g > 0) and b (g ≤ 0), g falling: Newton, guarded."""
    level, by_x, by_v, by_z, _, _, _ = watch
    hysteretic = by_z != 0.0
    expand_nodes(plan, hysteretic)
    y = a + (b - a) * left / (left - right)
    for _ in range(60):
        x, v, acceleration, z, rate = state_at(plan, y, hysteretic)
        g = level + by_x * x + by_v * v + by_z * z
        slope = h * (by_x * v + by_v * acceleration + by_z * rate)
        if g > 0.0:
            a = y
        else:
            b = y
        new = y - g / slope if slope < 0.0 else a
        if not a < new < b:
            if slope < 0.0 and abs(new - y) <= 1e-15:
                return y
            new = 0.5 * (a + b)
        if abs(new - y) <= 3e-10 or not a < new < b:
            return new
        y = new
    return y
