"""One feature of the nodes of a map, such as the number of ranges with chaotic motions."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm

from vibroimpact.arguments import check_name, check_variables
from vibroimpact.errors import InputError
from vibroimpact.figures.legends import fit_labels
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.plane import node_edges, plane_axes
from vibroimpact.model.argument_types import String
from vibroimpact.model.public import public

_MOST = 12
"""Largest count up to which each count has its own colour."""


@public
def feature_map(
    data: xr.Dataset, name: String, ax: Axes | None = None, *, title: String | None = None
) -> Axes:
    """Draw one feature of a map of scenarios.

    Light colours are small values, and dark colours are large values.

    Parameters
    ----------
    data
        Dataset of `vibroimpact.scenario_map`. Nodes that were not computed are left white.
    name
        Name of the feature, such as ``"chaotic_count"`` or ``"extent"``.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset is not a map, or if it does not contain the feature.
    """
    check_variables(data, (), "data", "the result of scenario_map")
    if "scenario" not in data or data["scenario"].ndim != 2:
        raise InputError("data: this is not a map of scenarios; pass the result of scenario_map")
    known = [str(n) for n in data.data_vars if n not in ("scenario", "level")]
    check_name(name, known, "name")
    ax = axes_or_new(ax, (6.4, 4.6), title)
    second, first = (str(dim) for dim in data["scenario"].dims)
    counted = name.endswith("_count")
    values = np.ma.masked_where(data["level"].values < 0, data[name].values)
    colours = colormaps["YlGnBu"]
    norm = None
    if counted and values.max() <= _MOST:
        norm = BoundaryNorm(np.arange(-0.5, max(int(values.max()), 1) + 1.0), colours.N)
    mesh = ax.pcolormesh(
        node_edges(data[first]),
        node_edges(data[second]),
        values,
        cmap=colours,
        norm=norm,
        rasterized=True,
    )
    plane_axes(ax, data[first], data[second])
    bar = ax.figure.colorbar(mesh, ax=ax)
    bar.set_label(f"{data[name].attrs['long_name']} (–)")
    if norm is not None:
        bar.set_ticks(list(range(int(values.max()) + 1)))
        bar.ax.minorticks_off()
    fit_labels(ax)
    # The panels of other maps in the same figure take some of its height later.
    fit_labels(bar.ax, share=0.8)
    return ax
