"""Absolute acceleration over relative displacement, as in the paper's Fig. 4a."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.figures.motion_style import axes_or_new, gap_lines, name_lines, named, shown
from vibroimpact.figures.own_units import in_own_units, in_unit


@in_own_units
def hysteresis_cycle(
    motions: xr.Dataset | Mapping[str, xr.Dataset],
    ax: Axes | None = None,
    *,
    title: str | None = None,
) -> Axes:
    """Draw the absolute acceleration over the relative displacement (hysteresis loop).

    The acceleration times the mass, with the opposite sign, is the force of the isolator and the
    bumpers on the mass. Therefore the enclosed area is proportional to the energy that they
    dissipate per period. The acceleration jumps where a contact begins.

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
    ax = axes_or_new(ax, (5.2, 4.4), title)
    curves = shown(named(motions, records=True))
    for curve in curves:
        long = curve.at[-1] - curve.at[0] > 20.0
        ax.plot(
            in_unit(1e3) * curve.values["displacement"],
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
