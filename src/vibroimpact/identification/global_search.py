"""A global search before the local one: where from, and how many starts come to the same end."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from vibroimpact.identification.least_squares import Problem, minimized

Array = NDArray[np.float64]

_ALIKE = 0.01
"""Ends whose parameters differ by less than this share are one minimum."""
_AT_BOUND = 1e-8
"""Distance from a bound, in sizes, at which a fit has ended on it: the search stays inside."""
_WORSE = 1.01
"""Of the least cost: an end that costs no more, and lies there, counts as the same."""


class Ended(NamedTuple):
    """Where a local fit came to."""

    x: Array
    cost: float
    evaluations: int


class SearchResult(NamedTuple):
    """What a search found."""

    x: Array
    cost: float
    starts: int
    """Local fits that were begun."""
    alike: int
    """How many of them found the same."""
    near: tuple[Array, ...]
    """Where these are."""
    others: tuple[Ended, ...]
    """The other ends, the best first."""
    evaluations: int
    """Of the residuals, in all."""


def local(problem: Problem, x: Array, most: int = 60, precise: bool = False) -> Ended:
    """Least squares from one place, within the bounds."""
    before = problem.evaluations
    tight = 1e-13 if precise else 1e-7
    end, cost = minimized(problem, x, (tight, tight, tight), most, precise=precise)
    x = np.where(end - problem.low < _AT_BOUND, problem.low, end)
    x = np.where(problem.high - x < _AT_BOUND, problem.high, x)
    return Ended(x, cost, problem.evaluations - before)


def search(
    problem: Problem, tried: int, starts: int, seed: int, threads: int, best: Sequence[Array] = ()
) -> SearchResult:
    """Try many places, and go on from the best ones.

    Parameters
    ----------
    tried
        Number of points that are tried, by Sobol's sequence over the ranges of the free parameters.
    starts
        Local fits: from the problem's own start, and from the best of these places.
    """
    count = len(problem.free)
    own = problem.start
    places = [own, *best]
    if tried:
        shares = scipy.stats.qmc.Sobol(count, seed=seed).random(
            1 << max(tried - 1, 1).bit_length()
        )[:tried]
        for row in shares:
            x = own.copy()
            for j, (one, share) in enumerate(zip(problem.free, row, strict=True)):
                x[j] = one.drawn(float(share)) / one.scale
            places.append(x)
    problems = [problem.replaced() for _ in range(len(places))]
    with ThreadPoolExecutor(threads) as pool:
        costs = list(pool.map(lambda p, x: p.cost(x), problems, places))
        order = np.argsort(costs, kind="stable").tolist()
        sure = list(range(1 + len(best)))
        chosen = [*sure, *(i for i in order if i not in sure)][: max(starts, len(sure))]
        ends = list(pool.map(lambda i: local(problems[i], places[i]), chosen))
    ends.sort(key=lambda end: end.cost)
    first = ends[0]
    near = [end for end in ends if _same(end, first, count)]
    others: list[Ended] = []
    for end in ends:
        if not any(_close(end.x, one.x, count) for one in [first, *others]):
            others.append(end)
    spent = sum(p.evaluations for p in problems)
    same = tuple(end.x for end in near)
    return SearchResult(first.x, first.cost, len(ends), len(near), same, tuple(others), spent)


def _same(end: Ended, best: Ended, count: int) -> bool:
    return end.cost <= _WORSE * best.cost + 1e-9 or _close(end.x, best.x, count)


def _close(one: Array, other: Array, count: int) -> bool:
    a, b = one[:count], other[:count]
    return bool(np.all(np.abs(a - b) <= _ALIKE * np.maximum(np.abs(b), 1e-3)))
