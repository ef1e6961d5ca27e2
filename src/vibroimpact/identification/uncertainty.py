"""How well the data determine what was fitted: covariance, profiles, bootstrap."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.stats import t as student

from vibroimpact.identification.problem import Problem
from vibroimpact.identification.robust import moments

Array = NDArray[np.float64]

_FARTHEST = 100.0
"""Sizes of a parameter beyond which no end of an interval is looked for."""
_STEEP = 8.0
"""Change of a value over that of a parameter, both as shares, from which on a fold is near."""
_CLOSE = 0.01
"""An end is found when the sum of squares is this close to its limit, as a share of that."""
_REFITS = 14
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


class Profile(NamedTuple):
    """How the fit worsens as one parameter is held away from its best value."""

    value: Array
    """Rising."""
    rise: Array
    """Of the deviance: 3.84 at the ends of a 95 % interval of many points."""
    low: float
    high: float
    open_low: bool
    """Whether a bound, or nothing at all, ends it, instead of the data."""
    open_high: bool


def spread(problem: Problem, x: Array) -> Spread:
    """Covariance at a fit."""
    plain = problem.replaced(tail=np.inf)
    matrix = plain.jacobian(x, fine=True)
    # A jump at the edge of its step, and a point beside a fold, where a branch turns as a square
    # root, bound a parameter on one side, which profiles tell; by their derivatives they would
    # bound it on both, far too tightly.
    steep = np.abs(matrix * problem.shares_of_curves[:, np.newaxis]).max(axis=1) > _STEEP
    matrix[problem.jumps | steep] = 0.0
    used = int(problem.measured.sum())
    freedom = max(used - len(x), 1)
    # A direction that the data do not see at all has an infinite variance, not a zero one.
    _, s, vt = np.linalg.svd(matrix, full_matrices=False)
    inverse = 1.0 / np.maximum(s, max(1e-10 * s[0], 1e-150)) ** 2
    whole = (vt.T * inverse) @ vt * moments(problem.tail).inflation
    count = len(problem.free)
    scale = problem.scale[:count]
    covariance = whole[:count, :count] * np.outer(scale, scale)
    error = np.sqrt(np.diag(covariance))
    return Spread(covariance, covariance / np.outer(error, error), error, freedom, matrix)


def refitted(problem: Problem, x: Array, held: int, value: float) -> tuple[Array, float]:
    """Fit all but one unknown, which is held at a value."""
    others = np.arange(len(x)) != held
    start = x.copy()
    start[held] = value
    if not others.any():
        return start, problem.cost(start)

    def whole(y: Array) -> Array:
        full = start.copy()
        full[others] = y
        return full

    def derivative(y: Array) -> Array:
        return problem.jacobian(whole(y), only=others)

    low, high = problem.low[others], problem.high[others]
    done = least_squares(
        lambda y: problem.values(whole(y)).residuals,
        np.clip(start[others], low, high),
        jac=derivative,
        bounds=(low, high),
        ftol=1e-6,
        xtol=1e-8,
        gtol=1e-8,
        max_nfev=25,
    )
    return whole(done.x), float(done.cost)


def profile(
    problem: Problem, x: Array, number: int, around: Spread, confidence: float = 0.95
) -> Profile:
    """Hold one parameter at a value after the other, and fit all others.

    Parameters
    ----------
    problem, x
        The fit.
    number
        Of the parameter.
    around
        The covariance, by which the first step is chosen.
    confidence
        Of the interval.

    Returns
    -------
    Profile
        Asymmetric where the problem is; an end may be a bound.
    """
    factor = moments(problem.tail).deviance
    limit = float(student.ppf(0.5 + 0.5 * confidence, around.freedom)) ** 2
    best = problem.cost(x)
    error = min(float(around.error[number] / problem.scale[number]), 1.0)
    error = max(error, 1e-9 * max(abs(x[number]), 1e-3))
    seen = {float(x[number]): 0.0}
    ends, opened = [], []
    for sign in (-1.0, 1.0):
        bound = problem.low[number] if sign < 0.0 else problem.high[number]
        far = x[number] + sign * _FARTHEST * max(abs(x[number]), 1.0)
        bound = max(bound, far) if sign < 0.0 else min(bound, far)
        inner, outer = (float(x[number]), 0.0), None
        step, place = np.sqrt(limit) * error, x.copy()
        end, is_open = bound, True
        for _ in range(_REFITS):
            if outer is None:
                value = inner[0] + sign * step
                value = max(value, bound) if sign < 0.0 else min(value, bound)
            else:
                # The root of the rise grows almost along a straight line.
                a, b = np.sqrt(inner[1]), np.sqrt(outer[1])
                share = np.clip((np.sqrt(limit) - a) / (b - a), 0.1, 0.9)
                value = inner[0] + share * (outer[0] - inner[0])
            place, cost = refitted(problem, place, number, value)
            rise = max(2.0 * factor * (cost - best), 0.0)
            seen[value] = rise
            if abs(rise - limit) < _CLOSE * limit:
                end, is_open = value, False
                break
            if rise > limit:
                outer = (value, rise)
                end, is_open = value, False
            else:
                if value == bound:
                    break
                grown = np.sqrt(limit / max(rise, 0.02 * limit))
                step = max((grown - 1.0) * abs(value - x[number]), 0.3 * step)
                inner = (value, rise)
        if outer is not None and is_open:
            end, is_open = outer[0], False
        ends.append(end)
        opened.append(is_open)
    places = np.array(sorted(seen))
    rises = np.array([seen[v] for v in places])
    scale = problem.scale[number]
    return Profile(places * scale, rises, ends[0] * scale, ends[1] * scale, opened[0], opened[1])


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
