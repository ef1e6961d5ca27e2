"""Pareto fronts of designs: acceleration over displacement."""

from __future__ import annotations

import textwrap
from functools import reduce
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

from vibroimpact.datasets.stops import over_parts
from vibroimpact.errors import InputError
from vibroimpact.figures.design import (
    PRESENT,
    best_label,
    beyond_limits,
    parameters_of,
    present_values,
    quantity_label,
    quantity_of,
)
from vibroimpact.figures.finish import finished
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.model.units import pretty

_Array = NDArray[np.float64]

_NAMED = 5
"""Largest number of points of a front whose parameters are listed."""

_SAME = 1e-9
"""Relative difference up to which a value of a chart is that of the rig."""


@finished
def pareto_front(data: xr.Dataset, ax: Axes | None = None, *, title: str | None = None) -> Axes:
    """Draw the acceleration of all designs over their displacement, with the Pareto front.

    Some designs, which are evenly spaced along the front, are numbered. Their parameters are listed
    next to the axes. Crosses mark designs that exceed a limit.

    A star marks the present design, which is the rig itself. If its parameters are not among those
    of the designs, its response is unknown; the legend then states this.

    Parameters
    ----------
    data
        Dataset of `design_chart`.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If ``data`` is not a dataset of `design_chart`, or if no design was computed.
    """
    dims = parameters_of(data)
    u, a = (
        quantity_label(data, name)[0] * over_parts(data[name]).values.ravel()
        for name in ("peak_displacement", "peak_acceleration")
    )
    best = data["pareto"].values.ravel().astype(bool)
    finite = np.isfinite(u) & np.isfinite(a)
    if not finite.any():
        raise InputError("data: no design has finite peaks; compute other designs to draw them")
    ax = axes_or_new(ax, (6.4, 4.8), title)
    hits = data["hitting"].values.ravel() > 0.0
    beyond = beyond_limits(data).ravel()
    looks = (
        (beyond, "x", "0.75", 4.0, 2, "exceeds a limit"),
        (hits & ~beyond, "o", "0.75", 4.0, 2, "hits a stop"),
        (~hits & ~beyond, "o", "none", 9.0, 5, "hits no stop"),
    )
    for mine, mark, face, size, above, label in looks:
        if (finite & mine).any():
            ax.plot(
                u[finite & mine],
                a[finite & mine],
                linestyle="",
                marker=mark,
                markersize=size,
                markerfacecolor=face,
                markeredgecolor="0.5",
                markeredgewidth=0.7,
                label=label,
                zorder=above,
            )
    order = np.flatnonzero(best)[np.lexsort((a[best], u[best]))]
    if best.any():
        ax.plot(
            u[order],
            a[order],
            color="black",
            linewidth=1.2,
            marker="s",
            markersize=4.5,
            label=best_label(data),
            zorder=4,
        )
    _mark_present(ax, data, dims, u, a)
    ax.set_xlabel(quantity_label(data, "peak_displacement")[1])
    ax.set_ylabel(quantity_label(data, "peak_acceleration")[1])
    ax.set_ylim(bottom=0.0)
    ax.margins(x=0.08)
    if best.any():
        _name_points(ax, data, dims, order, u, a)
    add_legend(ax, columns=2 if beyond.any() else 3)
    return ax


def _mark_present(ax: Axes, data: xr.Dataset, dims: list[str], u: _Array, a: _Array) -> None:
    """Mark the design that is the rig itself; report in the legend if it was not computed."""
    present = present_values(data, dims)
    if not np.isfinite(present).all():  # as of a common gap of two stops whose gaps differ
        return
    same = [
        np.isclose(data[dim].values, value, rtol=_SAME, atol=0.0)
        for dim, value in zip(dims, present, strict=True)
    ]
    at = np.flatnonzero(reduce(np.logical_and.outer, same))
    known = at[np.isfinite(u[at]) & np.isfinite(a[at])]
    ax.plot(
        u[known] if len(known) else [],
        a[known] if len(known) else [],
        label="present design" if len(known) else "present design: not computed",
        zorder=7,
        **PRESENT | ({} if len(known) else {"marker": ""}),
    )


def _name_points(
    ax: Axes, data: xr.Dataset, dims: list[str], order: NDArray[Any], u: _Array, a: _Array
) -> None:
    """Number some points that are evenly spaced along the front, and list their parameters."""
    wide, high = max(np.ptp(u[order]), 1e-12), max(np.ptp(a[order]), 1e-12)
    along = np.concatenate(
        [[0.0], np.cumsum(np.hypot(np.diff(u[order]) / wide, np.diff(a[order]) / high))]
    )
    wanted = np.linspace(0.0, along[-1], min(_NAMED, len(order)))
    chosen = dict.fromkeys(int(np.abs(along - at).argmin()) for at in wanted)
    lines = []
    for number, k in enumerate(chosen, start=1):
        at = np.unravel_index(order[k], data["pareto"].shape)
        values = [
            pretty(float(f"{float(data[dim][i]):.3g}"), quantity_of(data[dim]))
            for dim, i in zip(dims, at, strict=True)
        ]
        lines.append(f"{number}  {', '.join(values)}")
        ax.annotate(
            str(number),
            (u[order[k]], a[order[k]]),
            xytext=(-4.0, -4.0),
            textcoords="offset points",
            ha="right",
            va="top",
            fontsize="small",
            fontweight="bold",
            zorder=6,
        )
    names = ", ".join(str(data[dim].attrs["long_name"]) for dim in dims)
    if len(chosen) < len(order):
        names = f"{len(chosen)} of the {len(order)} designs that are {best_label(data)}: {names}"
    told_of = "\n".join([*textwrap.wrap(names, 26), *lines])
    ax.text(
        1.02,
        1.0,
        told_of,
        transform=ax.transAxes,
        ha="left",
        va="top",
        fontsize="small",
        linespacing=1.4,
    )
