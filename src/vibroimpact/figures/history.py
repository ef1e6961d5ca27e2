"""Time histories with the intervals of contact, as in the paper's Figs. 8 and 16."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import (
    DrawnMotion,
    cycles_label,
    cycles_shown,
    drawn_motions,
    force_unit,
    gap_lines,
    named,
)
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.style import BANDS, EDGE, Band, panels
from vibroimpact.model.oscillator import SIDES


class _Panel(NamedTuple):
    """The quantity of one panel, and the factor to its unit."""

    variable: str
    factor: float
    label: str


PANELS = (
    _Panel("displacement", 1e3, "relative\ndisplacement $u$ (mm)"),
    _Panel("acceleration", 1.0, "absolute acceleration\n$\\ddot u + A_t$ (m/s²)"),
    _Panel("velocity", 1.0, "relative\nvelocity $\\dot u$ (m/s)"),
)
_APPLIED: dict[str, Any] = {"color": "0.5", "linewidth": 0.9}
"""Style of the force on the mass."""


@finished
def time_history(
    motions: xr.Dataset | Mapping[str, xr.Dataset],
    axes: Any = None,
    *,
    cycles: float | None = None,
    title: str | None = None,
) -> Panels:
    """Draw displacement, absolute acceleration and relative velocity over t/T.

    If a force on the mass shakes all motions, a fourth panel shows the force that the isolator and
    the stops transmit to the base, over the force on the mass (grey).

    Each contact is a band between its exact start and end times. The band is hatched for the left
    bumper. A filled dot marks the start of a contact, an open dot its end, and a star the peak of
    the acceleration. Dashed lines are the gaps. The curves pass through the exact values at the
    start and the end of each contact. Where the acceleration jumps, they pass through the values
    before and after the jump. If there are several motions, the bands of each motion are drawn on a
    separate strip.

    Parameters
    ----------
    motions
        Dataset of `steady`, or of `simulate` with samples. For several motions, pass a mapping from
        names to datasets. If a name contains "forward", the curve is red. If it contains
        "backward", the curve is blue.
    axes
        Three Axes, or four under a force on the mass. Default: a new figure.
    cycles
        Number of forcing cycles that are drawn. The last cycles of a simulation are drawn. A
        periodic motion is repeated. Default: three, or more cycles so that whole periods are drawn.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    tuple of Axes
        The Axes of the displacement, the acceleration and the velocity, and under a force on the
        mass of the transmitted force. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If a dataset does not hold a motion with samples, or if the number of axes is wrong.
    """
    given_motions = named(motions)
    curves = drawn_motions(given_motions, cycles_shown(given_motions, cycles, 3))
    drawn, what, handles = panels_of(given_motions), "displacement, acceleration and velocity", []
    if all("transmitted_force" in curve.values for curve in curves):
        unit = force_unit(curves)
        label = f"transmitted\nforce ({unit.symbol})"
        drawn.append(_Panel("transmitted_force", 1.0 / unit.size, label))
        what = "displacement, acceleration, velocity and transmitted force"
        handles.append(Line2D([], [], label="force on the mass", **_APPLIED))
    count = len(drawn)
    panel_axes = panels(axes, count, what, (7.2, 0.4 + 2.4 * count), title)
    for ax, panel in zip(panel_axes, drawn, strict=True):
        history_panel(ax, curves, panel)
    panel_axes[-1].set_xlabel(cycles_label(given_motions))
    add_legend(panel_axes[0], history_legend(curves) + handles)
    return panel_axes


def panels_of(motions: Mapping[str, xr.Dataset]) -> list[_Panel]:
    """Return the panels of displacement, acceleration and velocity, with their labels."""
    return [panel._replace(label=base_label(panel.label, motions.values())) for panel in PANELS]


def history_panel(ax: Axes, curves: list[DrawnMotion], panel: _Panel) -> None:
    """Draw one quantity of the motions over t/T."""
    ax.set_xlim(min(c.at[0] for c in curves), max(c.at[-1] for c in curves))
    ax.axhline(0.0, color=EDGE, linewidth=0.6, zorder=1)
    for i, curve in enumerate(curves):
        for name in SIDES:
            spans = [(a, b) for s, a, b in curve.touching if s == name]
            band = _band(curve, name, len(curves))
            band.draw(ax, spans, (i, len(curves)), label=f"{name} contact")
        values = in_unit(panel.factor) * curve.values[panel.variable]
        ax.plot(curve.at, values, zorder=3, **_line(curve))
        for ends, filled in ((1, True), (2, False)):
            at = np.array([contact[ends] for contact in curve.touching])
            inside = (at > curve.at[0]) & (at < curve.at[-1])
            ax.scatter(
                at[inside],
                _at_event(curve, values, at[inside], behind=filled),
                s=12,
                facecolor=curve.look.colour if filled else "white",
                edgecolor=curve.look.colour,
                linewidth=0.8,
                zorder=4,
            )
        if panel.variable == "transmitted_force":
            ax.plot(curve.at, panel.factor * curve.values["applied_force"], zorder=2, **_APPLIED)
        if panel.variable == "acceleration":
            ax.scatter(
                curve.peaks[0],
                in_unit(panel.factor) * curve.peaks[1],
                s=42,
                marker="*",
                color=curve.look.colour,
                zorder=5,
            )
    if panel.variable == "displacement":
        gap_lines(ax, curves, horizontal=True)
    ax.set_ylabel(panel.label)


def gap_entry(stops: int) -> Line2D:
    """Return the legend entry of the lines at the gaps of one or two stops."""
    label = "gaps" if stops > 1 else "gap"
    return Line2D([], [], color="black", linestyle="--", linewidth=0.8, label=label)


def history_legend(curves: list[DrawnMotion]) -> list[Artist]:
    """Return the legend handles of the curves, gaps, bands and marks that are drawn.

    An impact on a rigid stop has a star, but no band: it takes no time.
    """
    entries: list[Artist] = [Line2D([], [], label=c.look.label, **_line(c)) for c in curves]
    present = [name for name in SIDES if any(name in c.gaps for c in curves)]
    if present:
        entries.append(gap_entry(len(present)))
    touched = {name for c in curves for name, _, _ in c.touching}
    entries += [
        _band(curves[0], name, len(curves)).entry(f"{name} contact")
        for name in present
        if name in touched
    ]
    colour = curves[0].look.colour
    marks = []
    if touched:
        marks = [("contact begins", "o", colour), ("contact ends", "o", "white")]
    if any(len(c.peaks[0]) for c in curves):
        marks.append(("peak in contact" if touched else "impact", "*", colour))
    entries += [
        Line2D(
            [],
            [],
            linestyle="",
            marker=marker,
            markersize=6 if marker == "*" else 3.5,
            markeredgecolor=colour,
            markerfacecolor=face,
            label=label,
        )
        for label, marker, face in marks
    ]
    return entries


def _line(curve: DrawnMotion) -> dict[str, Any]:
    return curve.look._replace(width=1.1).line


def _band(curve: DrawnMotion, side: str, motions: int) -> Band:
    band = BANDS[SIDES.index(side)]
    colour = (curve.look.colour, 0.15) if motions > 1 else band.colour
    # The edge shows a grazing contact, too.
    return band._replace(colour=colour, edge=EDGE, width=0.3)


def _at_event(curve: DrawnMotion, values: Any, at: Any, *, behind: bool) -> Any:
    """Return the value at an event. If it jumps, return the value within the contact."""
    # The last two points at the time of an event are those before it and behind it. A sample at the
    # same time precedes them.
    index = np.searchsorted(curve.at, at, side="right")
    return values[index - (1 if behind else 2)]
