"""Figures of a fit: residuals, likelihood profiles of the parameters, and time histories."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import scipy
import xarray as xr
from matplotlib.ticker import MaxNLocator

from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.errors import InputError, alternatives
from vibroimpact.figures.figure_dimensions import columns_that_fit
from vibroimpact.figures.finish import finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.notebook import Panels, new_axes
from vibroimpact.figures.style import EDGE, SHADE, panels
from vibroimpact.model.names import literal
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.model.written_units import unitless

_LOOKS = {"forward": ("o", "#c8102e"), "backward": ("s", "#1f4fbf"), "": (".", "black")}
_COLUMNS = 3
_UNITS = {"m": (1e3, "mm"), "m s-1": (1.0, "m/s"), "m s-2": (1.0, "m/s²"), "1": (1.0, "–")}


@finished
def fit_residuals(result: xr.Dataset, axes: Any = None, *, title: str | None = None) -> Panels:
    """Draw the residuals of a fit for each test, over frequency or time, in standard deviations.

    Open marks are residuals of displacements, and filled marks are residuals of accelerations. The
    band is two standard deviations wide to either side.

    Parameters
    ----------
    result
        Dataset of `vibroimpact.identify`.
    axes
        Axes to draw on, one per test. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset is not a fit, or if the number of axes is wrong.
    """
    _check(result)
    tests = [str(t) for t in result["test"].values]
    panel_axes = panels(
        axes, len(tests), "one panel per test", (7.2, 0.4 + 2.6 * len(tests)), title
    )
    for ax, test in zip(panel_axes, tests, strict=True):
        mine = result.isel(point=np.flatnonzero(result["point_test"].values == test))
        size = float(result["noise"].sel(test=test)) or 1.0
        curves = str(result["test_kind"].sel(test=test).values) == "curves"
        turn = math.tau if curves and unitless() else 1.0  # ω instead of f
        ax.axhspan(-2.0, 2.0, color=SHADE, zorder=0)
        ax.axhline(0.0, color=EDGE, linewidth=0.8, zorder=1)
        for key in dict.fromkeys(zip(mine["point_direction"].values, mine["point_variable"].values,
                                     strict=True)):  # fmt: skip
            direction, variable = (str(part) for part in key)
            here = (mine["point_direction"].values == direction) & (
                mine["point_variable"].values == variable
            )
            mark, colour = _LOOKS[direction]
            full = variable.startswith(("acceleration", "eta_a"))
            named = VARIABLES[variable].long_name
            ax.plot(
                turn * mine["point_place"].values[here],
                mine["fit_residual"].values[here] / size,
                linestyle="none",
                marker=mark,
                markersize=4.0 if full else 5.5,
                markerfacecolor=colour if full or not direction else "none",
                markeredgecolor=colour,
                label=f"{named}, {direction}" if direction else named,
                zorder=3,
            )
        ax.set_xlabel("excitation frequency $f$ (Hz)" if curves else "time $t$ (s)")
        ax.set_ylabel(f"{literal(test)}\nresidual / noise (–)")
    add_legend(panel_axes[0], columns=2)
    return panel_axes


@finished
def fit_profiles(result: xr.Dataset, *, title: str | None = None) -> Panels:
    """Draw the likelihood profile of each parameter of a fit.

    A profile shows how the deviance increases if one parameter is fixed at another value and all
    other parameters are fitted again.

    The dotted line is the increase at the ends of the confidence interval. The grey range is the
    confidence interval.

    Parameters
    ----------
    result
        Dataset of `vibroimpact.identify` with profiles.
    title
        Title of the figure.

    Raises
    ------
    InputError
        If the dataset is not a fit, or if it has no profiles.
    """
    _check(result)
    if "profile_rise" not in result:
        raise InputError(
            "result: this fit has no profiles; pass the result of identify with profiles=True"
        )
    keys = [str(key) for key in result["parameter"].values]
    columns = columns_that_fit(min(_COLUMNS, len(keys)))
    rows = -(-len(keys) // columns)
    made = new_axes(rows, columns, (2.9 * columns, 0.3 + 2.5 * rows))
    limit = float(scipy.special.chdtri(1, 1.0 - float(result.attrs["confidence"])))
    for ax in made.ravel()[len(keys) :]:
        ax.set_axis_off()
    for ax, key in zip(made.ravel(), keys, strict=False):
        one = result.sel(parameter=key)
        bare = key.partition("[")[0]
        quantity = PARAMETERS[bare].quantity if bare in PARAMETERS else None
        value = one["profile_value"].values
        unit = quantity.unit(float(one["fitted_value"])) if quantity else None
        factor = unit.size if unit else 1.0
        low, high = one["interval"].values / factor
        ax.axvspan(low, high, color=SHADE, zorder=0)
        ax.axhline(limit, color="black", linestyle=":", linewidth=0.9)
        shown = np.isfinite(value) & (one["profile_rise"].values < 3.0 * limit)
        x, y = value[shown], one["profile_rise"].values[shown]
        # The root of the rise is nearly straight to both sides of the fit.
        root = np.sign(x - float(one["fitted_value"])) * np.sqrt(y)
        fine = np.linspace(x[0], x[-1], 200)
        ax.plot(fine / factor, np.interp(fine, x, root) ** 2, color="black", linewidth=1.0)
        ax.plot(x / factor, y, "ko", markersize=3.5)
        ax.xaxis.set_major_locator(MaxNLocator(4))
        ax.ticklabel_format(axis="x", useOffset=False)
        ax.set_xlabel(f"{key.replace('_', ' ')} ({unit.symbol if unit and unit.symbol else '–'})")
        ax.set_ylim(-0.1, 2.2 * limit)
    for row in made:
        row[0].set_ylabel("increase of\nthe deviance (–)")
    if title:
        made[0, 0].figure.suptitle(title)
    return Panels(made.ravel()[: len(keys)])


@finished
def fit_history(
    result: xr.Dataset, test: str | None = None, axes: Any = None, *, title: str | None = None
) -> Panels:
    """Draw a measured time history as dots, and the fitted motion as a line.

    Parameters
    ----------
    result
        Dataset of `vibroimpact.identify`.
    test
        Name of the test. Default: the first test with a time history.
    axes
        Axes to draw on, one per measured channel. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset is not a fit, or if it does not contain the time history.
    """
    _check(result)
    histories = [str(t) for t, k in zip(result["test"].values, result["test_kind"].values,
                                        strict=True) if k == "history"]  # fmt: skip
    if not histories:
        raise InputError(
            "test: this fit has no time history; pass the result of identify with at least one"
        )
    name = test if test is not None else histories[0]
    if name not in histories:
        raise InputError(
            f"test: {test!r} is not a time history of this fit; use "
            f"{alternatives(map(repr, histories))}"
        )
    mine = result.isel(point=np.flatnonzero(result["point_test"].values == name))
    variables = list(dict.fromkeys(str(v) for v in mine["point_variable"].values))
    panel_axes = panels(axes, len(variables), "one panel per channel",
                   (7.2, 0.4 + 2.4 * len(variables)), title)  # fmt: skip
    for ax, variable in zip(panel_axes, variables, strict=True):
        here = mine["point_variable"].values == variable
        factor, unit = _UNITS[VARIABLES[variable].units]
        factor = in_unit(factor)
        at = mine["point_place"].values[here]
        ax.plot(at, factor * mine["measured_value"].values[here], "k.", markersize=2.5,
                label="measured", zorder=2)  # fmt: skip
        ax.plot(at, factor * mine["modelled_value"].values[here], color="#c05a00", linewidth=1.0,
                label="fitted", zorder=3)  # fmt: skip
        ax.set_ylabel(f"{VARIABLES[variable].long_name}\n({unit})")
    panel_axes[-1].set_xlabel("time $t$ (s)")
    add_legend(panel_axes[0], columns=2)
    return panel_axes


def _check(result: xr.Dataset) -> None:
    if "fit_residual" not in result:
        raise InputError("result: this is not a fit; pass the result of identify")
