"""Curves of bifurcations in the plane of two parameters."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.errors import InputError
from vibroimpact.figures.branches import MARKS, axis_unit
from vibroimpact.figures.finish import finished
from vibroimpact.figures.labels import Names
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new, by_name


@finished
def bifurcation_curves(
    curves: xr.Dataset | Mapping[str, xr.Dataset],
    ax: Axes | None = None,
    *,
    title: str | None = None,
) -> Axes:
    """Draw curves of bifurcations in the plane of two parameters, with their cusps.

    Parameters
    ----------
    curves
        Dataset of `bifurcation_curve`. For several curves, pass a mapping from names to datasets
        with the same two parameters. A name is written on its curve, unless it is the kind of the
        bifurcation.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If a dataset holds no curve, or if the parameters of the datasets differ.
    """
    names, datasets = list(by_name(curves)), list(by_name(curves).values())
    if not datasets or any("other_parameter" not in data.attrs for data in datasets):
        wrong = "one of them is not a bifurcation curve" if datasets else "empty"
        raise InputError(f"curves: {wrong}; pass results of bifurcation_curve")
    pairs = {(data.attrs["parameter"], data.attrs["other_parameter"]) for data in datasets}
    if len(pairs) > 1:
        raise InputError(
            f"curves: their pairs of parameters differ, {sorted(pairs)}; pass only curves of one "
            "pair"
        )
    ((first, second),) = pairs
    ax = axes_or_new(ax, (6.4, 4.8), title)
    scales, units = zip(*(axis_unit(datasets[0][name]) for name in (first, second)), strict=True)
    seen = set()
    for data in datasets:
        kind = data.attrs["kind"]
        x, y = scales[0] * data[first].values, scales[1] * data[second].values
        ax.plot(x, y, label=None if kind in seen else MARKS[kind].label, **MARKS[kind].line)
        seen.add(kind)
        if data.sizes["cusp_number"]:
            ax.plot(
                scales[0] * data["cusp_first"].values,
                scales[1] * data["cusp_second"].values,
                linestyle="",
                marker="v",
                color="black",
                markersize=5,
                label=None if "cusp" in seen else "cusp",
            )
            seen.add("cusp")
    ax.set_xlabel(f"{datasets[0][first].attrs['long_name']} ({units[0]})")
    ax.set_ylabel(f"{datasets[0][second].attrs['long_name']} ({units[1]})")
    add_legend(ax)
    written = Names(ax)
    for name, data in zip(names, datasets, strict=True):
        if name not in ("", data.attrs["kind"]):
            x, y = (k * data[p].values for k, p in zip(scales, (first, second), strict=True))
            written.write(x, y, name, MARKS[data.attrs["kind"]].colour, once=False)
    return ax
