"""The 0–1 test for chaos of Gottwald and Melbourne (2009), and a rotation number.

Both look at the points of a section only: nothing is shared with Lyapunov exponents.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def zero_one(series: Array, angles: int = 60, seed: int = 1) -> float:
    """Median correlation K of the mean square displacement with time: near 1 chaos, near 0 not.

    G. A. Gottwald, I. Melbourne, On the implementation of the 0–1 test for chaos, SIAM J. Appl.
    Dyn. Syst. 8 (2009) 129–145, the correlation method with their modified displacement.
    """
    n = len(series)
    cut = n // 10
    index = np.arange(1, n + 1)
    correlations = []
    for c in np.random.default_rng(seed).uniform(np.pi / 5, 4 * np.pi / 5, angles):
        p = np.cumsum(series * np.cos(index * c))
        q = np.cumsum(series * np.sin(index * c))
        lags = np.arange(1, cut + 1)
        square = np.array(
            [
                np.mean((p[j : j + n - cut] - p[: n - cut]) ** 2)
                + np.mean((q[j : j + n - cut] - q[: n - cut]) ** 2)
                for j in lags
            ]
        )
        swing = series.mean() ** 2 * (1 - np.cos(lags * c)) / (1 - np.cos(c))
        correlations.append(np.corrcoef(lags, square - swing)[0, 1])
    return float(np.median(correlations))


def rotation_number(x: Array, y: Array) -> float:
    """Mean turn of the points about their centre, in turns a step: by weighted averages.

    The weights exp(−1/(t(1 − t))) make the average of a quasi-periodic motion converge faster
    than any power (Das, Saiki, Sander, Yorke, Nonlinearity 30 (2017) 4111).
    """
    angle = np.unwrap(np.arctan2(y - y.mean(), x - x.mean()))
    turns = np.diff(angle) / (2 * np.pi)
    t = (np.arange(len(turns)) + 0.5) / len(turns)
    weight = np.exp(-1.0 / (t * (1.0 - t)))
    return float(weight @ turns / weight.sum()) % 1.0
