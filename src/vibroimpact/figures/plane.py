"""The plane of two parameters in which maps are drawn."""

from __future__ import annotations

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
        if logarithmic(values.values):
            ax.set(**{f"{axis.axis_name}scale": "log"})
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            axis.set_minor_formatter(NullFormatter())
        ends = factor * values.values[[0, -1]]
        ax.set(
            **{
                f"{axis.axis_name}lim": tuple(ends),
                f"{axis.axis_name}label": f"{values.attrs['long_name']}{symbol} ({unit})",
            }
        )
