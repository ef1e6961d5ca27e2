"""Profiles: how a fit worsens as one parameter is held away from its best value.

A fit of curves has valleys, for points change their branch, and a refit may stay in the wrong one.
So each begins at every place known beside it, and a place that is better than those of its
neighbours is handed on to them.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from vibroimpact.identification.least_squares import Problem, minimized
from vibroimpact.identification.robust_loss import moments
from vibroimpact.identification.uncertainty import Spread

Array = NDArray[np.float64]

_FARTHEST = 100.0
"""Sizes of a parameter beyond which no end of an interval is looked for."""
_CLOSE = 0.01
"""An end is found when the rise is this close to its limit, as a share of that; or when it is known
to such a share of its distance from the fit."""
_VALUES = 14
"""At most, to each side."""
_PARTS = 32
"""Parts of a bracket at whose ends values are tried: rounding, which differs between processors,
moves none of them."""
_PATIENT = 6
"""Values beyond which those between are halved, instead of drawn along a line."""


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


def refitted(
    problem: Problem, x: Array, held: int, value: float, kept: Iterable[int] = ()
) -> tuple[Array, float]:
    """Fit all but one unknown, which is held at a value, and others that keep theirs."""
    others = ~np.isin(np.arange(len(x)), [held, *kept])
    start = x.copy()
    start[held] = value
    if not others.any():
        return start, problem.cost(start)
    return minimized(problem, start, (1e-6, 1e-8, 1e-8), 25, among=others)


class _Refits:
    """The best refit that is known at each value of one parameter."""

    def __init__(self, problem: Problem, x: Array, number: int, kept: Iterable[int]) -> None:
        self.problem, self.number, self.kept = problem, number, tuple(kept)
        self.best = problem.cost(x)
        self.factor = 2.0 * moments(problem.tail).deviance
        self.first = float(x[number])
        self.places: dict[float, tuple[Array, float]] = {self.first: (x, self.best)}

    def rise(self, value: float) -> float:
        """Of the deviance."""
        return max(self.factor * (self.places[value][1] - self.best), 0.0)

    def beside(self, sign: float) -> list[float]:
        """The values to one side, from the fit outwards; the fit's own is the first."""
        return sorted(
            (v for v in self.places if sign * (v - self.first) >= 0.0), key=lambda v: sign * v
        )

    def add(self, value: float, sign: float) -> None:
        """Refit at a value, from all that is known beside it, and its neighbours from there."""
        known = self.beside(sign)
        nearer = [v for v in known if sign * (value - v) > 0.0]
        farther = [v for v in known if sign * (value - v) < 0.0]
        for start in dict.fromkeys([*nearer[-1:], *farther[:1], self.first]):
            self._tried(value, self.places[start][0])
        for row in (nearer[:0:-1], farther):
            before = value
            for v in row:
                # A rise that falls outwards shows that what is nearer is stuck.
                if row is not farther and self.places[v][1] <= self.places[before][1]:
                    break
                if not self._tried(v, self.places[before][0]):
                    break
                before = v

    def _tried(self, value: float, start: Array) -> bool:
        """Whether a refit from a place is better than what is known."""
        place, cost = refitted(self.problem, start, self.number, value, self.kept)
        known = self.places.get(value)
        if known is None or cost < known[1]:
            self.places[value] = place, cost
        return known is None or self.factor * (known[1] - cost) > _CLOSE


def limit_of(confidence: float, freedom: int) -> float:
    """Rise of the deviance at the ends of an interval."""
    return float(scipy.stats.t.ppf(0.5 + 0.5 * confidence, freedom)) ** 2


def profile(
    problem: Problem,
    x: Array,
    number: int,
    around: Spread,
    confidence: float = 0.95,
    kept: Iterable[int] = (),
) -> Profile:
    """Hold one parameter at a value after the other, and fit all others.

    Parameters
    ----------
    around
        The covariance, by which the first step is chosen.
    kept
        Numbers of other unknowns that are not fitted again.

    Returns
    -------
    Profile
        Asymmetric where the problem is; an end may be a bound. Where the rise has several valleys,
        the interval holds all that were seen below its limit.
    """
    limit = limit_of(confidence, around.freedom)
    error = min(float(around.error[number] / problem.scale[number]), 1.0)
    error = max(error, 1e-9 * max(abs(x[number]), 1e-3))
    refits = _Refits(problem, x, number, kept)
    ends = [_end(refits, sign, limit, np.sqrt(limit) * error) for sign in (-1.0, 1.0)]
    values = sorted(refits.places)
    scale = problem.scale[number]
    return Profile(
        np.array(values) * scale,
        np.array([refits.rise(v) for v in values]),
        ends[0][0] * scale,
        ends[1][0] * scale,
        ends[0][1],
        ends[1][1],
    )


def _end(refits: _Refits, sign: float, limit: float, step: float) -> tuple[float, bool]:
    """Where the rise passes its limit for the last time, and whether it is a bound instead."""
    problem, first = refits.problem, refits.first
    far = first + sign * _FARTHEST * max(abs(first), 1.0)
    low, high = problem.low[refits.number], problem.high[refits.number]
    bound = float(max(low, far) if sign < 0.0 else min(high, far))
    step = _two_digits(step)
    for count in range(_VALUES):
        inner, outer = _bracket(refits, sign, limit)
        if outer is None:
            value = inner + sign * step
            value = max(value, bound) if sign < 0.0 else min(value, bound)
        else:
            # The root of the rise grows almost along a straight line.
            a, b = np.sqrt(refits.rise(inner)), np.sqrt(refits.rise(outer))
            share = np.clip((np.sqrt(limit) - a) / (b - a), 0.1, 0.9) if count < _PATIENT else 0.5
            value = float(inner + round(_PARTS * share) / _PARTS * (outer - inner))
        refits.add(value, sign)
        inner, outer = _bracket(refits, sign, limit)
        for end in (inner, outer):
            if end is not None and abs(refits.rise(end) - limit) < _CLOSE * limit:
                return end, False
        if outer is not None and abs(outer - inner) < _CLOSE * abs(outer - first):
            return outer, False
        if outer is None:
            if inner == bound:
                break
            grown = np.sqrt(limit / max(refits.rise(inner), 0.02 * limit))
            step = _two_digits(max(float(grown - 1.0) * abs(inner - first), 0.3 * step))
    return (bound, True) if outer is None else (outer, False)


def _two_digits(step: float) -> float:
    return float(f"{step:.1e}")


def _bracket(refits: _Refits, sign: float, limit: float) -> tuple[float, float | None]:
    """The outermost value whose rise is within the limit, and the next one, beyond it."""
    known = refits.beside(sign)
    last = max(i for i, v in enumerate(known) if refits.rise(v) <= limit)
    return known[last], known[last + 1] if last + 1 < len(known) else None
