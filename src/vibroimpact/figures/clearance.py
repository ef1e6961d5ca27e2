"""Clearances against time, with a magnified panel for short flights, as in the paper's Fig. 18c."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.errors import InputError
from vibroimpact.figures.motions import SIDES, Shown, named, shown
from vibroimpact.figures.style import EDGE, LEGEND, panels

_LINES: dict[str, Any] = {
    "right": {"linestyle": "-", "linewidth": 1.3},
    "left": {"linestyle": "--", "linewidth": 1.1},
}


def clearances(
    motions: xr.Dataset | Mapping[str, xr.Dataset],
    axes: Any = None,
    *,
    cycles: float = 2.0,
    zoom: float | None = None,
    title: str | None = None,
) -> tuple[Axes, Axes]:
    """Draw the clearances G_R and G_L (eq. 4) against t/T, and magnified near zero.

    Parameters
    ----------
    motions
        Dataset of `steady`, or of `simulate` with samples; or several of them by name.
    axes
        Two Axes: the whole, and the magnified part. None makes a new figure.
    cycles
        How many forcing cycles are shown.
    zoom
        Height of the magnified panel in m. None for a tenth of the largest clearance, or 1.3
        times the largest one in which the mass flies, if that is less.
    title
        Title of a new figure.

    Raises
    ------
    InputError
        If a dataset is not that of a motion with samples and bumpers, or `zoom` is not positive.
    """
    curves = shown(named(motions), cycles)
    if not any(curve.gaps for curve in curves):
        raise InputError("motions: there is no bumper; a motion of a rig with one is accepted")
    if zoom is not None and not zoom > 0.0:
        raise InputError(f"zoom: {zoom!r}; a height greater than 0 m is accepted")
    whole, near = panels(axes, 2, "the whole and the magnified part", (7.2, 5.4), title)
    for ax in (whole, near):
        for curve in curves:
            for side in curve.gaps:
                ax.plot(
                    curve.at,
                    1e3 * curve.values[f"{side}_clearance"],
                    color=curve.look.colour
                    if len(curves) > 1
                    else ("#c8102e" if side == "right" else "#1f4fbf"),
                    label=_label(curve, side, len(curves)),
                    **_LINES[side],
                )
        ax.axhline(0.0, color=EDGE, linewidth=0.6)
        ax.set_xlim(min(c.at[0] for c in curves), max(c.at[-1] for c in curves))
        ax.set_ylabel("clearance (mm)")
    height = 1e3 * (zoom if zoom is not None else _flight_height(curves))
    near.set_ylim(-0.08 * height, height)
    near.set_ylabel("clearance (mm),\nmagnified")
    near.set_xlabel("time in forcing cycles $t/T$ (–)")
    whole.legend(ncols=4, **LEGEND)
    return whole, near


def _label(curve: Shown, side: str, motions: int) -> str:
    name = f"$G_{side[0].upper()}$"
    return f"{name}, {curve.look.label}" if motions > 1 else f"{name}, {side}"


def _flight_height(curves: list[Shown]) -> float:
    """A height in which a short flight is seen: both clearances are positive only in flight."""
    largest = max(float(c.values[f"{s}_clearance"].max()) for c in curves for s in c.gaps)
    flying = 0.0
    for curve in curves:
        sides = [curve.values[f"{side}_clearance"] for side in SIDES.values() if side in curve.gaps]
        both = sides[0] if len(sides) == 1 else sides[0].clip(max=sides[1])
        flying = max(flying, float(both.max()))
    return min(0.1 * largest, 1.3 * flying) or largest or 1.0
