"""Clearances over time, with a magnified panel for short flights, as in the paper's Fig. 18c."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.errors import InputError
from vibroimpact.figures.finish import finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import DrawnMotion, cycles_shown, drawn_motions, named
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.style import EDGE, SHADE, panels

_LINES: dict[str, Any] = {
    "right": {"linestyle": "-", "linewidth": 1.3},
    "left": {"linestyle": "--", "linewidth": 1.1},
}


@finished
def clearances(
    motions: xr.Dataset | Mapping[str, xr.Dataset],
    axes: Any = None,
    *,
    cycles: float | None = None,
    zoom: float | None = None,
    title: str | None = None,
) -> Panels:
    """Draw the clearances G_R and G_L (the paper's equation 4) over t/T.

    A second panel magnifies the shortest flight, where the clearances are close to zero.

    Parameters
    ----------
    motions
        Dataset of `steady`, or of `simulate` with samples. For several motions, pass a mapping from
        names to datasets.
    axes
        Two Axes: for the whole history, and for the magnified part. Default: a new figure.
    cycles
        Number of forcing cycles that are drawn. Default: two, or more cycles so that whole periods
        are drawn.
    zoom
        Length of the magnified part, in forcing cycles. It is centred on the shortest flight
        between two contacts. Default: five times the length of this flight.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If a dataset does not hold a motion with samples and bumpers, or if ``zoom`` is not
        positive.
    """
    given_motions = named(motions)
    curves = drawn_motions(given_motions, cycles_shown(given_motions, cycles, 2))
    if not any(curve.gaps for curve in curves):
        raise InputError(
            "motions: none of their rigs has a stop; pass a motion of a rig with a stop"
        )
    if zoom is not None and not 0.0 < zoom < math.inf:
        raise InputError(f"zoom: {zoom!r}; pass a number of cycles greater than 0")
    what = "the whole and the magnified part"
    panel_axes = panels(axes, 2, what, (7.2, 5.4), title, sharex=False)
    whole, near = panel_axes
    for ax in panel_axes:
        for curve in curves:
            for side in curve.gaps:
                ax.plot(
                    curve.at,
                    in_unit(1e3) * curve.values[f"clearance.{side}"],
                    color=curve.look.colour
                    if len(curves) > 1
                    else ("#c8102e" if side == "right" else "#1f4fbf"),
                    label=_label(curve, side, len(curves)),
                    **_LINES[side],
                )
        ax.axhline(0.0, color=EDGE, linewidth=0.6)
        ax.set_xlim(min(c.at[0] for c in curves), max(c.at[-1] for c in curves))
        ax.set_ylabel("clearance (mm)")
    begin, end, height = _shortest_flight(curves)
    first, last = min(c.at[0] for c in curves), max(c.at[-1] for c in curves)
    half = 0.5 * (zoom if zoom is not None else 5.0 * (end - begin))
    middle = 0.5 * (begin + end)
    near.set_xlim(max(middle - half, first), min(middle + half, last))
    near.set_ylim(-0.08 * height, height)
    near.set_ylabel("clearance (mm),\nmagnified")
    near.set_xlabel("time in forcing cycles $t/T$ (–)")
    whole.axvspan(*near.get_xlim(), color=SHADE, zorder=0)
    add_legend(whole)
    return panel_axes


def _label(curve: DrawnMotion, side: str, motions: int) -> str:
    name = f"$G_{side[0].upper()}$"
    return f"{name}, {curve.look.label}" if motions > 1 else f"{name}, {side}"


def _shortest_flight(curves: list[DrawnMotion]) -> tuple[float, float, float]:
    """Return start and end (forcing cycles) of the shortest flight, and twice its height (mm)."""
    best = None
    for curve in curves:
        contacts = sorted(curve.touching, key=lambda contact: contact[1])
        for (_, _, begin), (_, end, _) in itertools.pairwise(contacts):
            if end > begin and (best is None or end - begin < best[1] - best[0]):
                inside = (curve.at >= begin) & (curve.at <= end)
                sides = [curve.values[f"clearance.{side}"][inside] for side in curve.gaps]
                # That of the nearer bumper; the other may be far away all the time.
                highest = min(float(side.max()) for side in sides)
                best = (begin, end, in_unit(1e3) * 2.0 * highest)
    if best is None:  # no flight between two contacts: all there is
        at = np.concatenate([curve.at for curve in curves])
        highest = max(float(c.values[f"clearance.{s}"].max()) for c in curves for s in c.gaps)
        best = (float(at.min()), float(at.max()), in_unit(1e3) * highest)
    return best
