"""Lognormal curves that agree with what a suite of records shows, each with its weight."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]

_DEPTH = 18.0
"""Curves whose weight is smaller than the largest by more than exp(-18) are left out."""
_SLOPES, _OFFSETS = 160, 80
"""Points of the grid: of the logarithm of the slope, and of the offset at each slope."""
_FLATTEST, _STEEPEST = -_DEPTH * 2.0, 14.0
"""Range of the logarithm of the slope (over the range of the levels) in which curves are sought.

With two records that begin to exceed within the levels, a weight falls as the slope: by exp(-18)
within 18."""


class WeightedCurves(NamedTuple):
    """Curves Φ((ln s − ln θ)/β) and their weights, whose sum is 1."""

    log_median: _Array
    """ln θ."""
    log_dispersion: _Array
    """ln β."""
    weight: _Array

    def median_range(self, confidence: float) -> _Array:
        """Ends of the interval of θ."""
        return np.exp(_ends(self.log_median, self.weight, confidence))

    def dispersion_range(self, confidence: float) -> _Array:
        """Ends of the interval of β."""
        values, which = np.unique(self.log_dispersion, return_inverse=True)
        weight = np.bincount(which.ravel(), self.weight)
        below = np.cumsum(weight) - 0.5 * weight
        return np.exp(np.interp(_shares(confidence), below, values))

    def probability_range(self, logarithms: _Array, confidence: float) -> _Array:
        """Ends of the interval of the probability at each scale; shape (2, scales).

        Each curve rises with the scale, and so does a quantile of any fixed set of them.
        """
        from scipy.special import ndtr

        slope = np.exp(-self.log_dispersion)
        ends = [
            _ends((one - self.log_median) * slope, self.weight, confidence) for one in logarithms
        ]
        probabilities: _Array = ndtr(np.array(ends).T)
        return probabilities


def begin_to_exceed(exceeding: NDArray[np.int64], count: int) -> _Array:
    """How many records begin to exceed below the first scale, between each two, and above the last.

    Records may cease to exceed at a higher scale. If the number that exceeds falls therefore, it is
    replaced by the nearest one that does not (isotonic regression), which may be no whole number.
    """
    blocks: list[tuple[float, int]] = []
    for one in exceeding:
        value, size = float(one), 1
        while blocks and blocks[-1][0] >= value:
            other, width = blocks.pop()
            value = (value * size + other * width) / (size + width)
            size += width
        blocks.append((value, size))
    rising = [value for value, size in blocks for _ in range(size)]
    return np.diff(np.array([0.0, *rising, float(count)]))


def credible_curves(
    exceeding: NDArray[np.int64], count: int, logarithms: _Array
) -> WeightedCurves | None:
    """Weigh all lognormal curves by the likelihood of what the records show.

    The capacity of a record (the scale from which on it exceeds) is lognormal, and lies between two
    scales. The likelihood is that of these intervals, and counts each record once. It is weighted
    by dθ/θ dβ/β. Of capacities that are known exactly, such weights give the classical intervals,
    whose coverage is exact for any number of records: Student's of the median, χ² of the
    dispersion, the non-central t of a probability (the right Haar prior; Severini, Mukerjee and
    Ghosh 2002, Biometrika 89).

    Parameters
    ----------
    exceeding
        Records that exceed at each scale, of `count`; at two or more scales some do and others do
        not.
    logarithms
        Of the scales, in rising order.

    Returns
    -------
    Curves or None
        None if fewer than two records begin to exceed within the scales: the weights then have no
        finite sum.
    """
    numbers = begin_to_exceed(exceeding, count)
    if numbers[1:-1].sum() < 2.0:
        return None
    middle, size = float(logarithms.mean()), float(np.ptp(logarithms))
    nodes = (logarithms - middle) / size
    weigh = _Weights(numbers, nodes)
    coarse = np.linspace(_FLATTEST, _STEEPEST, 60)
    top = weigh.of(weigh.best_offsets(coarse), coarse)
    among = np.flatnonzero(top > top.max() - _DEPTH)
    first, last = max(among[0] - 1, 0), min(among[-1] + 1, len(coarse) - 1)
    slopes = np.linspace(coarse[first], coarse[last], _SLOPES)
    best = weigh.best_offsets(slopes)
    low, high = (weigh.edges(best, slopes, side) for side in (-1.0, 1.0))
    offsets = low[:, np.newaxis] + (high - low)[:, np.newaxis] * np.linspace(0.0, 1.0, _OFFSETS)
    every = np.broadcast_to(slopes[:, np.newaxis], offsets.shape)
    logs = weigh.of(offsets, every)
    weight = np.exp(logs - logs.max()) * (high - low)[:, np.newaxis]
    slope = np.exp(every)
    return WeightedCurves(
        (middle - offsets / slope * size).ravel(),
        (math.log(size) - every).ravel(),
        (weight / weight.sum()).ravel(),
    )


class _Weights:
    """Logarithm of the weight of Φ(a + b x), over the offset a and v = ln b."""

    def __init__(self, numbers: _Array, nodes: _Array) -> None:
        ends = np.array([-np.inf, *nodes, np.inf])
        held = numbers > 0.0
        self._numbers, self._low, self._high = numbers[held], ends[:-1][held], ends[1:][held]
        self._first, self._last = nodes[0], nodes[-1]

    def of(self, offset: _Array, log_slope: _Array) -> _Array:
        """Of curves of any shape; dθ/θ dβ/β is dv da/b."""
        a, b = offset[..., np.newaxis], np.exp(log_slope)[..., np.newaxis]
        terms: _Array = self._numbers * _log_share(a + b * self._low, a + b * self._high)
        return np.asarray(terms.sum(axis=-1) - log_slope)

    def best_offsets(self, log_slope: _Array) -> _Array:
        """The offset of the largest weight at each slope (whose logarithm is concave)."""
        b = np.exp(log_slope)
        low, high = -b * self._last - 9.0, -b * self._first + 9.0
        share = 0.5 * (math.sqrt(5.0) - 1.0)
        for _ in range(30):
            left, right = high - share * (high - low), low + share * (high - low)
            lower = self.of(left, log_slope) >= self.of(right, log_slope)
            low, high = np.where(lower, low, left), np.where(lower, right, high)
        return np.asarray(0.5 * (low + high))

    def edges(self, best: _Array, log_slope: _Array, side: float) -> _Array:
        """Offsets on one side of the best beyond which weights do not count."""
        least = self.of(best, log_slope) - _DEPTH
        width = np.ones_like(best)
        for _ in range(60):  # twice as far until it is
            far = self.of(best + side * width, log_slope) > least
            if not far.any():
                break
            width = np.where(far, 2.0 * width, width)
        near = np.zeros_like(best)
        for _ in range(20):
            half = 0.5 * (near + width)
            inside = self.of(best + side * half, log_slope) > least
            near, width = np.where(inside, half, near), np.where(inside, width, half)
        return np.asarray(best + side * width)


def _log_share(low: _Array, high: _Array) -> _Array:
    """ln(Φ(high) − Φ(low)), without loss of digits in either tail."""
    from scipy.special import log_ndtr

    above = low > 0.0
    low, high = np.where(above, -high, low), np.where(above, -low, high)
    most = log_ndtr(high)
    with np.errstate(divide="ignore"):  # nothing lies between ends that rounding makes equal
        return np.asarray(most + np.log1p(-np.exp(log_ndtr(low) - most)))


def _ends(values: _Array, weight: _Array, confidence: float) -> _Array:
    """Weighted quantiles that leave out as much below as above."""
    order = np.argsort(values)
    total = np.cumsum(weight[order])
    at = np.searchsorted(total, _shares(confidence) * total[-1])
    return np.asarray(values[order][np.minimum(at, len(order) - 1)])


def _shares(confidence: float) -> _Array:
    return np.array([0.5 - 0.5 * confidence, 0.5 + 0.5 * confidence])
