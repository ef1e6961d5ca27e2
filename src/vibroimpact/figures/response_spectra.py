"""Response spectra over the natural period."""

from __future__ import annotations

from typing import Literal

import xarray as xr
from matplotlib.axes import Axes

from vibroimpact.errors import InputError
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.style import LEGEND, also_in_g, fit_x_axis

_LABELS = {
    "spectral_displacement": (1e3, "largest $|u|$ (mm)"),
    "spectral_velocity": (1.0, "largest $|\\dot u|$ (m/s)"),
    "spectral_acceleration": (1.0, "largest absolute acceleration $|\\ddot u + A_t|$ (m/s²)"),
    "pseudo_velocity": (1.0, "pseudo-velocity\n$\\omega\\,\\max |u|$ (m/s)"),
    "pseudo_acceleration": (1.0, "pseudo-acceleration\n$\\omega^2 \\max |u|$ (m/s²)"),
}
_DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))
_COLOURS = ("black", "#c8102e", "#1f4fbf", "#00795c", "#c05a00")
_MOST = len(_DASHES) * len(_COLOURS)


def response_spectra(
    spectrum: xr.Dataset,
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
    """Draw a response spectrum, with one curve per damping ratio and orientation.

    Parameters
    ----------
    spectrum
        Dataset of `response_spectrum` with several natural periods. The period 0 is not drawn.
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
    if quantity not in _LABELS:
        raise InputError(f"quantity: {quantity!r}; one of {', '.join(_LABELS)} is accepted")
    dims = getattr(spectrum, "sizes", {})
    if not isinstance(spectrum, xr.Dataset) or dims.get("natural_period", 0) < 2:
        raise InputError(
            "spectrum: this is not a response spectrum over natural periods; pass the result of "
            "response_spectrum with at least two periods"
        )
    factor, label = _LABELS[quantity]
    others = [dim for dim in ("orientation", "damping_ratio") if dim in dims]
    curves = spectrum[quantity].stack(curve=others) if others else spectrum[quantity]
    every = [curves.isel(curve=i) for i in range(curves.sizes["curve"])] if others else [curves]
    if len(every) > _MOST:
        raise InputError(
            f"spectrum: {len(every)} curves; at most {_MOST} can be distinguished, so select fewer "
            f"values of {' or '.join(others)}"
        )
    ax = axes_or_new(ax, (5.6, 3.6), title)
    dampings = dims.get("damping_ratio", 1)
    for i, curve in enumerate(every):
        shown = curve["natural_period"].values > 0.0
        turned, damped = divmod(i, dampings)
        words = [str(curve["orientation"].values)] if "orientation" in others else []
        words.append(f"$\\zeta$ = {float(curve['damping_ratio']):g}")
        ax.plot(
            curve["natural_period"].values[shown],
            factor * curve.values[shown],
            color=_COLOURS[(turned if "orientation" in others else i) % len(_COLOURS)],
            linestyle=_DASHES[(damped if "orientation" in others else i) % len(_DASHES)],
            linewidth=1.1,
            label=", ".join(words),
        )
    ax.set_xscale("log")
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set_ylim(bottom=0.0)
    periods = spectrum["natural_period"].values
    fit_x_axis(ax, periods[periods > 0.0])
    ax.set_xlabel("natural period (s)")
    ax.set_ylabel(label)
    if "acceleration" in quantity:
        also_in_g(ax)
    ax.grid(True, which="major", linewidth=0.4, color="0.85")
    ax.legend(ncols=2 if "orientation" in others else min(len(every), 5), **LEGEND)
    return ax
