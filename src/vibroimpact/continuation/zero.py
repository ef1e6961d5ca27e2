"""A zero of a function along a curve, within one step."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import TypeVar

S = TypeVar("S")


def zero_within(
    begin: S, end: float, solved: Callable[[float], S | None], function: Callable[[S], float]
) -> tuple[S, float] | None:
    """Find the zero of a function of the solution within a step, to rounding.

    Ridders' method: bracketed, and quadratic on a smooth function.

    Parameters
    ----------
    begin
        The solution where the step begins.
    end
        Its length; the function has different signs at its ends.
    solved
        The solution after a part of the step, None if there is none.
    function
        Smooth along the curve.

    Returns
    -------
    tuple or None
        The solution and the length of step at the zero; None where a solution is missing.
    """
    a, b = 0.0, end
    fa = function(begin)
    found = solved(b)
    if found is None:
        return None
    fb = function(found)
    best = (abs(fb), found, b)
    for _ in range(60):
        middle = 0.5 * (a + b)
        if middle in (a, b) or fb == 0.0:
            break
        found = solved(middle)
        if found is None:
            return None
        fm = function(found)
        best = min(best, (abs(fm), found, middle), key=lambda item: item[0])
        root = math.sqrt(max(fm * fm - fa * fb, 0.0))
        if root == 0.0:
            break
        new = middle + (middle - a) * math.copysign(1.0, fa - fb) * fm / root
        if not a < new < b:
            break
        found = solved(new)
        if found is None:
            return None
        fn = function(found)
        best = min(best, (abs(fn), found, new), key=lambda item: item[0])
        if fn == 0.0 or b - a < 1e-15:
            break
        narrowed = False
        ends = sorted([(a, fa), (middle, fm), (new, fn), (b, fb)])
        for (x, fx), (y, fy) in itertools.pairwise(ends):
            if fx * fy <= 0.0:
                narrowed = (y - x) < (b - a)
                a, fa, b, fb = x, fx, y, fy
                break
        if not narrowed or abs(fn) < 1e-15:
            break
    return best[1], best[2]
