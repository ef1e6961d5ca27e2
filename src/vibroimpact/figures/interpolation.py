"""Linear interpolation between the nodes of a grid, on the scales of the axes of a figure."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axis import Axis
from numpy.typing import NDArray

_Array = NDArray[np.float64]

_PARTS = 15
"""Number of points per side of a cell. It is odd, so that the nearest node changes between
points."""


def finer_axis(axis: Axis, nodes: _Array) -> _Array:
    """Return the nodes and evenly spaced points between them, on the scale of an axis."""
    scale: Any = axis.get_transform()
    even = np.interp(_places(len(nodes)), np.arange(len(nodes)), scale.transform(nodes))
    points: _Array = scale.inverted().transform(even)
    points[::_PARTS] = nodes  # which rounding moved
    return points


def finer(values: NDArray[Any]) -> _Array:
    """Interpolate values at nodes (y, x) to the points of `finer_axis`.

    Along the sides of a cell the interpolation is linear on the scales of the axes. A cell with a
    NaN at one of its nodes is NaN.
    """
    for axis in (0, 1):
        count = values.shape[axis]
        values = np.apply_along_axis(
            lambda row, n=count: np.interp(_places(n), np.arange(n), row), axis, values
        )
    return values


def nearest(values: NDArray[Any]) -> NDArray[Any]:
    """Return the value of the nearest node (y, x) at the points of `finer_axis`."""
    rows, columns = (np.rint(_places(count)).astype(int) for count in values.shape)
    node_values: NDArray[Any] = values[np.ix_(rows, columns)]
    return node_values


def _places(count: int) -> _Array:
    """Return the positions of the points, in units of the node spacing."""
    return np.arange((count - 1) * _PARTS + 1) / _PARTS
