"""Portraits of two masses: one over the other, or their approach at a stop."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from vibroimpact.arguments import check_name
from vibroimpact.errors import InputError
from vibroimpact.figures.assembly_motion import band_of, chosen, history
from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.portrait import SECTION
from vibroimpact.model import Assembly
from vibroimpact.model.assembly.names import GROUND
from vibroimpact.model.names import literal


@finished
def pair_portrait(
    motion: xr.Dataset,
    first: str,
    second: str,
    ax: Axes | None = None,
    *,
    quantity: Literal["displacement", "velocity", "approach"] = "displacement",
    cycles: float | None = None,
    title: str | None = None,
) -> Axes:
    """Draw two masses of an assembly against each other.

    In the plane of their displacements, the area beyond the gap of each stop between the two is
    shaded: there, the stop is compressed, or would be if it were not still relaxing. Dashed lines
    are the gaps. Diamonds are the points of the stroboscopic section.

    Parameters
    ----------
    motion
        Dataset of `simulate`, `steady` or `orbit` with samples, of a rig with an `Assembly`.
    first, second
        Names of the two masses. ``"ground"`` as the second one is the base.
    ax
        Axes to draw on. Default: a new figure.
    quantity
        ``"displacement"`` draws that of the second mass over that of the first, ``"velocity"`` the
        same of velocities, and ``"approach"`` the velocity of the first mass relative to the second
        over its displacement relative to the second.
    cycles
        Number of forcing cycles that are drawn, up to the end of the motion. Default: all.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset does not hold such a motion, if a mass or the quantity does not exist, or if
        both masses are the same.
    """
    shown = history(motion, cycles)
    names = shown.assembly.names
    (first,) = chosen(first, names, "mass", "first")
    others = (*names, GROUND) if quantity == "approach" else names
    (second,) = chosen(second, others, "mass", "second")
    if first == second:
        raise InputError(f"second: {second!r} is also the first mass; pass two different masses")
    known = ("displacement", "velocity", "approach")
    check_name(quantity, known, "quantity")
    ax = axes_or_new(ax, (5.2, 4.4), title)
    moved, fast = (
        {name: shown.motion[what].sel(mass=name).values for name in names}
        for what in ("displacement", "velocity")
    )
    still = np.zeros(len(shown.at))
    if quantity == "approach":
        x = in_unit(1e3) * (moved[first] - moved.get(second, still))
        y = fast[first] - fast.get(second, still)
        pair = f"{literal(first)} relative to {literal(second)}"
        labels = (f"displacement of {pair} (mm)", f"velocity of {pair} (m/s)")
    else:
        values, factor = (moved, in_unit(1e3)) if quantity == "displacement" else (fast, 1.0)
        x, y = factor * values[first], factor * values[second]
        unit = "mm" if quantity == "displacement" else "m/s"
        labels = (
            f"relative {quantity} of {literal(first)} ({unit})",
            f"relative {quantity} of {literal(second)} ({unit})",
        )
    long = shown.span[1] - shown.span[0] > 20.0
    ax.plot(
        x, y, color="black", linewidth=0.4 if long else 1.0, alpha=0.6 if long else 1.0, zorder=3
    )
    handles: list[Line2D | Patch] = []
    if "cycle" in motion:
        whole = np.flatnonzero(np.isclose(shown.at, np.round(shown.at), rtol=0.0, atol=1e-9))
        whole = whole[:-1] if len(whole) > 1 else whole
        points = ax.plot(
            x[whole],
            y[whole],
            linestyle="",
            marker="D",
            markersize=3.0 if long else 5.0,
            color="black",
            markeredgecolor="white",
            label=SECTION,
            zorder=5,
        )
        handles += points
    if quantity != "velocity":
        handles += _gaps(ax, shown.assembly, first, second, quantity == "approach")
    if quantity != "approach":
        labels = (base_label(labels[0], [motion]), base_label(labels[1], [motion]))
    ax.set_xlabel(labels[0])
    ax.set_ylabel(labels[1])
    if handles:
        add_legend(ax, handles, columns=3)
    return ax


def _gaps(ax: Axes, assembly: Assembly, first: str, second: str, approach: bool) -> list[Patch]:
    """Draw where the stops between two bodies are met, and return their legend entries."""
    ax.autoscale_view()
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    entries = []
    for name, stop in assembly.stops.items():
        if {stop.left, stop.right} != {first, second}:
            continue
        band = band_of(assembly, name)
        gap = in_unit(1e3) * stop.stop.gap
        # The bodies meet at u_first − u_second = side · gap.
        side = 1.0 if stop.left == first else -1.0
        how: dict[str, Any] = {**band.style, "linewidth": 0.0}
        if approach:
            end = max(right, side * gap) if side > 0 else min(left, side * gap)
            ax.axvspan(side * gap, end, zorder=0, **how)
            ax.axvline(side * gap, color="black", linestyle="--", linewidth=0.8, zorder=2)
        else:
            x = np.array([left, right])
            line = x - side * gap
            edge = min(low, line.min()) if side > 0 else max(high, line.max())
            ax.fill_between(x, line, edge, zorder=0, **how)
            ax.plot(x, line, color="black", linestyle="--", linewidth=0.8, zorder=2)
        entries.append(band.entry(literal(name)))
    ax.set_xlim(left, right)
    ax.set_ylim(low, high)
    return entries
