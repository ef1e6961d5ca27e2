"""Branches of periodic orbits: stable parts solid, unstable parts dashed, bifurcations marked."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from vibroimpact.datasets.description import motion_parameters, own_outputs
from vibroimpact.datasets.stops import of_stop, quantities
from vibroimpact.datasets.stops import quantity as of_quantity
from vibroimpact.errors import InputError
from vibroimpact.facts.number_format import shown_in
from vibroimpact.figures.assembly_motion import refuse_masses
from vibroimpact.figures.axis_labels import axis_label
from vibroimpact.figures.finish import finished
from vibroimpact.figures.labels import Names
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.resonance_panels import draws_eta
from vibroimpact.figures.style import CurveStyle, sweeps_of
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.written_units import unitless
from vibroimpact.response.resonance import runs
from vibroimpact.stability.branch_styles import QUANTITIES, contact_counts

_Array = NDArray[np.float64]

_NORMALISED = {"eta_d": "displacement_excursion", "eta_a": "acceleration_excursion"}


_MARKS = 60
"""Approximate number of marks on a sweep."""


_DOUBLING, _TORUS = (0, (3, 1.5)), (0, (5, 1.5, 1, 1.5))
MARKS = {
    "fold": CurveStyle("fold", "#c05a00", "-", 1.4, "o", 5.0, True),
    "symmetry breaking": CurveStyle(
        "symmetry breaking", "#7a3e9d", (0, (6, 2)), 1.4, "s", 5.0, True
    ),
    "period doubling": CurveStyle("period doubling", "#00795c", _DOUBLING, 1.4, "^", 5.0, True),
    "Neimark-Sacker": CurveStyle("Neimark–Sacker", "#b0006d", _TORUS, 1.4, "D", 5.0, True),
    "branching": CurveStyle("branching", "#1f4fbf", "-", 1.4, "X", 5.0, True),
    # A ring around what it falls on: a fold or a period doubling is often a hair away.
    "grazing": CurveStyle("grazing", "black", (0, (1, 1.2)), 1.4, "o", 9.0, False),
}
"""Marks of bifurcations on a branch, and lines of their curves."""


@finished
def branch_diagram(
    data: xr.Dataset,
    ax: Axes | None = None,
    *,
    quantity: str | None = None,
    sweep: xr.Dataset | None = None,
    title: str | None = None,
) -> Axes:
    """Draw branches of periodic orbits over their parameter.

    Stable parts are solid, and unstable parts are dashed. Long parts have a label with the impacts
    per period. For example, 2R 1L means two impacts on the right stop and one impact on the left
    stop. A side without a stop is left out.

    Parameters
    ----------
    data
        Dataset of `branch` or `resonance_diagram`.
    ax
        Axes to draw on. Default: a new figure.
    quantity
        Quantity on the vertical axis: ``"eta_d"``, ``"eta_a"``, ``"displacement_excursion"``,
        ``"eccentricity"``, ``"peak_displacement"``, ``"peak_acceleration"``,
        ``"peak_transmitted_force"``, ``"transmissibility"``, ``"peak_force"`` (of all stops),
        ``"peak_force.right"`` or ``"peak_force.left"``; or the name of an own output. Default:
        ``"eta_d"`` for a published case, and ``"peak_displacement"`` for study files and other
        rigs; also if the motion without stops is unbounded, so that η has no meaning.
    sweep
        Dataset of `sweep` over the same frequencies, which is drawn as marks. Default: no sweep.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset holds no branch, or if the quantity is unknown. Also if a sweep is passed
        although the parameter is not the frequency.
    """
    if "parameter" not in data.attrs or "branch" not in data:
        wrong = "not a branch;"
        if "start" in data.dims:
            wrong = "a bifurcation diagram; draw it with figures.section_diagram, or"
        raise InputError(f"data: this is {wrong} pass the result of branch or resonance_diagram")
    refuse_masses(data, "mass_branches")
    if quantity is None:
        quantity = "eta_d" if draws_eta(data) else "peak_displacement"
    held = quantities(data)
    known = [one for one in (*QUANTITIES, *own_outputs(data)) if one in held]
    if quantity not in known:
        raise InputError(f"quantity: {quantity!r}; pass one of {', '.join(known)}")
    name = data.attrs["parameter"]
    if sweep is not None and name != "frequency":
        raise InputError(
            f"sweep: the branches are along {name!r}, not along 'frequency'; pass branches along "
            "'frequency', or leave sweep out"
        )
    if sweep is not None and "direction" not in sweep.coords:
        raise InputError("sweep: this is not a sweep; pass the result of the function sweep")
    if sweep is not None and quantity not in quantities(sweep):
        raise InputError(
            f"sweep: it has no output {quantity!r}; pass the same outputs to the function sweep"
        )
    values = of_quantity(data, quantity)
    factor, label = axis_label(values, quantity)
    ax = axes_or_new(ax, (7.2, 4.6), title)
    scale, unit = axis_unit(data[name])
    x, y = scale * data[name].values, factor * values.values
    styles = {True: orbit_style(True, 1.4), False: orbit_style(False, 0.9)}
    pieces = stable_pieces(data)
    for part, stable in pieces:
        ax.plot(x[part], y[part], **styles[stable])
    handles: list[Any] = [
        Line2D([], [], label=f"{label} orbits", **styles[stable])
        for stable, label in ((True, "stable"), (False, "unstable"))
        if any(one == stable for _, one in pieces)
    ]
    marked = factor * of_quantity(data, f"bifurcation_{quantity}").values
    marks = mark_bifurcations(ax, data, scale, marked)
    handles += marks
    if sweep is not None:
        source, of_eta = quantity, 1.0
        if quantity in _NORMALISED:  # by the largest peak, as the branches
            source = _NORMALISED[quantity]
            of_eta = float((data[quantity] / data[source])[0])
        swept = of_eta * factor * of_quantity(sweep, source)
        handles += mark_sweep(ax, swept, scale, 0.8, _MARKS)
    ax.set_xlim(x.min(), x.max())
    ax.set_xlabel(f"{data[name].attrs['long_name']} ({unit})")
    ax.set_ylabel(label)
    add_legend(ax, handles)
    names = Names(ax, marks)
    for part, name in _orbits(data):
        names.write(x[part], y[part], name, "black", once=True)
    return ax


def _orbits(data: xr.Dataset) -> list[tuple[slice, str]]:
    """Return runs of points of a branch with the same impacts on each side, and labels."""
    branch, period = data["branch"].values, data["period"].values
    hits = [np.rint(of_stop(data, "impacts", side).values * period).astype(int) for side in SIDES]
    oscillator = motion_parameters(data)["oscillator"]
    stops = oscillator["right"], oscillator["left"]
    runs = []
    changes = np.any([np.diff(part) != 0 for part in (branch, period, *hits)], axis=0)
    ends = [0, *(np.flatnonzero(changes) + 1), len(branch)]
    for first, last in itertools.pairwise(ends):
        right, left, cycles = (int(part[first]) for part in (*hits, period))
        name = contact_counts(right, left, stops) if right or left else "no contact"
        runs.append((slice(first, last), f"{name}, period {cycles}" if cycles > 1 else name))
    return runs


def axis_unit(values: xr.DataArray) -> tuple[float, str]:
    """Return factor and unit of the axis of a parameter, those of tables, but mm for any length."""
    units = str(values.attrs["units"])
    if unitless():
        return 1.0, "–"
    if units == "m":  # as on the axes of displacements
        return 1e3, "mm"
    scale = shown_in(units, values.values.ravel())
    return 1.0 / scale.size, scale.symbol or "–"


def stable_pieces(data: xr.Dataset) -> list[tuple[slice, bool]]:
    """Return runs of points of a branch that are all stable, or all unstable."""
    branch, stable = data["branch"].values, data["stable"].values
    first, second = stable[:-1], stable[1:]
    # At a bifurcation itself (-1) the other end of the segment decides.
    solid = np.where(first < 0, second, np.where(second < 0, first, first * second)) == 1
    return parts_of_curve(solid, branch[:-1] == branch[1:])


def parts_of_curve(
    solid: NDArray[np.bool_], within: NDArray[np.bool_] | bool = True
) -> list[tuple[slice, bool]]:
    """Return the parts of a curve whose segments are all solid, or all not, in order.

    The segment [i] is that from point i to point i + 1. One that is not `within` is in no part.
    """
    parts = [
        (slice(first, last + 2), kind)
        for kind in (True, False)
        for first, last in runs((solid == kind) & within)
    ]
    return sorted(parts, key=lambda part: part[0].start)


def orbit_style(stable: bool, width: float, colour: str = "black") -> dict[str, Any]:
    """Return the keywords of `Axes.plot` for a piece of a branch: dashed where it is unstable."""
    style = {"color": colour, "linewidth": width, "zorder": 2.5 if stable else 2}
    # Or the dashes of two mirror images fill each other's gaps.
    return style if stable else {**style, "linestyle": (0, (4, 2)), "gapcolor": "white"}


def mark_bifurcations(ax: Axes, data: xr.Dataset, scale: float, values: _Array) -> list[Line2D]:
    """Mark the bifurcations of branches, and return one line of marks for each kind."""
    kinds, x = data["bifurcation_kind"].values, scale * data["bifurcation_value"].values
    return [
        ax.plot(x[mine], values[mine], label=mark.label, zorder=4, **mark.marks())[0]
        for kind, mark in MARKS.items()
        if (mine := kinds == kind).any()
    ]


def mark_sweep(
    ax: Axes, values: xr.DataArray, scale: float, share: float, marks: int
) -> list[Line2D]:
    """Mark the motions of a sweep, and return one line of marks for each direction."""
    # Of a dense sweep not every hold: the lines below must be seen.
    every = max(1, values.sizes["frequency"] // marks)
    x = scale * values["frequency"].values
    return [
        ax.plot(
            x,
            values.sel(direction=direction).values,
            label=look.label,
            markevery=every,
            zorder=3,
            **look.marks(share),
        )[0]
        for direction, look in sweeps_of(values)
    ]
