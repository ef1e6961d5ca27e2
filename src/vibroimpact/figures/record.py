"""A motion through a record over time, with the record above it."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from vibroimpact.datasets.description import motion_parameters
from vibroimpact.errors import InputError
from vibroimpact.figures.assembly_motion import contact_spans
from vibroimpact.figures.finish import finished, in_unit
from vibroimpact.figures.history import PANELS, gap_entry
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.style import BANDS, EDGE, also_in_g, panels
from vibroimpact.model.oscillator import SIDES

_ROWS = (
    ("base_acceleration", 1.0, "base acceleration\n$A_t$ (m/s²)"),
    *PANELS,
)
_SIDES = {"right": 1, "left": -1}


@finished
def record_history(motion: xr.Dataset, axes: Any = None, *, title: str | None = None) -> Panels:
    """Draw the motion of a rig through a record over time, with the record above it.

    Each contact is a band between its exact start and end times. The band is hatched for the left
    stop. Dots are impacts on rigid stops. Dashed lines are the gaps.

    Parameters
    ----------
    motion
        Dataset of `simulate` through a `Record`, with samples.
    axes
        Four Axes. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    tuple of Axes
        The Axes of the base acceleration, and of the displacement, the absolute acceleration and
        the velocity of the mass. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset does not hold a motion through a record, or if there are not four axes.
    """
    stops = stops_of(motion)
    names = "base acceleration, displacement, acceleration and velocity"
    panel_axes = panels(axes, 4, names, (7.2, 8.6), title)
    time = motion["time"].values
    for ax, (variable, factor, label) in zip(panel_axes, _ROWS, strict=True):
        ax.axhline(0.0, color=EDGE, linewidth=0.6, zorder=1)
        ax.plot(
            time, in_unit(factor) * motion[variable].values, color="black", linewidth=0.9, zorder=3
        )
        ax.set_ylabel(label)
        ax.set_xlim(time[0], time[-1])
        if variable != "base_acceleration":
            contact_bands(ax, motion)
        if "acceleration" in variable:
            also_in_g(ax)
    gap_lines(panel_axes[1], stops)
    hit = motion["event_contact"].values == 2
    panel_axes[1].scatter(
        motion["event_time"].values[hit],
        in_unit(1e3) * motion["event_displacement"].values[hit],
        s=10,
        color="black",
        zorder=4,
    )
    panel_axes[3].set_xlabel("time (s)")
    handles = stops_legend(stops, motion)
    if hit.any():
        handles.append(impact_entry())
    handles += mark_end(panel_axes, motion)
    if handles:
        add_legend(panel_axes[1], handles)
    return panel_axes


def stops_of(motion: xr.Dataset) -> dict[str, dict[str, Any]]:
    """Return the stops of a motion through a record, by side.

    Raises
    ------
    InputError
        If the dataset does not hold a motion through a record.
    """
    parameters = json.loads(getattr(motion, "attrs", {}).get("parameters", "{}"))
    if "record" not in parameters or "displacement" not in motion:
        raise InputError(
            "motion: this is not the response to a record; pass the result of simulate with a "
            "Record and samples, or use time_history, which draws other motions"
        )
    oscillator = parameters["oscillator"]
    return {side: oscillator[side] for side in _SIDES if oscillator.get(side)}


def gap_lines(ax: Axes, stops: dict[str, dict[str, Any]]) -> None:
    """Draw lines at the positions of the stops, for a displacement in mm."""
    for side, stop in stops.items():
        gap = in_unit(1e3) * _SIDES[side] * stop["gap"]
        ax.axhline(gap, color="black", linestyle="--", linewidth=0.8, zorder=2)


def stops_legend(stops: dict[str, dict[str, Any]], motion: xr.Dataset) -> list[Any]:
    """Return legend entries of the gap lines, and of the contact bands of touched stops."""
    handles: list[Any] = [gap_entry(len(stops))] if stops else []
    touched = [side for side in stops if _spans(motion, side)]
    handles += [BANDS[SIDES.index(side)].entry(f"{side} contact") for side in touched]
    return handles


def impact_entry() -> Line2D:
    """Return the legend entry of the dots of impacts on rigid stops."""
    return Line2D([], [], linestyle="", marker="o", markersize=3, color="black", label="impact")


_END: dict[str, Any] = {"color": "0.35", "linestyle": ":", "linewidth": 1.0}


def mark_end(axes: Iterable[Axes], motion: xr.Dataset) -> list[Any]:
    """Draw a line at the end of the record, if the motion goes on, and return its legend entry."""
    parameters = motion_parameters(motion)
    if not parameters.get("tail") or "record" not in parameters:
        return []
    record = parameters["record"]
    end = (record["samples"] - 1) * record["step"]
    for ax in axes:
        ax.axvline(end, zorder=1.5, **_END)
    return [Line2D([], [], label="end of the record", **_END)]


def contact_bands(ax: Axes, motion: xr.Dataset) -> None:
    """Draw bands where the mass touches a stop."""
    for side in _SIDES:
        BANDS[SIDES.index(side)].draw(ax, _spans(motion, side))


def _spans(motion: xr.Dataset, stop: str) -> list[tuple[float, float]]:
    time = motion["time"].values
    return contact_spans(motion, stop, motion["event_time"].values, (time[0], time[-1]))
