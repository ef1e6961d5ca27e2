"""Design charts: displacement and acceleration over parameters."""

from __future__ import annotations

import math
import textwrap
from typing import Any

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from vibroimpact.datasets.description import motion_parameters, system_from
from vibroimpact.datasets.stops import over_parts
from vibroimpact.design.design_shaking import fractile_of
from vibroimpact.design.limits import excesses
from vibroimpact.errors import InputError
from vibroimpact.figures.finish import finished, in_unit, without_unit
from vibroimpact.figures.interpolation import finer, finer_axis, nearest
from vibroimpact.figures.legends import add_legend, apply_layout, fit_labels
from vibroimpact.figures.levels import number_lines
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.plane import scale_axis
from vibroimpact.figures.style import CurveStyle, panels
from vibroimpact.model import GRAVITY, Rig
from vibroimpact.model.parameters import PARAMETERS, in_units, parameter, usual
from vibroimpact.model.quantities import DIMENSIONLESS, LENGTH, Quantity
from vibroimpact.model.written_units import unitless

_Array = NDArray[np.float64]

QUANTITIES = {
    "peak_displacement": (1e3, "largest displacement $|u|$ (mm)"),
    "peak_acceleration": (1.0 / GRAVITY, "largest absolute acceleration $|\\ddot u + A_t|$ (g)"),
    "peak_force": (1e-3, "largest contact force (kN)"),
}
_EDGE = CurveStyle("", "#c8102e", "--", 2.0, "", 0.0, False)
PRESENT: dict[str, Any] = {
    "linestyle": "",
    "marker": "*",
    "markersize": 10.0,
    "color": "#c05a00",
    "markeredgecolor": "white",
    "markeredgewidth": 0.6,
}
"""Keywords of the mark of the present design."""
_LEVELS = 9
_MARGIN = 0.03
"""Room beside the first and the last design of a chart over one parameter."""


@finished
def design_chart(
    data: xr.Dataset,
    axes: Any = None,
    *,
    quantities: tuple[str, ...] = ("peak_displacement", "peak_acceleration"),
    title: str | None = None,
) -> Panels:
    """Draw the responses of designs over one parameter, or as contours over two parameters.

    Contour lines have labels with their values where there is enough room. Dots mark Pareto-optimal
    designs. A thick dashed line connects the designs that just have no contact, next to designs
    with contact. The required gap is slightly smaller than along this line; see `required_gap`.

    A star, or a vertical line in a chart over one parameter, marks the present design, which is the
    rig with its own values, if it lies within the chart.

    In hatched areas a limit is exceeded. The edges of these areas are interpolated between the
    designs, on the scales of the axes, like the contour lines. Next to a design without finite
    values, the edge lies half-way to this design. If the dataset does not contain the limits, all
    edges lie half-way between designs.

    Parameters
    ----------
    data
        Dataset of `design_chart` over one or two parameters, with at least two values of each.
    axes
        Axes to draw on, one per quantity. Default: a new figure.
    quantities
        Drawn quantities: ``"peak_displacement"``, ``"peak_acceleration"`` or ``"peak_force"``.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If ``data`` is not a dataset of `design_chart` with one or two varied parameters.
    """
    dims = parameters_of(data)
    for name in quantities:
        if name not in QUANTITIES:
            raise InputError(f"quantities: {name!r}; pass one or more of {', '.join(QUANTITIES)}")
    if len(dims) > 2 or min(data.sizes[dim] for dim in dims) < 2:
        raise InputError(
            f"data: its dimensions are {dict(data.sizes)}, but the chart requires one or two, with "
            "at least two values each; select fewer dimensions with data.isel, or add values"
        )
    count = len(quantities)
    drawn = panels(axes, count, "one per quantity", (4.9 * count, 4.6), title, beside=True)
    if len(dims) == 1:
        for ax, name in zip(drawn, quantities, strict=True):
            _curve(ax, data, name)
        if axes is None and count > 1:  # the panels have the same key
            handles = drawn[0].get_legend_handles_labels()[0]
            add_legend(drawn[0].get_figure(root=True), handles)  # type: ignore[arg-type]
        else:
            for ax in drawn:
                add_legend(ax, columns=2)
        return drawn
    lines = [_contours(ax, data, name) for ax, name in zip(drawn, quantities, strict=True)]
    fit_labels(*drawn)
    apply_layout(*drawn)
    for ax, (levels, marks) in zip(drawn, lines, strict=True):
        number_lines(ax, levels, marks)
    return drawn


def beyond_limits(data: xr.Dataset) -> NDArray[np.bool_]:
    """Return which designs exceed a limit."""
    if "within_limits" not in data:
        return np.zeros(data["pareto"].shape, dtype=bool)
    is_beyond: NDArray[np.bool_] = ~data["within_limits"].values.astype(bool)
    return is_beyond


