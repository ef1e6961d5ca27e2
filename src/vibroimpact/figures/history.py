"""Time histories with the intervals of contact, as in the paper's Figs. 8 and 16."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.figures.style import EDGE, LEGEND, panels

_Array = NDArray[np.float64]


class _Panel(NamedTuple):
    """What one panel shows: the samples, the values at events, and a factor to its unit."""

    samples: str
    before: str
    behind: str
    factor: float
    label: str


_PANELS = (
    _Panel(
        "displacement",
        "event_displacement",
        "event_displacement",
        1e3,
        "relative\ndisplacement $u$ (mm)",
    ),
    _Panel(
        "acceleration",
        "event_acceleration_before",
        "event_acceleration_behind",
        1.0,
        "absolute acceleration\n$\\ddot u + A_t$ (m/s²)",
    ),
    _Panel(
        "velocity",
        "event_velocity",
        "event_velocity",
        1.0,
        "relative\nvelocity $\\dot u$ (m/s)",
    ),
)
_BANDS = {1: ("right", "#f7dc8b", ""), -1: ("left", "#b9dcec", r"\\")}


def time_history(
    data: xr.Dataset, axes: Any = None, *, cycles: float = 3.0, title: str | None = None
) -> tuple[Axes, Axes, Axes]:
    """Draw displacement, absolute acceleration and relative velocity against t/T.

    Contacts are bands between their exact times (the left bumper's hatched), the gaps are
    dashed lines. The curves pass through the exact values at each event, on both sides of it
    where the acceleration jumps.

    Parameters
    ----------
    data
        Dataset of `vibroimpact.simulate`, with samples.
    axes
        Three Axes. None makes a new figure.
    cycles
        How many forcing cycles are shown, the last ones.
    title
        Title of a new figure.

    Returns
    -------
    tuple of Axes
        For displacement, acceleration and velocity; ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset is not that of a simulation with samples, or there are not three axes.
    """
    if "cycle" not in data.coords or "event_cycle" not in data or not data.sizes["time"]:
        raise InputError(
            f"data: a dataset with the dims {dict(data.sizes)} has no time history; "
            "a dataset of simulate with samples is accepted"
        )
    if not cycles > 0.0:
        raise InputError(f"cycles: {cycles!r}; a number greater than 0 is accepted")
    parameters = json.loads(data.attrs["parameters"])
    at = data["cycle"].values
    events = data["event_cycle"].values + data["event_cycle_time"].values * parameters["frequency"]
    last = float(at[-1])
    first = max(float(at[0]), last - cycles)
    bands = _contacts(data, events)

    given = panels(axes, 3, "displacement, acceleration and velocity", (7.2, 7.6), title)
    for ax, panel in zip(given, _PANELS, strict=True):
        ax.set_xlim(first, last)
        for side, (name, colour, hatch) in _BANDS.items():
            shown = [(a, b - a) for s, a, b in bands if s == side and b >= first]
            ax.broken_barh(
                shown,
                (0.0, 1.0),
                transform=ax.get_xaxis_transform(),
                facecolor=colour,
                edgecolor=EDGE,
                hatch=hatch,
                linewidth=0.3,  # so that a grazing contact is seen, too
                label=f"{name} contact",
                zorder=0,
            )
        x, y = _with_events(
            at,
            data[panel.samples].values,
            events,
            data[panel.before].values,
            data[panel.behind].values,
        )
        inside = x >= first
        ax.plot(x[inside], panel.factor * y[inside], color="black", linewidth=1.1, zorder=3)
        ax.axhline(0.0, color=EDGE, linewidth=0.6, zorder=1)
        ax.set_ylabel(panel.label)
    for sign, (name, _, _) in _BANDS.items():
        bumper = parameters["oscillator"][name]
        if bumper is not None:
            given[0].axhline(
                1e3 * sign * bumper["gap"], color="black", linestyle="--", linewidth=0.8, zorder=2
            )
    given[2].set_xlabel("time in forcing cycles $t/T$ (–)")
    given[0].legend(handles=_legend(parameters["oscillator"]), ncols=4, **LEGEND)
    return given[0], given[1], given[2]


def _contacts(data: xr.Dataset, events: _Array) -> list[tuple[int, float, float]]:
    """Side, begin and end of each contact, in forcing cycles."""
    at = data["cycle"].values
    begins: dict[int, float] = {}
    if side := int(data["contact"].values[0]):
        begins[side] = float(at[0])
    found = []
    kinds, sides = data["event_contact"].values, data["event_side"].values
    for time, begin, side in zip(events, kinds, sides, strict=True):
        if begin:
            begins[int(side)] = float(time)
        elif side in begins:
            found.append((int(side), begins.pop(int(side)), float(time)))
    return found + [(side, begin, float(at[-1])) for side, begin in begins.items()]


def _with_events(
    at: _Array, samples: _Array, events: _Array, before: _Array, behind: _Array
) -> tuple[_Array, _Array]:
    """Merge the values on both sides of each event into the samples, in the order of time."""
    x = np.concatenate([at, events, events])
    order = np.argsort(x, kind="stable")
    return x[order], np.concatenate([samples, before, behind])[order]


def _legend(oscillator: dict[str, Any]) -> list[Artist]:
    entries: list[Artist] = [Line2D([], [], color="black", linewidth=1.1, label="motion")]
    present = [(n, c, h) for n, c, h in _BANDS.values() if oscillator[n] is not None]
    if present:
        entries.append(Line2D([], [], color="black", linestyle="--", linewidth=0.8, label="gaps"))
    return entries + [
        Patch(facecolor=c, edgecolor=EDGE, lw=0.3, hatch=h, label=f"{n} contact")
        for n, c, h in present
    ]
