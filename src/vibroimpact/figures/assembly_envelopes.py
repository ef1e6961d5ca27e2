"""Largest responses of several masses over their order, such as the storeys of a building."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from vibroimpact.errors import InputError
from vibroimpact.figures.assembly_motion import chains, history
from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import by_name, looks
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.style import EDGE, CurveStyle, panels
from vibroimpact.model import Assembly
from vibroimpact.model.assembly.names import GROUND
from vibroimpact.model.names import literal
from vibroimpact.model.quantities import GRAVITY
from vibroimpact.response.totals import totals


@finished
def mass_envelopes(
    motions: xr.Dataset | Mapping[str, xr.Dataset], axes: Any = None, *, title: str | None = None
) -> Panels:
    """Draw the largest displacement, drift and acceleration of each mass of an assembly.

    The masses are rows, the first one at the bottom, as the storeys of a building. A row of masses
    that links join is a curve; another building begins another curve. The left panel shows the
    largest and the smallest displacement relative to the base. A drift is the largest absolute
    displacement relative to the body below: the mass that a link joins and that precedes it in the
    assembly, or the base. The right panel shows the largest absolute acceleration, without the
    infinite one of a rigid impact.

    The values are those of `totals`, exact between samples. If the masses are from matrices, which
    name no links, the body below is the preceding mass, and the drift is the largest of the
    samples.

    Parameters
    ----------
    motions
        Dataset of `simulate`, `steady` or `orbit` with samples, of a rig with an `Assembly`. To
        compare motions of the same masses, pass a mapping from names to datasets.
    axes
        Three Axes. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    tuple of Axes
        The Axes of displacement, drift and acceleration. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If a dataset does not hold such a motion, or if the motions are of different masses.
    """
    named = by_name(motions, "motion")
    if not named:
        raise InputError("motions: empty; pass at least one motion of an assembly")
    every = {name: history(motion).assembly for name, motion in named.items()}
    assembly = next(iter(every.values()))
    for name, other in every.items():
        if other.names != assembly.names:
            raise InputError(
                f"motions: {name!r} has the masses {', '.join(other.names)}, not "
                f"{', '.join(assembly.names)}; pass motions of the same masses"
            )
    count = len(assembly.names)
    size = (7.2, 1.5 + 0.34 * max(count, 3))
    panel_axes = panels(axes, 3, "displacement, drift and acceleration", size, title, beside=True)
    layout = panel_axes[0].figure.get_layout_engine() if axes is None else None
    if isinstance(layout, ConstrainedLayoutEngine):
        layout.set(w_pad=0.1)  # inches, between the labels of ticks at the edges of two panels
    for (name, motion), look in zip(named.items(), looks(list(named)), strict=True):
        _draw(panel_axes, motion, every[name], look)
    labels = ("relative displacement (mm)", "drift (mm)", "absolute acceleration (g)")
    for ax, label in zip(panel_axes, labels, strict=True):
        ax.set_xlabel(base_label(label, named.values()))
        ax.set_ylim(-0.5, count - 0.5)
        ax.set_yticks(range(count), [literal(name) for name in assembly.names])
        ax.grid(True, axis="y", linewidth=0.4, color="0.85")
        ax.xaxis.set_major_locator(MaxNLocator(4))
        ax.margins(x=0.12)
    panel_axes[0].axvline(0.0, color=EDGE, linewidth=0.6, zorder=1)
    for ax in panel_axes[1:]:
        ax.set_xlim(0.0, ax.get_xlim()[1])
        place = ax.get_subplotspec()
        if place is not None and axes is None and not place.is_first_col():
            ax.tick_params(labelleft=False)
    if len(named) > 1:
        entries = [Line2D([], [], label=one.label, **_style(one)) for one in looks(list(named))]
        add_legend(panel_axes[0], entries, columns=2)
    return panel_axes


def _style(look: CurveStyle) -> dict[str, Any]:
    return look.marks(empty="white") | look.line


def _draw(
    panel_axes: tuple[Axes, ...], motion: xr.Dataset, assembly: Assembly, look: CurveStyle
) -> None:
    moved, drift, shaken = panel_axes
    rank = {name: i for i, name in enumerate(assembly.names)}
    extrema = totals(motion)
    for row in chains(assembly):
        names = [name for name, _ in row]
        at = [rank[name] for name in names]
        for side in ("displacement_max", "displacement_min"):
            far = extrema[side].sel(mass=names).values
            moved.plot(in_unit(1e3) * far, at, zorder=3, **_style(look))
        drift.plot(
            [in_unit(1e3) * _drift(motion, extrema, assembly, *pair) for pair in row],
            at,
            zorder=3,
            **_style(look),
        )
        most = extrema["peak_acceleration"].sel(mass=names).values
        shaken.plot(in_unit(1.0 / GRAVITY) * most, at, zorder=3, **_style(look))


def _drift(
    motion: xr.Dataset, extrema: xr.Dataset, assembly: Assembly, mass: str, below: str
) -> float:
    """Return the largest absolute displacement of a mass relative to the body below (m)."""
    for name, link in assembly.links.items():
        if {link.left, link.right} == {mass, below}:
            return float(extrema["peak_drift"].sel(link=name))
    moved = motion["displacement"].sel(mass=mass)
    apart = moved if below == GROUND else moved - motion["displacement"].sel(mass=below)
    return float(np.abs(apart.values).max(initial=0.0))
