"""The search for the extremes of a function whose third derivative is bounded.

The interval is walked with steps on which either the slope or the curvature provably keeps its
sign, so that every local extreme is found and polished (docs/theory.md, section 4).
"""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.jit import inlined

_SMALLEST = 2.0**-27  # a parabola rises by less than rounding over it


def searching(jet: Any) -> Any:
    """Make the search for the extremes of a function over [low, high].

    `jet(of, y)` gives its value, its first two derivatives, and a bound on the third one from there
    on. It extends [least, most], and returns as `series_extremes`.
    """

    def search(
        of: Any, low: float, high: float, least: float, most: float
    ) -> tuple[float, float, float, float]:
        at_least = low
        at_most = low
        p = low
        width = high - low
        f, f1, f2, third = jet(of, p)
        least, most = min(least, f), max(most, f)
        if not third < math.inf:
            return least, most, at_least, at_most  # of a motion that runs away
        while p < high:
            width = min(width, high - p)
            steep = abs(f1) > abs(f2) * width + 0.5 * third * width * width
            if not (steep or abs(f2) >= third * width or width < _SMALLEST):
                width *= 0.5
                continue
            g, g1, g2, beyond = jet(of, p + width)
            if not steep and f1 * g1 < 0.0:
                # One critical point: regula falsi kept in its bracket by Newton's slope.
                a, b = p, p + width
                y = a - f1 * width / (g1 - f1)
                for _ in range(60):
                    e, e1, e2, _ = jet(of, y)
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
            f1, f2, third = g1, g2, beyond
            width *= 4.0
        return least, most, at_least, at_most

    return inlined(search)
