"""Results for suites of records: curves of incremental dynamic analysis, and fragility curves."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.earthquakes.fragility import lacking
from vibroimpact.earthquakes.suites import fractiles, known
from vibroimpact.errors import InputError
from vibroimpact.figures.axis_labels import of_part
from vibroimpact.figures.finish import finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.style import CURVES, fit_x_axis
from vibroimpact.model import GRAVITY, to_si
from vibroimpact.model.quantities import LENGTH
from vibroimpact.model.written_units import unitless

_LABELS = {
    "peak_displacement": (1e3, "largest displacement $|u|$ (mm)"),
    "displacement_max": (1e3, "largest displacement $u$ to the right (mm)"),
    "displacement_min": (-1e3, "largest displacement $-u$ to the left (mm)"),
    "peak_acceleration": (1.0 / GRAVITY, "largest absolute acceleration $|\\ddot u + A_t|$ (g)"),
    "peak_force": (1e-3, "largest contact force (kN)"),
    "peak_force.right": (1e-3, "largest force of the right stop (kN)"),
    "peak_force.left": (1e-3, "largest force of the left stop (kN)"),
    "residual_displacement": (1e3, "residual displacement (mm)"),
}
_FRACTILES = (0.16, 0.5, 0.84)
_DASHES = ("--", "-", "-.")


@finished
def incremental_curves(
    demands: xr.Dataset,
    ax: Axes | None = None,
    *,
    quantity: str = "peak_displacement",
    limit: float | None = None,
    title: str | None = None,
) -> Axes:
    """Draw curves of incremental dynamic analysis: a grey curve for each record, and the fractiles.

    Parameters
    ----------
    demands
        Dataset of `demands` for one rig. If the dataset has several rigs, choose one by ``isel`` or
        ``sel``.
    ax
        Axes to draw on. Default: a new figure.
    quantity
        Name of a peak in the dataset, such as ``"peak_displacement"``.
    limit
        Limit of the peak in SI units, such as the gap, which is drawn as a line. Default: no line.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If ``demands`` is not a dataset of `demands`, has fewer than two scales, or holds several
        rigs.
    """
    if isinstance(ax, str):
        raise InputError(
            f"ax: {ax!r} is not a matplotlib Axes; to draw another peak, pass quantity={ax!r}"
        )
    values = known(demands, quantity)
    _one_rig(values, "demands")
    ax = axes_or_new(ax, (5.6, 4.0), title)
    factor, label = _LABELS.get(quantity) or (1.0, _plain_label(demands, quantity))
    factor = in_unit(factor)
    unit, symbol = _level_unit(demands)
    level = unit * demands["scale"].values
    for number, one in enumerate(values.transpose("record", "scale").values):
        finite = np.where(np.isfinite(one), one, np.nan)
        ax.plot(
            level,
            factor * finite,
            color="0.75",
            linewidth=0.6,
            label=None if number else "single records",
            zorder=2,
        )
    fractile_curves = fractiles(demands, quantity, _FRACTILES)[str(values.name)]
    for share, dashes in zip(_FRACTILES, _DASHES, strict=True):
        curve = fractile_curves.sel(fractile=share).values
        ax.plot(
            level,
            factor * np.where(np.isfinite(curve), curve, np.nan),
            color="black",
            linestyle=dashes,
            linewidth=1.5,
            label=f"{100 * share:g} % fractile",
            zorder=3,
        )
    if limit is not None:
        ax.axhline(factor * limit, color="#c8102e", linestyle=":", linewidth=1.2, label="limit")
    fit_x_axis(ax, level)
    ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
    ax.set_xlabel(_level_label(demands, symbol))
    ax.set_ylabel(label)
    add_legend(ax)
    return ax


@finished
def fragility_curves(
    fragility: xr.Dataset, ax: Axes | None = None, *, title: str | None = None
) -> Axes:
    """Draw a fragility curve, its confidence band, and the shares of the records as marks.

    The legend contains the median θ and the dispersion β. If too few records begin to exceed the
    limit within the levels of shaking, the interval of a curve is unbounded. Such a curve has no
    band, and the legend states this. If the records do not determine a curve, only the marks are
    drawn, and the legend states which levels are needed.

    Parameters
    ----------
    fragility
        Dataset of `fragility` for one rig, for several values of one parameter, or for a few rigs.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If ``fragility`` is not a dataset of `fragility`, or has more curves than can be
        distinguished.
    """
    if not isinstance(fragility, xr.Dataset) or "fitted_probability" not in fragility:
        raise InputError(
            "fragility: this dataset has no fragility curve; pass the result of the function "
            "fragility"
        )
    from scipy.special import ndtr, ndtri

    others = [str(dim) for dim in fragility["median_capacity"].dims]
    if len(others) > 1 or fragility["median_capacity"].size > len(CURVES):
        raise InputError(
            f"fragility: the dataset has {fragility['median_capacity'].size} curves over "
            f"{', '.join(others)}; select at most {len(CURVES)} curves over one dimension, such as "
            f"fragility.isel({others[0]}={'0' if len(others) > 1 else f'slice({len(CURVES)})'})"
        )
    ax = axes_or_new(ax, (5.6, 4.0), title)
    unit, symbol = _level_unit(fragility)
    level = unit * fragility["scale"].values
    fine = np.geomspace(level[0], level[-1], 400)
    every = (
        [(None, fragility)]
        if not others
        else [(one, fragility.sel({others[0]: one})) for one in fragility[others[0]].values]
    )
    for (name, one), look in zip(every, CURVES, strict=False):
        median, spread = unit * float(one["median_capacity"]), float(one["dispersion"])
        shares = one["probability"].values
        whole = _value(fragility, others[0], name) if name is not None else None
        marks = look.marks() | {"clip_on": False, "zorder": 4}
        if np.isnan(median):
            reason = f"no curve, {lacking(shares)} needed"
            ax.plot(level, shares, label=f"{whole or 'share of the records'}: {reason}", **marks)
            continue
        words = f"$\\theta$ = {median:.3g} {symbol}".rstrip() + f", $\\beta$ = {spread:.2g}"
        if whole is not None:
            words = f"{whole}: {words}"
        bounded = not np.isinf(one["median_capacity_bound"].values).any()
        if not bounded:
            words += " (no band: too few records reach the limit within the scales)"
        fitted = ndtr((np.log(fine) - np.log(median)) / spread)
        ax.plot(fine, fitted, label=words, zorder=3, **look.line)
        if bounded:
            # Between the levels along straight lines of probit paper, on which the curve is one.
            bounds = one["fitted_probability_bound"].transpose("bound", "scale").values
            probits = np.clip(ndtri(bounds), -_BEYOND, _BEYOND)
            lower, upper = (ndtr(np.interp(np.log(fine), np.log(level), z)) for z in probits)
            sure = 100.0 * json.loads(fragility.attrs["parameters"])["confidence"]
            band = f"its {sure:g} % band" if name is None else None
            ax.fill_between(
                fine,
                lower,
                upper,
                color=look.colour,
                alpha=0.15,
                linewidth=0.0,
                label=band,
                zorder=1,
            )
        ax.plot(level, shares, label="share of the records" if whole is None else None, **marks)
    fit_x_axis(ax, level)
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlabel(_level_label(fragility, symbol))
    ax.set_ylabel(f"probability of {_exceedance(fragility)} (–)")
    add_legend(ax, columns=1 if others else 4)
    return ax


_BEYOND = 38.0
"""Probit of shares that are 0 or 1 to all digits."""


def _one_rig(values: xr.DataArray, what: str) -> None:
    others = [str(dim) for dim in values.dims if dim not in ("record", "scale")]
    if others:
        raise InputError(
            f"{what}: the dataset has several rigs, over {', '.join(others)}; select one of them, "
            f"such as {what}.isel({', '.join(f'{dim}=0' for dim in others)})"
        )
    if values.sizes["scale"] < 2:
        raise InputError(f"{what}: it has one scale; call demands with at least two scales")


def _value(data: xr.Dataset, dim: str, value: object) -> str:
    """Return the text in a legend for a value of a varied parameter."""
    if data[dim].attrs.get("units") == "m":
        return f"{dim.replace('_', ' ')} {1e3 * to_si(value, LENGTH, dim):.4g} mm"
    unit = data[dim].attrs.get("units", "1")
    number = value if isinstance(value, str) else f"{value:.4g}"
    return f"{dim.replace('_', ' ')} {number}{'' if unit == '1' else f' {unit}'}"


def _exceedance(fragility: xr.Dataset) -> str:
    """Return which limit of which quantity is exceeded."""
    about = json.loads(fragility.attrs["parameters"])
    quantity, limit = str(about["quantity"]), float(about["limit"])
    if quantity in _LABELS:
        factor, label = _LABELS[quantity]
        name, unit = label[:-1].rsplit(" (", 1)
        if unitless():
            factor, unit = 1.0, ""
    else:
        source = quantity.partition(".")[0]
        variable = VARIABLES.get(source)
        factor, unit = 1.0, variable.units if variable else ""
        name = of_part(variable.long_name if variable else source.replace("_", " "), quantity)
    return f"{name} > {factor * limit:.4g} {'' if unit == '1' else unit}".rstrip()


def _plain_label(data: xr.Dataset, quantity: str) -> str:
    about = data[quantity if quantity in data else quantity.partition(".")[0]].attrs
    unit = "–" if about["units"] == "1" else about["units"]
    return f"{of_part(about['long_name'], quantity)} ({unit})"


def _level_unit(data: xr.Dataset) -> tuple[float, str]:
    """Return factor and unit of the levels: accelerations are drawn as multiples of gravity."""
    if unitless() or data["scale"].attrs["units"] == "1":
        return 1.0, ""
    return 1.0 / GRAVITY, "g"


def _level_label(data: xr.Dataset, symbol: str) -> str:
    return f"{data['scale'].attrs['long_name']} ({symbol or '–'})"
