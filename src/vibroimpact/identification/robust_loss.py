"""Soft tails: what they cost under normal noise, and the noise that they leave."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from typing import NamedTuple

import numpy as np

from vibroimpact.identification.least_squares import Array, Problem, Test, softened

_X, _W = np.polynomial.hermite_e.hermegauss(80)
_W = _W / _W.sum()


class Soft(NamedTuple):
    """Moments of soft residuals of standard normal noise; 1 without a tail."""

    square: float
    """Mean square of the residuals."""
    inflation: float
    """Of a parameter's variance over that of least squares."""
    deviance: float
    """By which a difference of the sums of squares is multiplied to be one of χ²."""


def moments(tail: float) -> Soft:
    """The moments of a tail."""
    if not np.isfinite(tail):
        return Soft(1.0, 1.0, 1.0)
    share = 1.0 + (_X / tail) ** 2
    pull = float(_W @ (_X**2 / share))
    slope = float(_W @ share**-1.5)
    return Soft(float(_W @ softened(_X, tail) ** 2), pull / slope**2, slope / pull)


_MANY = 8
"""Number of values of a quantity from which its noise is estimated separately."""
_RATIO = 0.05
"""A quantity's noise is taken as no smaller a share of all."""
_LEAST = 1e-9
"""Noise is taken as no smaller."""
_STEPS = 30


def noises(problem: Problem, x: Array, said: Sequence[bool]) -> list[float]:
    """The standard deviation of each test's points, from what the fit leaves.

    `said` states which are known beforehand.
    """
    used = sum(t.points_count for t in problem.tests)
    spare = max(1.0 - len(x) / used, 0.1)
    return [
        test.noise if known else max(_noise(points, problem.tail, spare), _LEAST)
        for (test, points), known in zip(_plain_points(problem, x), said, strict=True)
    ]


def weighed(problem: Problem, x: Array, said: Sequence[bool]) -> list[Test]:
    """The tests, each quantity weighed by its own noise where that is not known beforehand."""
    tests = []
    for (test, points), known in zip(_plain_points(problem, x), said, strict=True):
        changed = copy(test)
        if not known and len(test.weights) > 1:
            of = np.array(test.channels)
            own = {name: test.weights[name] * _noise(points[of == name], problem.tail, 1.0)
                   for name in test.weights if (of == name).sum() >= _MANY}  # fmt: skip
            whole = float(np.sqrt(np.mean(np.square(list(own.values()))))) if own else 0.0
            if whole > _LEAST:
                rest = dict.fromkeys(test.weights, 1.0)
                changed.weights = rest | {
                    name: max(size / whole, _RATIO) for name, size in own.items()
                }
        tests.append(changed)
    return tests


def _plain_points(problem: Problem, x: Array) -> Iterator[tuple[Test, Array]]:
    """Each test with the residuals of its points, neither weighed nor softened."""
    plain = problem.replaced(sigma=[1.0] * len(problem.tests), tail=np.inf, weights=None)
    residuals, begin = plain.values(x).residuals, 0
    for test in problem.tests:
        yield test, residuals[begin : begin + test.points_count]
        begin += test.count


def _noise(points: Array, tail: float, spare: float) -> float:
    if not np.isfinite(tail):
        return float(np.sqrt(np.mean(points**2) / spare))
    # The noise at which the soft residuals have the mean square of normal ones.
    size = max(1.4826 * float(np.median(np.abs(points))), _LEAST)
    square = moments(tail).square * spare
    for _ in range(_STEPS):
        size = max(
            size * float(np.sqrt(np.mean(softened(points / size, tail) ** 2) / square)), _LEAST
        )
    return size
