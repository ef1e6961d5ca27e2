"""Response spectra over the natural period."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.arguments import check_name
from vibroimpact.errors import InputError
from vibroimpact.figures.finish import finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new, by_name
from vibroimpact.figures.style import CURVES, also_in_g, fit_x_axis
from vibroimpact.model import Record
from vibroimpact.model.names import literal

_LABELS = {
    "spectral_displacement": (1e3, "largest $|u|$ (mm)"),
    "spectral_velocity": (1.0, "largest $|\\dot u|$ (m/s)"),
    "spectral_acceleration": (1.0, "largest absolute acceleration $|\\ddot u + A_t|$ (m/s²)"),
    "pseudo_velocity": (1.0, "pseudo-velocity\n$\\omega\\,\\max |u|$ (m/s)"),
    "pseudo_acceleration": (1.0, "pseudo-acceleration\n$\\omega^2 \\max |u|$ (m/s²)"),
}
_MOST = len(CURVES) ** 2


@finished
def response_spectra(
    spectrum: xr.Dataset | Mapping[str, xr.Dataset],
    ax: Axes | None = None,
    *,
    quantity: Literal[
        "spectral_displacement",
        "spectral_velocity",
        "spectral_acceleration",
        "pseudo_velocity",
        "pseudo_acceleration",
    ] = "pseudo_acceleration",
    title: str | None = None,
) -> Axes:
    """Draw response spectra, with one curve per record, damping ratio and orientation.

    Parameters
    ----------
    spectrum
        Dataset of `response_spectrum` with several natural periods. The period 0 is not drawn. For
        several records, pass a mapping from names to datasets.
    ax
        Axes to draw on. Default: a new figure.
    quantity
        Name of the variable that is drawn.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If ``spectrum`` is not a response spectrum with several periods, or if the quantity is
        unknown. Also if there are more curves than can be distinguished.
    """
    check_name(quantity, _LABELS, "quantity")
    datasets = _named(spectrum)
    factor, label = _LABELS[quantity]
    every = [(name, curve) for name, one in datasets.items() for curve in _curves(one[quantity])]
    if len(every) > _MOST:
        raise InputError(
            f"spectrum: {len(every)} curves; at most {_MOST} can be distinguished, so select fewer "
            "records, orientations or damping ratios"
        )
    ax = axes_or_new(ax, (5.6, 3.6), title)
    # Colours distinguish records or orientations, and dashes the rest; alone, both change together.
    groups = [(name, _orientation(curve)) for name, curve in every]
    numbers = {group: number for number, group in enumerate(dict.fromkeys(groups))}
    grouped = len(numbers) > 1
    periods = np.concatenate([one["natural_period"].values for one in datasets.values()])
    for i, (group, (name, curve)) in enumerate(zip(groups, every, strict=True)):
        shown = curve["natural_period"].values > 0.0
        words = [literal(name), group[1], f"$\\zeta$ = {float(curve['damping_ratio']):g}"]
        within = groups[:i].count(group)
        ax.plot(
            curve["natural_period"].values[shown],
            in_unit(factor) * curve.values[shown],
            color=CURVES[(numbers[group] if grouped else i) % len(CURVES)].colour,
            linestyle=CURVES[(within if grouped else i) % len(CURVES)].dashes,
            linewidth=1.1,
            label=", ".join(filter(None, words)),
        )
    ax.set_xscale("log")
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set_ylim(bottom=0.0)
    fit_x_axis(ax, periods[periods > 0.0])
    ax.set_xlabel("natural period (s)")
    ax.set_ylabel(label)
    if "acceleration" in quantity:
        also_in_g(ax)
    ax.grid(True, which="major", linewidth=0.4, color="0.85")
    add_legend(ax, columns=2 if grouped else 5)
    return ax


def _named(spectrum: Any) -> dict[str, xr.Dataset]:
    """Return the spectra by name, a single one without a name."""
    # A dataset is a mapping, too.
    datasets = by_name(spectrum)
    if not datasets:
        raise InputError("spectrum: empty; pass at least one result of response_spectrum")
    for name, one in datasets.items():
        if not isinstance(one, xr.Dataset) or one.sizes.get("natural_period", 0) < 2:
            what = "a Record" if isinstance(one, Record) else "not a response spectrum over periods"
            raise InputError(
                f"spectrum{f'[{name!r}]' if name else ''}: this is {what}; pass the result of "
                "response_spectrum with at least two periods"
            )
    return datasets


def _orientation(curve: xr.DataArray) -> str:
    return str(curve["orientation"].values) if "orientation" in curve.coords else ""


def _curves(values: xr.DataArray) -> list[xr.DataArray]:
    """Return the curves over the natural period, by orientation and damping ratio."""
    others = [dim for dim in ("orientation", "damping_ratio") if dim in values.dims]
    if not others:
        return [values]
    stacked = values.stack(curve=others)
    return [stacked.isel(curve=i) for i in range(stacked.sizes["curve"])]
