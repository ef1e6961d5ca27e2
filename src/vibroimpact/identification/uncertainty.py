"""How well the data determine what was fitted: covariance and bootstrap."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.identification.least_squares import Problem
from vibroimpact.identification.robust_loss import moments

Array = NDArray[np.float64]

_STEEP = 8.0
"""Change of a value over that of a parameter, both as shares, from which on a fold is near."""
_UNSEEN = 1e-100
"""Least singular value: what no value depends on has an error of 1e100 sizes."""
_CHORDS = 4


class Spread(NamedTuple):
    """Covariance by the derivatives at the fit; of the parameters, in their own units."""

    covariance: Array
    correlation: Array
    error: Array
    """Standard errors."""
    freedom: int
    jacobian: Array
    """Of the plain residuals, over all unknowns in their sizes."""


def spread(problem: Problem, x: Array) -> Spread:
    """Covariance at a fit."""
    plain = problem.replaced(tail=np.inf)
    matrix = plain.jacobian(x, fine=True)
    # A jump at the edge of its step, and a point beside a fold, where a branch turns as a square
    # root, bound a parameter on one side, which profiles show; by their derivatives they would
    # bound it on both, far too tightly.
    steep = np.abs(matrix * problem.shares_of_curves[:, np.newaxis]).max(axis=1) > _STEEP
    matrix[problem.jumps | steep] = 0.0
    used = int(problem.measured.sum())
    freedom = max(used - len(x), 1)
    # A direction that the data do not see at all has an infinite variance, not a zero one.
    _, s, vt = np.linalg.svd(matrix, full_matrices=False)
    inverse = 1.0 / np.maximum(s, max(1e-10 * s[0], _UNSEEN)) ** 2
    whole = (vt.T * inverse) @ vt * moments(problem.tail).inflation
    count = len(problem.free)
    scale = problem.scale[:count]
    known = whole[:count, :count]
    error = np.sqrt(np.diag(known))
    correlation = known / np.outer(error, error)
    return Spread(known * np.outer(scale, scale), correlation, error * scale, freedom, matrix)


def bootstrap(
    problem: Problem, x: Array, around: Spread, count: int, seed: int, threads: int
) -> Array:
    """Fits to points drawn with replacement, a row each, in the parameters' own units.

    Each draw is a weight on every point; the refit begins at the fit and goes by Gauss and
    Newton with the fit's derivatives, so that each of its steps costs one evaluation.
    """
    random = np.random.default_rng(seed)
    measured = problem.measured
    places = np.flatnonzero(measured)
    soft = problem.jacobian(x, fine=True)
    draws = []
    for _ in range(count):
        weights = np.ones(len(measured))
        drawn = random.integers(0, len(places), len(places))
        weights[places] = np.sqrt(np.bincount(drawn, minlength=len(places)))
        draws.append(weights)

    def refit(weights: Array) -> Array:
        one = problem.replaced(weights=weights)
        solve = np.linalg.pinv(weights[:, np.newaxis] * soft, rcond=1e-10)
        y = x.copy()
        for _ in range(_CHORDS):
            step = solve @ one.values(y).residuals
            longest = float(np.abs(step).max())
            y = np.clip(y - step * min(1.0, 0.5 / max(longest, 1e-300)), problem.low, problem.high)
            if longest < 1e-4:
                break
        return y

    with ThreadPoolExecutor(threads) as pool:
        rows = np.array(list(pool.map(refit, draws)))
    kept = len(problem.free)
    samples: Array = rows[:, :kept] * problem.scale[:kept]
    return samples