def best_label(data: xr.Dataset) -> str:
    """Return the label of the front. Designs that exceed a limit may lie beyond it."""
    return f"not dominated {'within the limits' if beyond_limits(data).any() else 'by another'}"


def parameters_of(data: Any) -> list[str]:
    """Return the names of the parameters that are varied.

    Raises
    ------
    InputError
        If the data are not a dataset of designs.
    """
    if not isinstance(data, xr.Dataset) or "pareto" not in data:
        raise InputError("data: this is not a dataset of designs; use the result of design_chart")
    return [str(dim) for dim in data["pareto"].dims]


def quantity_label(data: xr.Dataset, name: str) -> tuple[float, str]:
    """Return factor and label of a quantity, with its fractile if some records exceed it."""
    factor, label = QUANTITIES[name]
    factor, label = in_unit(factor), without_unit(label) if unitless() else label
    label += "\nof any mass" if "mass" in data[name].dims else ""
    share = fractile_of(data)
    return factor, label if share is None else (
        f"{label}\n{100.0 * share:g} % fractile over the records"
    )


def quantity_of(values: xr.DataArray) -> Quantity:
    """Return the quantity of the values of a parameter."""
    name = str(values.name)
    if name in PARAMETERS:
        return usual(name).quantity
    try:
        return in_units(str(values.attrs.get("units", "1")))
    except StopIteration:  # of a law with another exponent
        return DIMENSIONLESS


def _unit(values: xr.DataArray) -> tuple[float, str]:
    """Return factor and unit of a parameter: mm for lengths, a unit of fitting size for others."""
    quantity = quantity_of(values)
    if unitless():
        return 1.0, ""
    if quantity is LENGTH:
        return 1e3, "mm"
    scale = quantity.unit(*values.values.ravel())
    return 1.0 / scale.size, scale.symbol or "–"


def _axis(axis: Any, values: xr.DataArray) -> _Array:
    """Set scale, limits and label of an axis, and return the values in its unit."""
    factor, unit = _unit(values)
    drawn: _Array = factor * values.values
    label = f"{values.attrs['long_name']} ({unit})" if unit else str(values.attrs["long_name"])
    scale_axis(axis, drawn, textwrap.fill(label, 44))
    return drawn


def present_values(data: xr.Dataset, dims: list[str]) -> list[float]:
    """Return the values of parameters of the rig itself, in SI units.

    A value is NaN if the rig has none, for example a common gap if the gaps of its stops differ.
    """
    parameters = motion_parameters(data)
    if not {"assembly", "oscillator"} & set(parameters):
        return [math.nan for _ in dims]
    rig, values = Rig(system_from(parameters)), []
    for dim in dims:
        try:
            value = parameter(dim, rig).read(rig)
        except InputError:
            value = math.nan
        values.append(value)
    return values


def _present_on_axes(data: xr.Dataset, dims: list[str]) -> list[float]:
    """Return the values of `present_values` in the units of the axes."""
    return [
        _unit(data[dim])[0] * value
        for dim, value in zip(dims, present_values(data, dims), strict=True)
    ]


def _sorted(data: xr.Dataset) -> xr.Dataset:
    return data.sortby([str(dim) for dim in data["pareto"].dims])


def _finite(values: _Array) -> _Array:
    """Return values, with NaN for those that are infinite."""
    return np.where(np.isfinite(values), values, np.nan)


def _curve(ax: Axes, data: xr.Dataset, name: str) -> None:
    data = _sorted(data)
    (dim,) = parameters_of(data)
    factor, label = quantity_label(data, name)
    x = _axis(ax.xaxis, data[dim])
    y = factor * _finite(over_parts(data[name]).values)
    ax.plot(x, y, color="black", linewidth=1.4, zorder=3)
    best = data["pareto"].values.astype(bool)
    ax.plot(x[best], y[best], "o", color="black", markersize=4.0, label=best_label(data))
    beyond = beyond_limits(data)
    if beyond.any():
        ax.plot(x[beyond], y[beyond], "x", color="0.5", markersize=5.0, label="exceeds a limit")
    free = ~(data["hitting"].values > 0.0)
    ring = CurveStyle("hits no stop", "0.5", "", 0.0, "o", 7.0, False)
    if free.any():
        ax.plot(x[free], y[free], label=ring.label, **ring.marks())
    (present,) = _present_on_axes(data, [dim])
    if x.min() <= present <= x.max():
        dashes = {"color": PRESENT["color"], "linestyle": "-.", "linewidth": 1.0}
        ax.axvline(present, label="present design", **dashes)
    ax.set_ylabel(label)
    _widen(ax)
    ax.set_ylim(0.0, (1.0 + _MARGIN) * float(np.nanmax(y, initial=0.0)) or 1.0)


