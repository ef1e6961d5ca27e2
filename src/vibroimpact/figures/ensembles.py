"""Resonance curves of uncertain rigs as bands, and sensitivity indices."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.patches import Patch

from vibroimpact.datasets.description import motion_parameters, system_from
from vibroimpact.datasets.stops import quantity as of_quantity
from vibroimpact.earthquakes.suites import fractiles
from vibroimpact.errors import InputError
from vibroimpact.figures.axis_labels import axis_label
from vibroimpact.figures.finish import finished
from vibroimpact.figures.legends import add_legend, break_lines
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.resonance_panels import draws_eta
from vibroimpact.figures.style import MOTIONS, SWEEPS, fit_x_axis, panels
from vibroimpact.model.parameters import parameter

_HATCHES = {"forward": "", "backward": "////"}
_FULL = 0.9
"""Share of the distance between bars that the name of a parameter may cover."""
_LIGHT = {"forward": 0.25, "backward": 0.0}
PANELS = {True: ("eta_a", "eta_d"), False: ("peak_acceleration", "peak_displacement")}
"""Quantities of the bands, by whether η is drawn."""


@finished
def resonance_bands(
    data: xr.Dataset,
    axes: Any = None,
    *,
    quantities: Sequence[str] | None = None,
    shares: tuple[float, float] = (0.05, 0.95),
    nominal: xr.Dataset | None = None,
    title: str | None = None,
) -> Panels:
    """Draw the resonance curves of an ensemble: the median, and a band between two fractiles.

    Parameters
    ----------
    data
        Dataset of `ensemble`, whose response is `sweeps`.
    axes
        Axes to draw on, one per quantity. Default: a new figure.
    quantities
        Variables of the sweeps. Each has its own panel; of an assembly, each mass has one, unless
        the name states it, such as ``"peak_displacement.roof"``. Default: ``("eta_a", "eta_d")``
        for a published case, and ``("peak_acceleration", "peak_displacement")`` for study files and
        other rigs; also if the motion without stops is unbounded, so that η has no meaning.
    shares
        Shares of the rigs that lie below the lower end and below the upper end of the band.
    nominal
        Dataset of `sweep` for the rig with its nominal values, which is drawn as a thin line.
        Default: no such line.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset is not an ensemble of sweeps, or if it does not contain one of the
        quantities.
    """
    if not {"sample", "direction", "frequency"} <= set(data.dims):
        raise InputError(
            f"data: a dataset with the dimensions {dict(data.sizes)} is not an ensemble of sweeps; "
            "pass the result of ensemble with sweeps as its response"
        )
    if quantities is None:
        quantities = PANELS[draws_eta(data)]
    quantities = [one for name in quantities for one in _by_mass(data, name)]
    low, high = shares
    if not 0.0 <= low < 0.5 < high <= 1.0:
        raise InputError(f"shares: {shares}; pass one share below and one above 0.5")
    count = len(quantities)
    drawn = panels(axes, count, "one panel per quantity", (7.2, 1.4 + 2.5 * count), title)
    frequency = data["frequency"].values
    handles: list[Any] = []
    for ax, quantity in zip(drawn, quantities, strict=True):
        bands = fractiles(data, quantity, (low, 0.5, high))[quantity.partition(".")[0]]
        factor, label = axis_label(bands, quantity)
        handles = []
        for direction in data["direction"].values:
            look = SWEEPS[str(direction)]
            lower, middle, upper = factor * bands.sel(direction=direction).values
            style: dict[str, Any] = {
                "facecolor": (look.colour, _LIGHT[str(direction)]),
                "edgecolor": (look.colour, 0.6),
                "hatch": _HATCHES[str(direction)],
                "linewidth": 0.6,
            }
            if len(frequency) > 1:
                ax.fill_between(frequency, lower, upper, zorder=2, **style)
            else:
                reach = [middle - lower, upper - middle]
                ax.errorbar(
                    frequency, middle, reach, ecolor=look.colour, fmt="none", capsize=3.0, zorder=2
                )
            words = f"{look.label}, median"
            handles += ax.plot(frequency, middle, label=words, zorder=3, **look.line)
            handles.append(Patch(label=f"{100 * low:g} to {100 * high:g} %", **style))
            if nominal is not None:
                line = ax.plot(
                    nominal["frequency"].values,
                    factor * of_quantity(nominal, quantity).sel(direction=direction).values,
                    color="black",
                    linestyle=":",
                    linewidth=0.9,
                    label="nominal rig",
                    zorder=4,
                )
        if nominal is not None:
            handles += line
        ax.set_ylabel(label)
        fit_x_axis(ax, frequency)
        ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
    add_legend(drawn[0], handles, columns=3)
    drawn[-1].set_xlabel("excitation frequency (Hz)")
    return drawn


def _by_mass(data: xr.Dataset, name: str) -> list[str]:
    """Return the names of a quantity of each mass, or its own if it has one value only."""
    if name not in data or "mass" not in data[name].dims:
        return [name]
    return [f"{name}.{mass}" for mass in data["mass"].values]


@finished
def sensitivity_bars(data: xr.Dataset, ax: Axes | None = None, *, title: str | None = None) -> Axes:
    """Draw the Sobol indices of each parameter, of first order and of total order.

    The indices of a single number are drawn as bars. If the dataset has intervals, they are drawn
    as well. The indices of a curve, for example over the frequency, are drawn as lines of the total
    order.

    Parameters
    ----------
    data
        Dataset of `sensitivity` for one number or for one curve. If it holds more, choose one by
        ``isel``.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If ``data`` is not a dataset of `sensitivity`, or holds more than one curve.
    """
    if "total_order" not in data:
        raise InputError("data: it has no sensitivity indices; pass the result of sensitivity")
    others = [dim for dim in data["total_order"].dims if dim != "uncertain_parameter"]
    if len(others) > 1:
        raise InputError(
            f"data: the indices depend on {', '.join(map(str, others))}, but only one of these can "
            f"be drawn; select a value of the others, such as data.isel({others[0]}=0)"
        )
    ax = axes_or_new(ax, (6.4, 3.8), title)
    if others:
        _curves(ax, data, str(others[0]))
    else:
        _bars(ax, data)
    _, label = axis_label(data["mean"], str(data.attrs["quantity"]))
    ax.set_ylabel(f"share of the variance of\n{label.rsplit(' (', 1)[0]} (–)")
    add_legend(ax, columns=2)
    return ax


def _bars(ax: Axes, data: xr.Dataset) -> None:
    names = [str(name) for name in data["uncertain_parameter"].values]
    at = np.arange(len(names))
    for shift, name, label, colour, hatch in (
        (-0.18, "first_order", "alone", "#1f4fbf", ""),
        (0.18, "total_order", "with interactions", "white", "////"),
    ):
        values = data[name].values
        errors = None
        if f"{name}_interval" in data:
            ends = data[f"{name}_interval"].transpose("bound", "uncertain_parameter").values
            errors = np.abs(ends - values)
        ax.bar(
            at + shift,
            values,
            0.34,
            yerr=errors,
            capsize=3,
            color=colour,
            edgecolor="#1f4fbf",
            hatch=hatch,
            label=label,
        )
    ax.axhline(0.0, color="black", linewidth=0.8)
    ax.set_xticks(at, [_words(data, name) for name in names])
    room = _FULL * ax.bbox.width / max(len(names), 1)
    below = ax.get_xticklabels()
    for text in below:
        break_lines(text, room, None)
    upright = any(text.get_window_extent().width > room for text in below)
    ax.set_xticks(at, [text.get_text() for text in below], rotation=90.0 if upright else 0.0)


def _curves(ax: Axes, data: xr.Dataset, over: str) -> None:
    x = data[over].values if over in data.coords else np.arange(data.sizes[over])
    for i, name in enumerate(data["uncertain_parameter"].values):
        look = MOTIONS[i % len(MOTIONS)]
        ax.plot(
            x,
            data["total_order"].sel(uncertain_parameter=name).values,
            markevery=max(1, len(x) // 20),
            label=_words(data, str(name)),
            **look.marks() | look.line,
        )
    fit_x_axis(ax, x)
    # Beyond 0 and 1 an estimate is nothing but its error.
    ax.set_ylim(-0.1, 1.1)
    meaning = data[over].attrs if over in data.coords else {}
    unit = {"1": "–"}.get(str(meaning.get("units", "1")), meaning.get("units"))
    ax.set_xlabel(f"{meaning.get('long_name', over.replace('_', ' '))} ({unit})")


def _words(data: xr.Dataset, name: str) -> str:
    """Return the name of a parameter in words, as it is in the rig of the dataset."""
    return parameter(name, system_from(motion_parameters(data))).long_name
