"""A test beside what a rig does in it, point by point."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class TestPoints(NamedTuple):
    """All points of a test."""

    place: Array
    """Frequency (Hz) or time (s)."""
    direction: list[str]
    """Of the sweep; empty of a history."""
    variable: list[str]
    measured: Array
    modelled: Array
    residual: Array
    """Modelled less measured, as the fit counts it: of curves a share of the value."""
