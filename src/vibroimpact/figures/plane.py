"""The plane of two parameters in which maps are drawn."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from numpy.typing import NDArray

from vibroimpact.figures.branches import axis_unit
from vibroimpact.scenarios.axes import logarithmic

_SYMBOLS = {
    "stiffness_ratio": "$\\lambda$",
    "gap_ratio": "$\\delta_0$",
    "relaxation_time": "$\\tau$",
    "damping_ratio": "$\\xi$",
}


def node_edges(values: xr.DataArray) -> NDArray[np.float64]:
    """Return borders half-way between nodes, in the unit of the axis, and the outer nodes."""
    nodes = axis_unit(values)[0] * values.values
    low, high = nodes[:-1], nodes[1:]
    middle = np.sqrt(low * high) if logarithmic(nodes) else 0.5 * (low + high)
    return np.concatenate([nodes[:1], middle, nodes[-1:]])


def plane_axes(ax: Axes, x: xr.DataArray, y: xr.DataArray) -> None:
    """Set scale, limits and labels of axes for the nodes of a map."""
    for axis, values in ((ax.xaxis, x), (ax.yaxis, y)):
        factor, unit = axis_unit(values)
        name = str(values.name)
        symbol = f" {_SYMBOLS[name]}" if name in _SYMBOLS else ""
        label = f"{values.attrs['long_name']}{symbol} ({unit})"
        scale_axis(axis, factor * values.values, label)


def scale_axis(axis: Any, values: NDArray[np.float64], label: str) -> None:
    """Set scale, limits and label of an axis: a logarithmic scale if the values are so spaced."""
    which = axis.axis_name
    if logarithmic(values):
        axis.axes.set(**{f"{which}scale": "log"})
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())
    ends = values.min(), values.max()
    axis.axes.set(**{f"{which}lim": ends, f"{which}label": label})
