"""Bifurcation diagrams by simulation: sections, periods and the largest Lyapunov exponent."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter, NullLocator
from numpy.typing import NDArray

from vibroimpact.arguments import check_name
from vibroimpact.datasets.description import own_outputs
from vibroimpact.errors import InputError, shown
from vibroimpact.figures.assembly_motion import chosen
from vibroimpact.figures.axis_labels import axis_label
from vibroimpact.figures.branches import MARKS, axis_unit, orbit_style, stable_pieces
from vibroimpact.figures.finish import finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.style import SWEEPS, CurveStyle, fit_x_axis, panels
from vibroimpact.model.names import literal

_Array = NDArray[np.float64]

_LABELS = {
    "section_displacement": (1e3, "displacement\nat the section (mm)"),
    "section_velocity": (1e3, "velocity\nat the section (mm/s)"),
    "contact_start_phase": (1.0, "phase of the forcing\nat impacts (rad)"),
    "contact_start_velocity": (1e3, "velocity\nat impacts (mm/s)"),
}
"""Factor and label of each quantity."""

_WAYS = {
    "up": SWEEPS["forward"]._replace(label="up"),
    "down": SWEEPS["backward"]._replace(label="down"),
}
_ELSE = CurveStyle("from other initial states", "0.35", "-.", 0.8, "x", 4.0, True)

_HEIGHTS = (3.2, 1.0, 1.4)
_OF_AN_OUTPUT = 1.4
_OF_A_MASS = 2.2
_NO_PERIOD = ("chaotic", "quasi-periodic", "undecided")
"""Types of motions that have their own row on the axis of periods, below the period 1."""


@finished
def section_diagram(
    data: xr.Dataset,
    axes: Any = None,
    *,
    quantity: str | None = None,
    names: Sequence[str] | None = None,
    branches: xr.Dataset | None = None,
    title: str | None = None,
) -> Panels:
    """Draw a bifurcation diagram: section, period and largest Lyapunov exponent over a parameter.

    Own outputs have further panels below the section. Of an assembly, each mass has a panel of its
    section.

    Parameters
    ----------
    data
        Dataset of `bifurcation_diagram`.
    axes
        Three Axes to draw on, from top to bottom, and one for each own output and each further
        mass. Default: a new figure.
    quantity
        Quantity of the section. For a stroboscopic section: ``"section_displacement"`` or
        ``"section_velocity"``. For a section at impacts: ``"contact_start_velocity"`` or
        ``"contact_start_phase"``. Default: the first of the two.
    names
        Names of the masses of an assembly that are drawn. Default: all.
    branches
        Dataset of `branch` or `resonance_diagram` over the same parameter. Its bifurcations are
        vertical lines. In a stroboscopic section, the orbits are thin lines, dashed where they are
        unstable, with marks at the bifurcations: one point of an orbit of several cycles, and
        none of an orbit whose state is at another phase. Default: no branches.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset is not a bifurcation diagram, or if it does not contain the quantity. Also if
        the branches were computed over another parameter.
    """
    held = [name for name in _LABELS if name in data]
    if "start" not in data.dims or not held:
        another = (
            "a dataset of branches; draw it with figures.branch_diagram, or"
            if "branch" in data
            else "not a bifurcation diagram;"
        )
        raise InputError(f"data: this is {another} pass the result of bifurcation_diagram")
    if quantity is None:
        quantity = "contact_start_velocity" if "contact_stop" in data else held[0]
    check_name(quantity, held, "quantity")
    name = data.attrs["parameter"]
    if branches is not None and branches.attrs.get("parameter") != name:
        raise InputError(
            f"branches: their parameter is {branches.attrs.get('parameter')!r}, but that of data "
            f"is {name!r}; pass branches along {name!r}"
        )
    own = own_outputs(data)
    sections = _sections(data[quantity], names)
    what = " and ".join([", ".join([*sections, *own, "periods"]), "exponents"])
    first, *others = _HEIGHTS
    each = first if len(sections) == 1 else _OF_A_MASS
    heights = (*[each] * len(sections), *[_OF_AN_OUTPUT] * len(own), *others)
    size = (7.2, 1.15 * sum(heights))
    drawn = panels(axes, len(heights), what, size, title, heights)
    *upper, middle, bottom = drawn
    tops, between = upper[: len(sections)], upper[len(sections) :]
    scale, unit = axis_unit(data[name])
    x = scale * data[name].values
    factor, label = _LABELS[quantity]
    factor = in_unit(factor)
    # What is drawn last must leave the dots below it seen: those that go up come last.
    rows = _rows(data["motion"].values, data["period"].values)
    for start in reversed(data["start"].values):
        one, look = data.sel(start=start), _WAYS.get(str(start), _ELSE)
        for ax, section in zip(tops, sections.values(), strict=True):
            _points(ax, x, factor * section.sel(start=start).values, look)
        levels = [
            rows.get(str(motion), float(period))
            for motion, period in zip(one["motion"].values, one["period"].values, strict=True)
        ]
        for ax, output in zip(between, own, strict=True):
            _line(ax, x, axis_label(data[output], output)[0] * one[output].values, look)
        _line(middle, x, np.array(levels), look)
        _line(bottom, x, one["exponents"].values[:, 0], look, dots=False)
    spacing = np.diff(x)
    for ax in drawn:
        if len(x) > 2 and not np.allclose(spacing, spacing[0], rtol=1e-6):
            ax.set_xscale("log")
        fit_x_axis(ax, x)
    ways = dict.fromkeys(_WAYS.get(str(start), _ELSE) for start in data["start"].values)
    handles = [Line2D([], [], label=one.label, **one.marks() | _thin(one)) for one in ways]
    if branches is not None:
        places, phase = _places(branches, quantity, list(sections)), _phase(data)
        if places is not None:
            handles += _orbits(tops, branches, places, phase, scale, factor)
        handles += _lines(drawn, tops, branches, places, phase, scale, factor)
    add_legend(tops[0], handles)
    for ax, mass in zip(tops, sections, strict=True):
        ax.set_ylabel(label if len(sections) == 1 else f"{literal(mass)}: {label}")
    for ax, output in zip(between, own, strict=True):
        ax.set_ylabel(axis_label(data[output], output)[1])
    _periods(middle, data["period"].values, rows)
    bottom.axhline(0.0, color="0.3", linewidth=0.7, zorder=1)
    bottom.set_ylabel("largest\nexponent (1/s)")
    bottom.set_xlabel(f"{data[name].attrs['long_name']} ({unit})")
    bottom.figure.align_ylabels()
    return drawn


def _sections(values: xr.DataArray, names: Sequence[str] | None) -> dict[str, xr.DataArray]:
    """Return the values of each panel by its name: those of the section, or of each mass."""
    if "mass" not in values.dims:
        if names is not None:
            raise InputError(f"names: {shown(names)}, but the points are not by mass; remove names")
        return {"section": values}
    every = tuple(values["mass"].values.tolist())
    return {name: values.sel(mass=name) for name in chosen(names, every, "mass", "names")}


def _points(ax: Axes, x: _Array, points: _Array, look: CurveStyle) -> None:
    """Draw the points of a periodic motion as marks, and the points of another motion as dots."""
    count = np.isfinite(points).sum(axis=1)
    for few in (True, False):
        rows = (count <= _FEW) == few
        at = np.broadcast_to(x[rows, np.newaxis], points[rows].shape)
        ax.plot(
            at.ravel(),
            points[rows].ravel(),
            markeredgewidth=0.4,
            rasterized=not few,
            zorder=3 if few else 2,
            **look.marks(0.45) | ({} if few else {"marker": ".", "markersize": 0.5}),
        )


_FEW = 16
"""Largest number of points that are drawn as marks."""


def _line(ax: Axes, x: _Array, y: _Array, look: CurveStyle, dots: bool = True) -> None:
    style = look.marks(0.5) | {"markeredgewidth": 0.5} if dots else _thin(look)
    ax.plot(x, y, **style)


def _thin(look: CurveStyle) -> dict[str, Any]:
    return look.line | {"linewidth": 0.8 * look.width}


def _rows(motions: NDArray[np.str_], periods: NDArray[np.int64]) -> dict[str, float]:
    """Return the positions of motions without a period on the axis of periods."""
    held = [motion for motion in _NO_PERIOD if (motions == motion).any()]
    most = max(int(periods.max()), 2)
    powers = _powers(most, len(held))
    # As far apart as the other ticks, and as their names are high on an axis of many doublings.
    step = max(float(np.log2(powers[1] / powers[0])), 0.25 * np.log2(most))
    return {motion: float(2.0 ** (-step * (k + 1))) for k, motion in enumerate(held)}


def _powers(most: int, rows: int) -> list[int]:
    """Return the periods with a tick on an axis up to a period, which also has some rows."""
    powers = [2**k for k in range(most.bit_length())]
    return powers if len(powers) + rows <= 5 else powers[::2]


def _periods(ax: Axes, periods: NDArray[np.int64], rows: dict[str, float]) -> None:
    """Set an axis of periods on which a doubling is one step, and the rows below it."""
    ax.set_yscale("log", base=2)
    most = max(int(periods.max()), 2)
    chosen = _powers(most, len(rows))
    ticks = [*reversed(rows.values()), *map(float, chosen)]
    labels = [*reversed(rows), *(f"{power:g}" for power in chosen)]
    ax.set_yticks(ticks, labels)
    ax.yaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.set_ylim(0.7 * ticks[0], 1.5 * most)
    ax.set_ylabel("period\n(cycles)")


def _places(branches: xr.Dataset, quantity: str, masses: Sequence[str]) -> list[str] | None:
    """Return the components of the orbits' states that the panels show; None at impacts."""
    part = quantity.removeprefix("section_")
    components = set(branches["component"].values.tolist())
    places = [part] if part in components else [f"{part}.{mass}" for mass in masses]
    return places if components.issuperset(places) else None


