"""Zeros of a function along a curve, within one step."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import TypeVar

S = TypeVar("S")

_NEAR = 0.5
"""Of the least value known, below which a parabola must lead to be followed."""
_TRIES = 8
_SAME = 1e-7
"""Of the step, by which two of its shares differ at least."""


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
    solution = solved(b)
    if solution is None:
        return None
    fb = function(solution)
    best = (abs(fb), solution, b)
    for _ in range(60):
        middle = 0.5 * (a + b)
        if middle in (a, b) or fb == 0.0:
            break
        solution = solved(middle)
        if solution is None:
            return None
        fm = function(solution)
        best = min(best, (abs(fm), solution, middle), key=lambda item: item[0])
        root = math.sqrt(max(fm * fm - fa * fb, 0.0))
        if root == 0.0:
            break
        new = middle + (middle - a) * math.copysign(1.0, fa - fb) * fm / root
        if not a < new < b:
            break
        solution = solved(new)
        if solution is None:
            return None
        fn = function(solution)
        best = min(best, (abs(fn), solution, new), key=lambda item: item[0])
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


def between_zeros(
    ends: tuple[float, float],
    mean: float,
    end: float,
    solved: Callable[[float], S | None],
    function: Callable[[S], float],
) -> tuple[S, float] | None:
    """Find where a function has another sign than at both ends of a step, if it has.

    Parabolas lead to where it comes nearest to zero: first that which has its values at the ends
    and its mean, then those through three of its values.

    Parameters
    ----------
    solved
        The solution after a part of the step, None if there is none.
    function
        Smooth along the curve.

    Returns
    -------
    tuple or None
        A solution between two zeros, and the length of step there; None if none was found.
    """
    sign = math.copysign(1.0, ends[0])
    a, b = sign * ends[0], sign * ends[1]
    # x = 1/2 has the value that Simpson's rule gives the mean with.
    known = [(0.0, a), (0.5, 1.5 * sign * mean - 0.25 * (a + b)), (1.0, b)]
    for number in range(_TRIES):
        share, value = _vertex(known)
        # Far from zero the parabola is believed; close to it the function is looked at.
        lowest = min(a, b) if number == 0 or known[1][1] < _NEAR * min(a, b) else known[1][1]
        if not (known[0][0] < share < known[2][0] and value < _NEAR * lowest):
            return None
        if abs(share - known[1][0]) < _SAME and number:
            return None
        solution = solved(share * end)
        if solution is None:
            return None
        if (there := sign * function(solution)) < 0.0:
            return solution, share * end
        known = sorted([*(known if number else (known[0], known[2])), (share, there)])
        i = min(range(1, len(known) - 1), key=lambda i: known[i][1])
        known = known[i - 1 : i + 2]
    return None


def _vertex(known: list[tuple[float, float]]) -> tuple[float, float]:
    """Where the parabola through three points has its least value, and that; NaN if nowhere."""
    (x, fx), (y, fy), (z, fz) = known
    left, right = (fy - fx) / (y - x), (fz - fy) / (z - y)
    bend = (right - left) / (z - x)
    if not bend > 0.0:
        return math.nan, math.nan
    at = 0.5 * (x + y) - 0.5 * left / bend
    return at, fx + (at - x) * (left + bend * (at - y))
