"""Basin stability over a parameter: the share of the states that lead to each motion."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib import patheffects
from matplotlib.axes import Axes

from vibroimpact.errors import InputError
from vibroimpact.figures.basins import basin_entry, colour_of, write_number
from vibroimpact.figures.branches import axis_unit
from vibroimpact.figures.finish import finished
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new

_ROUNDING = 1e-9
"""Rounding error of a sum of shares (per cent)."""


@finished
def basin_shares(data: xr.Dataset, ax: Axes | None = None, *, title: str | None = None) -> Axes:
    """Draw the basin stability of each motion over a parameter, as stacked areas.

    Error bars show the 95 % intervals of the shares.

    Parameters
    ----------
    data
        Dataset of `vibroimpact.basin_stability` along a parameter.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset has no shares along a parameter.
    """
    if "share" not in data or data["share"].ndim != 2:
        raise InputError(
            "data: the shares do not depend on a parameter; pass the result of basin_stability "
            "with vary="
        )
    ax = axes_or_new(ax, (7.2, 4.4), title)
    along = data[str(data["share"].dims[0])]
    factor, unit = axis_unit(along)
    x = factor * along.values
    share = 100.0 * data["share"].values
    top = np.cumsum(share, axis=1)
    handles = []
    for number in range(share.shape[1]):
        low, high = top[:, number] - share[:, number], top[:, number]
        ax.fill_between(
            x, low, high, facecolor=colour_of(number), edgecolor="black", linewidth=0.6, zorder=2
        )
        handles.append(basin_entry(colour_of(number), f"motion {number + 1}"))
        widest = int(np.argmax(share[:, number]))
        if share[widest, number] > 4.0:
            inner = slice(1, -1) if len(x) > 2 else slice(None)
            at = np.arange(len(x))[inner][int(np.argmax(share[inner, number]))]
            write_number(ax, number, (x[at], 0.5 * (low[at] + high[at])), ax.transData)
        if number + 1 == share.shape[1]:
            continue
        # Above the last there is nothing; a border's interval is that of the share below it.
        below = 100.0 * data["share_low"].values[:, number]
        above = 100.0 * data["share_high"].values[:, number]
        there = (share[:, number] > 0.0) & (high < 100.0 - _ROUNDING)
        bars = ax.errorbar(
            x[there],
            high[there],
            yerr=[(share[:, number] - below)[there], (above - share[:, number])[there]],
            linestyle="",
            color="black",
            linewidth=0.8,
            capsize=2.0,
            zorder=3,
        )
        for line in (*bars.lines[1], *bars.lines[2]):
            line.set_path_effects([patheffects.withStroke(linewidth=2.0, foreground="white")])
    ends = (x.min(), x.max()) if len(x) > 1 else (x[0] - 0.5, x[0] + 0.5)
    ax.set(
        xlim=ends,
        ylim=(0.0, 100.0),
        xlabel=f"{along.attrs['long_name']} ({unit})",
        ylabel="share of the states (%)",
    )
    add_legend(ax, handles, columns=5)
    return ax
