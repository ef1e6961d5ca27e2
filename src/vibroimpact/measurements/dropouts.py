"""Marks of missing values, such as 9999 or -999.99, among measured numbers."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

_NINES = re.compile(r"-?9{3,}(\.(9+|0+))?")
_HUGE = 1e30
"""No measured quantity is as large in any unit."""
_FAR = 10.0
"""Smallest ratio of a mark to the largest other value."""


def doubt_marks(name: str, values: NDArray[np.float64]) -> list[str]:
    """Return a doubt about a value that probably marks missing values.

    A mark consists of nines, or is at least 1e30, and is far from all other values.

    Values are the numbers as the file writes them. NaN is ignored.
    """
    known = values[np.isfinite(values)]
    sizes = np.abs(known)
    if not len(known):
        return []
    mark = known[int(sizes.argmax())]
    if not (abs(mark) >= _HUGE or _NINES.fullmatch(f"{mark:.6f}".rstrip("0").rstrip("."))):
        return []
    others = sizes[known != mark]
    if not len(others) or abs(mark) < _FAR * others.max():
        return []
    count = len(known) - len(others)
    return [
        f"the column {name} has the value {mark:.7g} in {count} of {len(values)} rows, far from "
        f"all others (at most {others.max():.3g}); if it marks missing values, leave these cells "
        "empty"
    ]
