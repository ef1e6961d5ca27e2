"""What no other design beats in both displacement and acceleration."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

_DIGITS = 9
"""Values that agree to so many digits are one: that much is left to rounding."""


def non_dominated(first: ArrayLike, second: ArrayLike) -> NDArray[np.bool_]:
    """Which points no other one beats: smaller in one of the two, and not larger in the other.

    Of points that are the same the first is kept; those that are not finite are not.
    """
    one, other = (_rounded(np.asarray(values, dtype=float)) for values in (first, second))
    x, y = one.ravel(), other.ravel()
    kept = np.zeros(len(x), dtype=bool)
    known = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
    order = known[np.lexsort((y[known], x[known]))]
    # Sorted by x, then by y, then as given: whatever lies before has no larger x.
    least = np.inf
    for i in order:
        kept[i] = y[i] < least
        least = min(least, y[i])
    return kept.reshape(one.shape)


def _rounded(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """To `_DIGITS` significant digits."""
    with np.errstate(divide="ignore", invalid="ignore"):
        power = np.floor(np.log10(np.abs(values)))
    unit = 10.0 ** (power - _DIGITS + 1)
    usable = np.isfinite(values) & (values != 0.0)
    return np.where(usable, np.round(values / np.where(usable, unit, 1.0)) * unit, values)