def _at_section(states: xr.DataArray, place: str, phase: float) -> _Array:
    """Return a component of states; NaN for those at another phase of the forcing."""
    same = np.isclose(states.sel(component="phase").values, phase, rtol=0.0, atol=1e-9)
    return np.where(same, states.sel(component=place).values, np.nan)


def _phase(data: xr.Dataset) -> float:
    """Return the phase of the section of a diagram (rad)."""
    return float(np.nanmedian(data["section"].sel(component="phase").values))


def _orbits(
    tops: Sequence[Axes],
    branches: xr.Dataset,
    places: Sequence[str],
    phase: float,
    scale: float,
    factor: float,
) -> list[Line2D]:
    """Draw the section of each orbit: thin lines, dashed where the orbits are unstable."""
    x = scale * branches[branches.attrs["parameter"]].values
    pieces = stable_pieces(branches)
    styles = {stable: orbit_style(stable, 0.7, "0.25") for stable in (True, False)}
    drawn = set()
    for ax, place in zip(tops, places, strict=True):
        y = factor * _at_section(branches["section"], place, phase)
        for part, stable in pieces:
            if np.isfinite(y[part]).any():
                drawn.add(stable)
                ax.plot(x[part], y[part], **styles[stable] | {"zorder": 1.5})
    words = {True: "stable branch", False: "unstable branch"}
    return [Line2D([], [], label=words[one], **styles[one]) for one in words if one in drawn]


def _lines(
    drawn: Panels,
    tops: Sequence[Axes],
    branches: xr.Dataset,
    places: Sequence[str] | None,
    phase: float,
    scale: float,
    factor: float,
) -> list[Line2D]:
    """Draw a line through all panels for each bifurcation, and its mark where its orbit is."""
    handles = []
    kinds = branches["bifurcation_kind"].values
    low, high = drawn[0].get_xlim()
    values = scale * branches["bifurcation_value"].values
    inside = (values >= low) & (values <= high)
    for kind, mark in MARKS.items():
        mine = inside & (kinds == kind)
        if not mine.any():
            continue
        for ax in drawn:
            for value in values[mine]:
                ax.axvline(value, color=mark.colour, linestyle=":", linewidth=0.8, zorder=1)
        style = mark.marks()
        if places is None:
            style["marker"] = ""
        for ax, place in zip(tops, places or (), strict=False):
            y = factor * _at_section(branches["bifurcation_section"], place, phase)
            ax.plot(values[mine], y[mine], zorder=5, **style)
        label = mark.label + ("" if places is not None else " of a branch")
        dotted = {"linestyle": ":", "linewidth": 0.8}
        handles.append(Line2D([], [], label=label, **style | dotted))
    return handles
