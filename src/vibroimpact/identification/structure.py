"""Whether what a fit leaves is noise, or has the shape of something that the model lacks."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2, norm

Array = NDArray[np.float64]

CERTAIN = 1e-3
"""Probability below which chance is ruled out."""
_RUN = 5
"""Neighbouring points over which residuals are averaged, to say where they are large."""


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

    @property
    def noticed(self) -> bool:
        """Whether the model is wrong beyond chance."""
        return min(self.chance, self.excess_chance) < CERTAIN


def structure(
    rows: list[tuple[Array, Array]], noise: float | None, freedom: float, settled_noise: float
) -> Structure:
    """Judge residuals.

    Parameters
    ----------
    rows
        Sequences: place and residual (as a share), each in the order of its place.
    noise
        Standard deviation of the noise as a share, from elsewhere; None if it is not known.
    freedom
        Points less what was fitted.
    settled_noise
        What counts as no noise at all.
    """
    pairs, squares = 0.0, 0.0
    every = np.concatenate([r for _, r in rows]) if rows else np.empty(0)
    worst, largest = (math.nan, math.nan), -1.0
    for place, residual in rows:
        # A single wild point is an outlier, not a shape.
        limit = 3.0 * float(np.median(np.abs(every))) / 0.6745
        r = np.clip(residual, -limit, limit)
        product = r[:-1] * r[1:]
        pairs += float(product.sum())
        squares += float((product**2).sum())
        width = min(_RUN, len(r))
        mean = np.abs(np.convolve(r, np.ones(width) / width, mode="valid"))
        if len(mean) and mean.max() > largest:
            i = int(np.argmax(mean))
            worst, largest = (float(place[i]), float(place[i + width - 1])), float(mean.max())
    size = float(np.sqrt(np.mean(every**2))) if len(every) else 0.0
    if size <= settled_noise or squares == 0.0:
        return Structure(0.0, 1.0, math.nan, 1.0, worst)
    score = pairs / math.sqrt(squares)
    share = pairs / float(np.sum(np.clip(every, -limit, limit) ** 2))
    excess, excess_chance = math.nan, 1.0
    if noise is not None and noise > 0.0:
        excess = size / noise
        excess_chance = float(chi2.sf(freedom * excess**2, freedom))
    return Structure(share, float(norm.sf(score)), excess, excess_chance, worst)
