"""Resonance curves and branches of several masses: one panel for each mass or stop."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from vibroimpact.arguments import check_name
from vibroimpact.errors import InputError
from vibroimpact.figures.assembly_motion import (
    assembly_of,
    chosen,
    grid_of_panels,
    label_each,
)
from vibroimpact.figures.axis_labels import axis_label
from vibroimpact.figures.branches import (
    axis_unit,
    mark_bifurcations,
    mark_sweep,
    orbit_style,
    parts_of_curve,
    stable_pieces,
)
from vibroimpact.figures.finish import finished
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.style import EDGE, SHADE, sweeps_of
from vibroimpact.model import Assembly
from vibroimpact.response.resonance import runs

_Array = NDArray[np.float64]

_BASE = "transmitted force"
_MARKS = 20
"""Approximate number of marks on a curve."""
_CONTACT = {"both": "", "one": "/////"}
_LABELS = {"both": "contact", "one": "contact in one sweep"}


@finished
def mass_resonance(
    data: xr.Dataset,
    axes: Any = None,
    *,
    quantity: str = "peak_displacement",
    names: Sequence[str] | None = None,
    title: str | None = None,
) -> Panels:
    """Draw the resonance curves of an assembly: one panel for each mass, or for each stop.

    The forward sweep is a solid red line with dots, the backward sweep a dashed blue line with
    squares. Frequencies at which a stop is touched are shaded, and hatched if it is touched in one
    of the two sweeps alone: in the panels of masses any stop, in that of a stop this one. Crosses
    mark motions that did not become periodic.

    Parameters
    ----------
    data
        Dataset of `sweep` of a rig with an `Assembly`.
    axes
        One Axes per panel. Default: a new figure.
    quantity
        Name of a variable of the sweep: one by mass, such as ``"peak_displacement"``,
        ``"displacement_excursion"`` or ``"peak_acceleration"``; one by stop, such as
        ``"peak_force"``, ``"peak_impulse"`` or ``"impacts"``; or ``"peak_transmitted_force"``. Of
        a rigid stop, whose force is infinite, the panel of ``"peak_force"`` shows the largest
        impulse instead.
    names
        Names of the masses, or of the stops, that are drawn. Default: all.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    tuple of Axes
        One Axes per mass or stop. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset does not hold the sweep of an assembly, or if the quantity or a name does not
        exist.
    """
    what = "data: this is not a sweep; pass the result of sweep"
    assembly = assembly_of(data, what, "direction", "frequency")
    drawn = _panels(data, quantity, names, assembly)
    panel_axes = grid_of_panels(axes, [one.name for one in drawn], title)
    frequency = data["frequency"].values
    kinds: set[str] = set()
    loose = set()
    for ax, one in zip(panel_axes, drawn, strict=True):
        kinds |= _shade(ax, frequency, one.touched)
        for layer, (direction, style) in enumerate(sweeps_of(data)):
            curve = one.factor * one.values.sel(direction=direction).values
            ax.plot(
                frequency,
                curve,
                label=style.label,
                zorder=3 + layer,
                **style.curve(len(frequency), _MARKS),
            )
            wild = data["motion"].sel(direction=direction).values != "periodic"
            if wild.any():
                loose.add(direction)
                ax.plot(frequency[wild], curve[wild], zorder=5 + layer, **style.cross())
        ax.set_xlim(frequency[0], max(frequency[-1], 1.001 * frequency[0]))
        if not (one.values < 0.0).any():
            ax.set_ylim(bottom=0.0)
    label_each(panel_axes, axes, [one.label for one in drawn])
    label_lowest(panel_axes, axes, "excitation frequency $f$ (Hz)")
    entries: list[Any] = []
    for direction, look in sweeps_of(data):
        entries.append(Line2D([], [], label=look.label, **look.curve(1)))
        if direction in loose:
            label = f"{look.label}, not settled"
            entries.append(Line2D([], [], label=label, **look.cross()))
    entries += [
        Patch(facecolor=SHADE, edgecolor=EDGE, lw=0.0, hatch=_CONTACT[kind], label=_LABELS[kind])
        for kind in _CONTACT
        if kind in kinds
    ]
    legend_of(panel_axes, axes, entries)
    return panel_axes


@finished
def mass_branches(
    data: xr.Dataset,
    axes: Any = None,
    *,
    quantity: str = "peak_displacement",
    names: Sequence[str] | None = None,
    sweep: xr.Dataset | None = None,
    title: str | None = None,
) -> Panels:
    """Draw a branch of an assembly over its parameter: one panel for each mass, or for each stop.

    Stable parts are solid, unstable parts are dashed, and bifurcations are marked. Parts with
    contacts are thicker: in the panels of masses at any stop, in that of a stop at this one.

    Parameters
    ----------
    data
        Dataset of `branch` of a rig with an `Assembly`.
    axes
        One Axes per panel. Default: a new figure.
    quantity, names
        As in `mass_resonance`.
    sweep
        Dataset of `sweep` over the same frequencies, which is drawn as marks. Default: no sweep.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    tuple of Axes
        One Axes per mass or stop. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset does not hold the branch of an assembly, or if the quantity or a name does
        not exist. Also if a sweep is passed although the parameter is not the frequency.
    """
    what = "data: this is not a branch; pass the result of branch"
    assembly = assembly_of(data, what, "parameter", "branch")
    parameter = data.attrs["parameter"]
    if sweep is not None and (parameter != "frequency" or quantity not in sweep):
        raise InputError(
            f"sweep: the branches are of {quantity!r} along {parameter!r}; pass a sweep of the "
            "same rig with branches along 'frequency', or leave sweep out"
        )
    drawn = _panels(data, quantity, names, assembly)
    panel_axes = grid_of_panels(axes, [one.name for one in drawn], title)
    scale, unit = axis_unit(data[parameter])
    x = scale * data[parameter].values
    pieces = stable_pieces(data)
    styles: dict[tuple[bool, bool], dict[str, Any]] = {}
    marks: list[Line2D] = []
    for ax, one in zip(panel_axes, drawn, strict=True):
        y = one.factor * one.values.values
        for piece, stable in pieces:
            hit = one.touched[piece]
            for run, touched in parts_of_curve(hit[:-1] & hit[1:]):
                width = (2.0 if touched else 0.9) * (1.0 if stable else 0.8)
                styles[stable, touched] = style = orbit_style(stable, width)
                ax.plot(x[piece][run], y[piece][run], **style)
        marks = []  # of each panel the same kinds: one legend serves all
        if sweep is not None:
            swept = one.factor * one.of(sweep[one.quantity])
            marks += mark_sweep(ax, swept, scale, 0.7, _MARKS)
        if f"bifurcation_{one.quantity}" in data:
            marked = one.factor * one.of(data[f"bifurcation_{one.quantity}"]).values
            marks += mark_bifurcations(ax, data, scale, marked)
        ax.set_xlim(x.min(), x.max() if x.max() > x.min() else None)
    label_each(panel_axes, axes, [one.label for one in drawn])
    label_lowest(panel_axes, axes, f"{data[parameter].attrs['long_name']} ({unit})")
    words = {True: "stable", False: "unstable"}
    entries = [
        Line2D([], [], label=f"{words[stable]}{', contact' if touched else ''}", **style)
        for (stable, touched), style in sorted(styles.items(), reverse=True)
    ]
    legend_of(panel_axes, axes, [*entries, *marks])
    return panel_axes


def label_lowest(panel_axes: Panels, axes: Any, label: str) -> None:
    """Label the horizontal axes of the panels that have none below them."""
    for i, ax in enumerate(panel_axes):
        place = ax.get_subplotspec()
        columns = 1 if place is None or axes is not None else place.get_gridspec().ncols
        if i >= len(panel_axes) - columns:
            ax.set_xlabel(label)


def legend_of(panel_axes: Panels, axes: Any, entries: list[Any]) -> None:
    """Add one legend for all panels: above the first, or below all panels of a new figure."""
    figure = panel_axes[0].get_figure(root=True)
    if axes is None and figure is not None and len(panel_axes) > 2:
        add_legend(figure, entries, columns=4)
    else:
        add_legend(panel_axes[0], entries, columns=3)


class _Panel(NamedTuple):
    """What a panel shows of a mass or a stop."""

    name: str
    """Name of the mass or the stop, or the words of a quantity of the whole assembly."""
    quantity: str
    values: xr.DataArray
    factor: float
    label: str
    touched: NDArray[np.bool_]
    """Where a stop is touched: this one, or any for a mass or the assembly."""

    def of(self, values: xr.DataArray) -> xr.DataArray:
        """Return the values of this part from those of all."""
        return values.sel({dim: self.name for dim in ("mass", "stop") if dim in values.dims})


def _panels(
    data: xr.Dataset, quantity: str, names: Sequence[str] | None, assembly: Assembly
) -> list[_Panel]:
    """Return the panels of a quantity: one per mass, one per stop, or one of the assembly."""
    along = {"point"} if "point" in data.dims else {"direction", "frequency"}
    known = [
        str(name)
        for name, one in data.data_vars.items()
        if along <= set(one.dims) <= along | {"mass", "stop"}
        and one.dtype.kind == "f"
        and not str(name).startswith("bifurcation_")
    ]
    check_name(quantity, known, "quantity")
    values = data[quantity]
    hit = data["peak_force"] > 0.0  # infinite at a rigid stop that is hit
    dim = next((dim for dim in ("mass", "stop") if dim in values.dims), None)
    if dim is None:
        name = _BASE if "transmitted" in quantity else quantity.replace("_", " ")
        factor, label = axis_label(values, quantity)
        return [_Panel(name, quantity, values, factor, label, hit.any("stop").values)]
    every = assembly.names if dim == "mass" else tuple(assembly.stops)
    panels = []
    shared = axis_label(values, quantity)
    for name in chosen(names, every, dim, "names"):
        of, (factor, label) = quantity, shared
        if quantity == "peak_force" and assembly.stops[name].stop.rigid:
            of = "peak_impulse"
            factor, label = axis_label(data[of], of)
        # The orbit touches, whichever mass is hit.
        touched = (hit.any("stop") if dim == "mass" else hit.sel(stop=name)).values
        panels.append(_Panel(name, of, data[of].sel({dim: name}), factor, label, touched))
    return panels


def _shade(ax: Axes, frequency: _Array, hit: NDArray[np.bool_]) -> set[str]:
    """Shade the frequencies with contact, and return which kinds of shades were drawn."""
    edges = np.concatenate([frequency[:1], 0.5 * (frequency[1:] + frequency[:-1]), frequency[-1:]])
    both = np.asarray(hit.all(axis=0))
    spans = {"both": runs(both), "one": runs(hit.any(axis=0) & ~both)}
    style: dict[str, Any] = {"facecolor": SHADE, "edgecolor": EDGE, "lw": 0.0, "zorder": 0}
    for kind, hatch in _CONTACT.items():
        for first, last in spans[kind]:
            ax.axvspan(edges[first], edges[last + 1], hatch=hatch, **style)
    return {kind for kind in spans if spans[kind]}
