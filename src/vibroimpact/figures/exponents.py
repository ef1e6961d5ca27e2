"""Lyapunov exponents over the frequency or another parameter."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.errors import InputError
from vibroimpact.figures.branches import axis_unit
from vibroimpact.figures.finish import finished
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.style import MOTIONS, fit_x_axis
from vibroimpact.model.names import literal

_WIDE = 2.0
"""Half width of the band, in standard uncertainties."""


@finished
def exponent_curves(data: xr.Dataset, ax: Axes | None = None, *, title: str | None = None) -> Axes:
    """Draw the largest Lyapunov exponent of one or several rigs, with a band of two uncertainties.

    Parameters
    ----------
    data
        Dataset of `lyapunov_exponents` over the frequency, or over one parameter that was varied.
        Or a dataset of `bifurcation_diagram` with one of its starts selected.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset has no exponents, or if they do not depend on exactly one parameter.
    """
    if "exponents" not in data or "exponent" not in data["exponents"].dims:
        raise InputError("data: it has no exponents; pass the result of lyapunov_exponents")
    dataset = data[["exponents", "exponents_uncertainty"]]
    if "rig" not in dataset.dims:
        dataset = dataset.expand_dims("rig")
    over = [str(dim) for dim in dataset["exponents"].dims if dim not in ("rig", "exponent")]
    wide = [dim for dim in over if dataset.sizes[dim] > 1]
    if len(wide) != 1:
        raise InputError(
            f"data: the exponents depend on {', '.join(wide)}, but only one of these can be drawn; "
            f"select a value of the others, such as data.isel({wide[0]}=0)"
            if wide
            else "data: there is one set of exponents; compute them for several values of one "
            "parameter"
        )
    (name,) = wide
    dataset = dataset.squeeze([dim for dim in over if dim != name], drop=True)
    scale, unit = axis_unit(dataset[name])
    x = scale * dataset[name].values
    ax = axes_or_new(ax, (6.4, 3.8), title)
    several = dataset.sizes["rig"] > 1
    for r in range(dataset.sizes["rig"]):
        one, look = dataset.isel(rig=r).transpose(name, "exponent"), MOTIONS[r % len(MOTIONS)]
        rig = f"{literal(str(one['rig'].item()))}, " if several else ""
        for k, words in enumerate(("largest", "second")[: dataset.sizes["exponent"]]):
            y, error = (one[key].values[:, k] for key in ("exponents", "exponents_uncertainty"))
            drawn = look._replace(
                dashes="-" if k == 0 else ":",
                width=look.width if k == 0 else 0.8,
                marker=look.marker if several and k == 0 else "",
            )
            every = max(1, len(x) // 20)
            style = drawn.marks() | drawn.line
            ax.plot(x, y, markevery=every, label=f"{rig}{words}", **style)
            known = np.isfinite(error)
            ax.fill_between(
                x,
                y - _WIDE * error,
                y + _WIDE * error,
                where=known,
                color=look.colour,
                alpha=0.2,
                linewidth=0,
            )
    ax.axhline(0.0, color="0.3", linewidth=0.7, zorder=1)
    fit_x_axis(ax, x)
    ax.set_xlabel(f"{dataset[name].attrs['long_name']} ({unit})")
    ax.set_ylabel("Lyapunov exponents (1/s)")
    add_legend(ax, columns=2)
    return ax
