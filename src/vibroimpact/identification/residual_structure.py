"""Whether what a fit leaves is noise, or has the shape of something that the model lacks."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

Array = NDArray[np.float64]

CERTAIN = 1e-3
"""Probability below which chance is ruled out."""
HINT = 0.05
"""Probability below which another model is worth a trial."""
_LAGS = ((1, 1.0), (2, 0.5))
"""Of the neighbours that are compared, with their weights."""
_SAME = 1e-3
"""Share by which what the model has in both directions may differ where it is one motion."""
TOLD = {"curves": 0.1, "history": 0.2}
"""Degrees of freedom, a value, of a noise that is estimated from a quantile of differences."""
_RUN = 5
"""Neighbouring points over which residuals are averaged, to say where they are large."""


class ResidualSeries(NamedTuple):
    """Residuals of one quantity in one direction, in the order of their places."""

    variable: str
    place: Array
    residual: Array
    """Over the noise of the quantity, up to a factor that all have in common."""
    modelled: Array


class Structure(NamedTuple):
    """What residuals in the order of frequency or time show."""

    correlation: float
    """Of neighbours."""
    chance: float
    """Probability that independent noise correlates so much."""
    excess: float
    """Standard deviation over that of the noise; NaN where that is not known."""
    excess_chance: float
    """Probability that noise does; 1 where it is not known."""
    worst: tuple[float, float]
    """Between which frequencies (Hz) or times (s) the residuals are largest together."""


def structure(
    rows: list[ResidualSeries],
    size: float,
    noise: float | None,
    freedom: float,
    noise_freedom: float,
) -> Structure:
    """Judge residuals.

    What a model lacks shows in neighbours along the frequency, and in both directions of a sweep
    where they are one motion. Products of different pairs of independent residuals do not
    correlate, so that their sum over the root of the sum of their squares is a normal number.

    Parameters
    ----------
    size
        Their root mean square, as a share; 0 where it is not noise.
    noise
        Standard deviation of the noise as a share, from differences of the values; None if it is
        not known.
    freedom, noise_freedom
        Degrees of freedom: of the residuals, and of that noise.
    """
    if size == 0.0:
        return Structure(0.0, 1.0, math.nan, 1.0, (math.nan, math.nan))
    # A single wild point is an outlier, not a shape.
    every = np.concatenate([row.residual for row in rows])
    limit = 3.0 * float(np.median(np.abs(every))) / 0.6745
    rows = [row._replace(residual=np.clip(row.residual, -limit, limit)) for row in rows]
    beside = [product for row in rows for product in _neighbours(row.residual, row.residual)]
    across = [
        product
        for i, row in enumerate(rows)
        for other in rows[:i]
        if other.variable == row.variable
        for product in _across(row, other)
    ]
    products = np.concatenate([*beside, *across])
    squares = float(np.sum(products**2))
    score = float(products.sum()) / math.sqrt(squares) if squares else 0.0
    first = sum(float(np.sum(row.residual[:-1] * row.residual[1:])) for row in rows)
    share = first / max(sum(float(np.sum(row.residual**2)) for row in rows), 1e-300)
    excess, excess_chance = math.nan, 1.0
    if noise is not None and noise > 0.0:
        excess = size / noise
        excess_chance = float(scipy.stats.f.sf(excess**2, freedom, noise_freedom))
    return Structure(share, float(scipy.stats.norm.sf(score)), excess, excess_chance, _worst(rows))


def _neighbours(one: Array, other: Array) -> list[Array]:
    """Products of residuals a place or two apart."""
    return [weight * one[:-lag] * other[lag:] for lag, weight in _LAGS if len(one) > lag]


def _across(one: ResidualSeries, other: ResidualSeries) -> list[Array]:
    """Products of residuals of both directions, at the same places and at neighbours."""
    _, here, there = np.intersect1d(one.place, other.place, return_indices=True)
    a, b = one.modelled[here], other.modelled[there]
    same = np.abs(a - b) <= _SAME * np.maximum(np.abs(a), np.abs(b))
    x = np.where(same, one.residual[here], 0.0)
    y = np.where(same, other.residual[there], 0.0)
    return [x * y, *_neighbours(x, y), *_neighbours(y, x)]


def _worst(rows: list[ResidualSeries]) -> tuple[float, float]:
    """Where neighbouring residuals are largest together."""
    worst, largest = (math.nan, math.nan), -1.0
    for row in rows:
        width = min(_RUN, len(row.residual))
        mean = np.abs(np.convolve(row.residual, np.ones(width) / width, mode="valid"))
        if len(mean) and mean.max() > largest:
            i = int(np.argmax(mean))
            worst = (float(row.place[i]), float(row.place[i + width - 1]))
            largest = float(mean.max())
    return worst
