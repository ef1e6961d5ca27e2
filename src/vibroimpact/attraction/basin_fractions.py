"""Shares of states, and how well they are known."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

CONFIDENCE = 0.95


def interval(
    hits: ArrayLike, total: int, confidence: float = CONFIDENCE
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The exact confidence interval of a share (C. J. Clopper, E. S. Pearson, Biometrika 26, 1934).

    Return its low and its high end, for `hits` of `total` random states.
    """
    counts = np.asarray(hits, dtype=float)
    tail = 0.5 * (1.0 - confidence)
    none, all_ = counts <= 0.0, counts >= total
    inside_low, inside_high = np.where(none, 1.0, counts), np.where(all_, total - 1.0, counts)
    low = np.where(none, 0.0, scipy.special.betaincinv(inside_low, total - inside_low + 1.0, tail))
    high = np.where(
        all_, 1.0, scipy.special.betaincinv(inside_high + 1.0, total - inside_high, 1.0 - tail)
    )
    return low, high
