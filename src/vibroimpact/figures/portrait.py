"""Phase portraits, as in the paper's Figs. 8, 12 and 16."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.motion_style import (
    axes_or_new,
    drawn_motions,
    gap_lines,
    name_lines,
    named,
)

_MOST_VECTORS = 200_000
"""Number of points from which a curve is an image of 600 dpi in SVG and PDF files. With fewer
points, lines make a smaller file."""
SECTION = "stroboscopic section"
"""Legend entry of the points once per forcing cycle."""


@finished
def phase_portrait(
    motions: xr.Dataset | Mapping[str, xr.Dataset],
    ax: Axes | None = None,
    *,
    title: str | None = None,
) -> Axes:
    """Draw phase portraits: the relative velocity over the relative displacement.

    Dashed lines are the gaps. Diamonds are the points of the stroboscopic section at the initial
    phase of the motion. If there are many points, they are dots.

    Parameters
    ----------
    motions
        Dataset of `steady`, or of `simulate` with samples, including motions through a `Record`.
        For several motions, pass a mapping from names to datasets. If a name contains "forward",
        the curve is red. If it contains "backward", the curve is blue.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If a dataset does not hold a motion with samples.
    """
    named_motions = named(motions, records=True)
    ax = axes_or_new(ax, (5.2, 4.4), title)
    curves = drawn_motions(named_motions)
    for curve, motion in zip(curves, named_motions.values(), strict=True):
        u, v = in_unit(1e3) * curve.values["displacement"], curve.values["velocity"]
        alpha, many = 0.5 if curve.is_long else 1.0, len(u) > _MOST_VECTORS
        ax.plot(u, v, alpha=alpha, rasterized=many, **curve.loops)
        if "cycle" not in motion:  # through a record
            continue
        at = motion["cycle"].values
        whole = np.flatnonzero(np.isclose(at, np.round(at), rtol=0.0, atol=1e-9))
        whole = whole[:-1] if len(whole) > 1 else whole
        ax.scatter(
            in_unit(1e3) * motion["displacement"].values[whole],
            motion["velocity"].values[whole],
            s=7 if curve.is_long else 26,
            marker="o" if curve.is_long else "D",
            facecolor=curve.look.colour if curve.look.filled else "white",
            edgecolor="black",
            linewidth=0.3 if curve.is_long else 0.8,
            # One entry of the legend for all motions.
            label=None if ax.collections else SECTION,
            zorder=5,
            rasterized=len(whole) > _MOST_VECTORS,
        )
    gap_lines(ax, curves, horizontal=False)
    ax.set_xlabel(base_label("relative displacement $u$ (mm)", named_motions.values()))
    ax.set_ylabel(base_label("relative velocity $\\dot u$ (m/s)", named_motions.values()))
    name_lines(ax, curves)
    return ax
