"""Measured resonance curves, alone or as points over computed curves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.figures.jumps import cut_at
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.style import EDGE, SHADE, panels, sweeps_of
from vibroimpact.measurements.features import measured_features
from vibroimpact.model.quantities import GRAVITY
from vibroimpact.response.curve_pair import judged

_Array = NDArray[np.float64]


class _Panel(NamedTuple):
    """A quantity that may have been measured."""

    name: str
    values: xr.DataArray
    """Values in the units of the axis."""
    label: str


_KINDS = {
    "acceleration": ("absolute\nacceleration", 1.0 / GRAVITY, "g"),
    "displacement": ("relative\ndisplacement", 1e3, "mm"),
}
"""Text of each quantity, and factor and unit of its values."""


def _panel(data: xr.Dataset, kind: str) -> _Panel | None:
    """Return the first measured quantity of the acceleration or the displacement.

    If maxima and minima were measured, the larger absolute value is drawn. Then the figure does not
    depend on the direction in which the sensor is mounted. If only one of them was measured, it is
    drawn unchanged.
    """
    words, factor, unit = _KINDS[kind]
    if f"{kind}_excursion" in data:
        symbol = f"$E_{kind[0]}$"
        label = f"excursion of {words} {symbol} ({unit})"
        return _Panel(f"{kind}_excursion", factor * data[f"{kind}_excursion"], label)
    if (eta := f"eta_{kind[0]}") in data:
        of = words.replace("\n", " ")
        return _Panel(eta, data[eta], f"normalised excursion of\n{of} $\\eta_{kind[0]}$ (–)")
    if (largest := _largest(data, kind)) is not None:
        return _Panel(f"{kind}_max", factor * largest, f"largest {words} ({unit})")
    name = judged(data, kind)
    if name is None:
        return None
    side = "maximum" if name.endswith("max") else "minimum"
    return _Panel(name, factor * data[name], f"{side} of {words} ({unit})")


def _largest(data: xr.Dataset, kind: str) -> xr.DataArray | None:
    """Return the larger absolute value of maximum and minimum, if both were measured."""
    both = {f"{kind}_max", f"{kind}_min"} <= set(data)
    if not (both and judged(data[[f"{kind}_max", f"{kind}_min"]], kind) == f"{kind}_excursion"):
        return None
    most, least = (abs(data[f"{kind}_{end}"]) for end in ("max", "min"))
    return xr.DataArray(np.maximum(most, least))


def measured_curves(data: xr.Dataset, axes: Any = None, *, title: str | None = None) -> Panels:
    """Draw measured curves: a point a hold, hysteresis shaded, the step of a jump dotted.

    Raises
    ------
    InputError
        If nothing that is drawn was measured, or there are not as many axes.
    """
    shown = [panel for kind in _KINDS if (panel := _panel(data, kind)) is not None]
    if not shown:
        raise InputError(
            "data: no excursion, maximum, minimum or η of the displacement or the acceleration; "
            "pass measured curves with at least one of them"
        )
    features = measured_features(data)
    what = " and ".join(panel.name for panel in shown)
    panel_axes = panels(axes, len(shown), what, (7.2, 0.4 + 3.2 * len(shown)), title)
    for ax, panel in zip(panel_axes, shown, strict=True):
        for item in features.hysteresis:
            ax.axvspan(*item.ends, facecolor=SHADE, edgecolor=EDGE, lw=0.0, zorder=0)
        for direction, look in sweeps_of(data):
            x, y = points_of(panel.values.sel(direction=direction))
            jumps = [j for j in features.jumps if j.direction == direction]
            ax.plot(
                *cut_at(x, y, jumps),
                label=f"{look.label}, measured",
                zorder=3,
                **look.marks() | look.line | {"linewidth": 0.6},
            )
            mean = panel.values.sel(direction=direction)
            mean = mean.mean("repeat") if "repeat" in mean.dims else mean
            for jump in jumps:
                ends = mean.sel(frequency=[jump.before, jump.after]).values
                dotted = look._replace(dashes=":", width=1.0)
                ax.plot([jump.before, jump.after], ends, zorder=2, **dotted.line)
        ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
        ax.set_ylabel(panel.label)
    panel_axes[-1].set_xlabel("excitation frequency $f$ (Hz)")
    add_legend(panel_axes[0], columns=2)
    return panel_axes


def points_of(values: xr.DataArray) -> tuple[_Array, _Array]:
    """Return frequencies and values of all measurements in one direction."""
    grid = np.broadcast_to(
        values["frequency"].values.reshape(-1, *([1] * (values.ndim - 1))),
        values.transpose("frequency", ...).shape,
    )
    table = values.transpose("frequency", ...).values
    known = np.isfinite(table)
    return grid[known], table[known]


def halves_of(measured: xr.Dataset) -> set[str]:
    """Return which of acceleration and displacement were measured only as excursions."""
    return {
        kind
        for kind in ("acceleration", "displacement")
        if f"{kind}_excursion" in measured and not {f"{kind}_max", f"{kind}_min"} <= set(measured)
    }


def measured_points(
    axes: Sequence[Axes], names: Sequence[str], computed: xr.Dataset, measured: xr.Dataset
) -> list[Any]:
    """Draw measured points over computed curves; return what a legend shows of them.

    Parameters
    ----------
    axes, names
        The panels: ``η_a``, ``η_d``, ``acceleration``, ``displacement`` or others.
    computed
        The sweep beneath. Its largest free flight normalises excursions where η was not measured.
    measured
        Curves of `read_measurement`.
    """
    entries: dict[str, Any] = {}
    for ax, name in zip(axes, names, strict=True):
        for direction, look in sweeps_of(measured):
            points = _on_panel(name, computed, measured.sel(direction=direction))
            if points is None:
                continue
            (line,) = ax.plot(
                *points,
                linestyle="none",
                marker="o" if look.filled else "s",
                markersize=5.0 if look.filled else 6.5,
                markerfacecolor="none",
                markeredgecolor="black" if look.filled else look.colour,
                markeredgewidth=0.9,
                label=f"measured, {look.label}",
                zorder=6,
            )
            entries[direction] = line
            top = 1.06 * float(np.max(points[1], initial=0.0))
            if top > ax.get_ylim()[1]:
                ax.set_ylim(top=top)
    return list(entries.values())


def _on_panel(
    name: str, computed: xr.Dataset, measured: xr.Dataset
) -> tuple[_Array, _Array] | None:
    """Return frequencies and values in the units of a panel, or None if they were not measured."""
    kind = "acceleration" if name in ("η_a", "acceleration") else "displacement"
    if name in ("η_a", "η_d"):
        if f"eta_{name[-1]}" in measured:
            return points_of(measured[f"eta_{name[-1]}"])
        ends = [measured[n] for n in (f"{kind}_max", f"{kind}_min") if n in measured]
        if f"{kind}_excursion" in measured:
            excursion = measured[f"{kind}_excursion"]
        elif len(ends) == 2:
            excursion = ends[0] - ends[1]
        else:
            return None
        x, y = points_of(excursion)
        return x, y / float(computed[f"largest_free_{kind}_excursion"])
    if name != kind:
        return None
    factor = _KINDS[kind][1]
    if (largest := _largest(measured, kind)) is not None:
        x, y = points_of(largest)
        return x, factor * y
    if f"{kind}_excursion" in measured:  # half of it, as `halves_of` scales the curves
        x, y = points_of(measured[f"{kind}_excursion"])
        return x, 0.5 * factor * y
    return None
