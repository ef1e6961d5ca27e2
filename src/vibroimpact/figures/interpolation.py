"""Values between the nodes of a grid, along straight lines on the axes as they are drawn."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axis import Axis
from numpy.typing import NDArray

_Array = NDArray[np.float64]

_PARTS = 15
"""Points per side of a cell. Odd, so that the nearest node changes between two points."""


def finer_axis(axis: Axis, nodes: _Array) -> _Array:
    """Each node, and evenly spaced points between each two, on the scale of an axis."""
    scale: Any = axis.get_transform()
    even = np.interp(_places(len(nodes)), np.arange(len(nodes)), scale.transform(nodes))
    found: _Array = scale.inverted().transform(even)
    found[::_PARTS] = nodes  # which rounding moved
    return found


def finer(values: NDArray[Any]) -> _Array:
    """Values of nodes (y, x) at the points of `finer_axis`; NaN in cells with a node that is NaN.

    Along the sides of a cell they are on straight lines; on the axes' scales, as the points are.
    """
    for axis in (0, 1):
        count = values.shape[axis]
        values = np.apply_along_axis(
            lambda row, n=count: np.interp(_places(n), np.arange(n), row), axis, values
        )
    return values


def nearest(values: NDArray[Any]) -> NDArray[Any]:
    """Values of the nearest node (y, x) at the points of `finer_axis`."""
    rows, columns = (np.rint(_places(count)).astype(int) for count in values.shape)
    found: NDArray[Any] = values[np.ix_(rows, columns)]
    return found


def _places(count: int) -> _Array:
    """Where the points lie, counted in nodes."""
    return np.arange((count - 1) * _PARTS + 1) / _PARTS
