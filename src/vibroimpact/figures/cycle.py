"""Absolute acceleration or force over displacement, as in the paper's Fig. 4a."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.datasets.description import base_at_rest
from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.motion_style import (
    axes_or_new,
    drawn_motions,
    force_unit,
    gap_lines,
    name_lines,
    named,
)


@finished
def hysteresis_cycle(
    motions: xr.Dataset | Mapping[str, xr.Dataset],
    ax: Axes | None = None,
    *,
    title: str | None = None,
) -> Axes:
    """Draw the absolute acceleration over the relative displacement (hysteresis loop).

    If the base moves, the acceleration times the mass, with the opposite sign, is the force of the
    isolator and the bumpers on the base. If a force acts on the mass of all motions, it is not:
    then the force transmitted to the base is drawn instead. Therefore the enclosed area is
    proportional to the energy that the isolator and the bumpers dissipate per period. The curves
    jump where a contact begins.

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
    named_motions = named(motions, records=True)
    curves = drawn_motions(named_motions)
    force = all(base_at_rest(motion) for motion in named_motions.values())
    name, factor = "acceleration", 1.0
    label = "absolute acceleration $\\ddot u + A_t$ (m/s²)"
    if force:
        name, unit = "transmitted_force", force_unit(curves)
        factor, label = 1.0 / unit.size, f"transmitted force ({unit.symbol})"
    for curve in curves:
        moved = in_unit(1e3) * curve.values["displacement"]
        ax.plot(moved, factor * curve.values[name], **curve.loops)
    gap_lines(ax, curves, horizontal=False)
    ax.set_xlabel(base_label("relative displacement $u$ (mm)", named_motions.values()))
    ax.set_ylabel(label)
    name_lines(ax, curves)
    return ax