def _widen(ax: Axes) -> None:
    """Leave room beside the first and the last design, whose marks the axes would cut."""
    scale = ax.xaxis.get_transform()
    low, high = scale.transform(np.array(ax.get_xlim()))
    room = _MARGIN * (high - low)
    left, right = scale.inverted().transform(np.array([low - room, high + room]))
    ax.set_xlim(float(left), float(right))


def _contours(ax: Axes, data: xr.Dataset, name: str) -> tuple[list[Any], list[Line2D]]:
    """Draw contours, and return their levels and the marks that their numbers must not cover."""
    data = _sorted(data)
    second, first = parameters_of(data)
    # A gap lies along the bottom, whichever was named first.
    if second == "gap":
        first, second = second, first
    data = data.transpose(second, first, ...)
    factor, label = quantity_label(data, name)
    x, y = _axis(ax.xaxis, data[first]), _axis(ax.yaxis, data[second])
    # Contours between nodes are straight lines, whatever the axes' scales.
    points = finer_axis(ax.xaxis, x), finer_axis(ax.yaxis, y)
    known = _finite(over_parts(data[name]).values)
    values = np.ma.masked_invalid(finer(factor * known))
    ax.set_title(label, fontsize="medium")
    levels: list[tuple[float, Any]] = []
    if values.count() and np.ptp(values.compressed()) > 1e-9 * np.abs(values).max():
        filled = ax.contourf(*points, values, levels=_LEVELS, cmap="YlGnBu", alpha=0.55, zorder=1)
        lines = ax.contour(
            *points, values, levels=filled.levels, colors="0.15", linewidths=0.7, zorder=3
        )
        levels = list(zip(lines.levels, lines.allsegs, strict=True))
    hits = (data["hitting"].values > 0.0).astype(float)
    handles: list[Line2D | Patch] = []
    edges = []
    if 0.0 < hits.mean() < 1.0:
        # Through the designs that just have no contact: never on the side of those that hit.
        style = {"colors": _EDGE.colour, "linewidths": _EDGE.width, "linestyles": _EDGE.dashes}
        edge = ax.contour(x, y, hits, levels=[1e-3], zorder=3, **style)
        edges = [Line2D(*part.T) for part in edge.allsegs[0]]
        label = "first of these designs to hit no stop"
        handles.append(Line2D([], [], label=label, **_EDGE.line))
    if beyond_limits(data).any():
        handles.append(_hatch(ax, *points, _excess(data)))
    best = np.argwhere(data["pareto"].values.astype(bool))
    dots: list[Line2D] = []
    if len(best):
        dot = CurveStyle(best_label(data), "black", "", 0.0, "o", 4.0, True)
        style = dot.marks() | {"clip_on": False, "label": dot.label, "zorder": 5}
        dots = ax.plot(x[best[:, 1]], y[best[:, 0]], **style)
    stars: list[Line2D] = []
    right, up = _present_on_axes(data, [first, second])
    if x.min() <= right <= x.max() and y.min() <= up <= y.max():
        star = PRESENT | {"clip_on": False, "label": "present design", "zorder": 6}
        stars = ax.plot([right], [up], **star)
    marks = [*dots, *stars]
    add_legend(ax, [*marks, *handles], columns=2, place="below")
    return levels, [*marks, *edges]


def _excess(data: xr.Dataset) -> _Array:
    """Return values at the points of `finer_axis` that are above 0 where a limit is exceeded."""
    beyond = beyond_limits(data)
    each = np.array(
        [one.transpose(*data["pareto"].dims).values for one in excesses(data)]
        or [np.full(beyond.shape, np.nan)]
    )
    known = np.isfinite(each).all(axis=0) & ((each.max(axis=0) > 0.0) == beyond)
    # Each limit by itself: the larger of two is no straight line.
    largest = np.max([finer(np.where(known, one, np.nan)) for one in each], axis=0)
    return np.where(np.isnan(largest), np.where(nearest(beyond), 1.0, -1.0), largest)


def _hatch(ax: Axes, x: _Array, y: _Array, excess: _Array) -> Patch:
    """Hatch the area where a limit is exceeded, and return its legend entry."""
    # What is just at a limit keeps it, whatever rounding and the lowest level would make of it.
    excess = np.where(excess > 0.0, excess, np.minimum(excess, -1e-300))
    with matplotlib.rc_context({"hatch.color": "0.5", "hatch.linewidth": 0.6}):
        beyond = [0.0, excess.max() + 1.0]
        ax.contourf(x, y, excess, levels=beyond, hatches=["////"], colors="none", zorder=2)
        sample = Patch(facecolor="none", edgecolor="0.5", hatch="////", label="exceeds a limit")
    if excess.min() < 0.0:
        ax.contour(x, y, excess, levels=[0.0], colors="0.4", linewidths=1.2, zorder=2)
    return sample
