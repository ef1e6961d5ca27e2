"""Absolute acceleration over relative displacement, as in the paper's Fig. 4a."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.figures.motion_style import axes_or_new, gap_lines, name_lines, named, shown


def hysteresis_cycle(
    motions: xr.Dataset | Mapping[str, xr.Dataset],
    ax: Axes | None = None,
    *,
    title: str | None = None,
) -> Axes:
    """Draw absolute acceleration over relative displacement.

    Multiplied by minus the mass, the acceleration is the force of isolator and bumpers on the mass.
    The enclosed area is proportional to the energy that they dissipate per period. The acceleration
    jumps where contact begins.

    Parameters
    ----------
    motions
        Dataset of `steady`, or of `simulate` with samples, including motions through a `Record`; or
        several of them by name. A name that contains "forward" is drawn red, "backward" blue.
    ax
        Axes to draw on. None makes a new figure.
    title
        Title of a new figure.

    Raises
    ------
    InputError
        If a dataset is not that of a motion with samples.
    """
    ax = axes_or_new(ax, (5.2, 4.4), title)
    curves = shown(named(motions, records=True))
    for curve in curves:
        long = curve.at[-1] - curve.at[0] > 20.0
        ax.plot(
            1e3 * curve.values["displacement"],
            curve.values["acceleration"],
            color=curve.look.colour,
            linestyle="-" if long else curve.look.dashes,
            linewidth=0.25 if long else 1.2,
            label=curve.look.label,
            zorder=3,
        )
    gap_lines(ax, curves, horizontal=False)
    ax.set_xlabel("relative displacement $u$ (mm)")
    ax.set_ylabel("absolute acceleration $\\ddot u + A_t$ (m/s²)")
    name_lines(ax, curves)
    return ax
