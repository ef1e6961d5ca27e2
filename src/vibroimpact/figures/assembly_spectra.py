"""Fourier spectra of several masses: one panel for each mass, on logarithmic axes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.figures.assembly_histories import LABELS, Quantity
from vibroimpact.figures.assembly_motion import chosen, label_values, rows_of_panels
from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.lines import check_lines, label_orders, nearly_continuous
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.style import CurveStyle

_RANGE = 1e-4
"""Amplitude at the lower end of the axes, relative to the largest one."""
_LOOK = CurveStyle("", "black", "-", 0.8, "o", 3.0, True)


@finished
def mass_spectra(
    spectrum: xr.Dataset,
    axes: Any = None,
    *,
    quantity: Quantity = "acceleration",
    masses: Sequence[str] | None = None,
    highest: float = 12.0,
    title: str | None = None,
) -> Panels:
    """Draw the Fourier spectrum of each mass of an assembly in a panel of its own.

    The amplitudes have one logarithmic scale. The spectrum of a motion that does not repeat itself
    is a line, that of a periodic motion consists of stems.

    Parameters
    ----------
    spectrum
        Dataset of `fourier_spectrum` for a motion of a rig with an `Assembly`.
    axes
        One Axes per mass. Default: a new figure.
    quantity
        Quantity whose amplitude is drawn, as in `mass_histories`.
    masses
        Names of the masses that are drawn, from the top. Default: all, in the order of the
        assembly.
    highest
        Highest order that is drawn.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    tuple of Axes
        One Axes per mass. ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If the dataset does not hold the spectrum of an assembly, or if a quantity or a mass does
        not exist.
    """
    check_lines(LABELS, quantity, highest)
    if not isinstance(spectrum, xr.Dataset) or not {"order", "mass"} <= set(spectrum.dims):
        raise InputError(
            "spectrum: this is not a spectrum of several masses; pass the result of "
            "fourier_spectrum of a Rig with an Assembly"
        )
    names = chosen(masses, tuple(spectrum["mass"].values.tolist()), "mass", "masses")
    panel_axes = rows_of_panels(axes, names, title)
    factor, label = LABELS[quantity]
    data = spectrum.isel(order=spectrum["order"].values <= highest)
    order = data["order"].values
    heights = in_unit(factor) * data[f"{quantity}_amplitude"].sel(mass=names)
    top = float(np.nanmax(heights.values, initial=0.0)) or 1.0
    for ax, name in zip(panel_axes, names, strict=True):
        _draw(ax, order, heights.sel(mass=name).values, top, nearly_continuous(order, highest))
        ax.set_xlim(-0.4, highest + 0.4)
        ax.set_xticks(np.arange(0, int(highest) + 1, max(1, int(highest) // 6)))
        ax.set_ylim(_RANGE * top, 2.0 * top)
        ax.yaxis.set_major_locator(LogLocator(numticks=6))
    label_values(panel_axes, axes, f"amplitude of {base_label(label, [spectrum])}")
    label_orders(panel_axes[-1], panel_axes[0], [spectrum])
    return panel_axes


def _draw(
    ax: Axes, order: NDArray[np.float64], height: NDArray[np.float64], top: float, line: bool
) -> None:
    """Draw a spectrum as a line or as stems, on a logarithmic axis."""
    ax.set_yscale("log")
    seen = np.where(height > 0.0, height, math.nan)
    if line:
        ax.plot(order, np.where(height > 0.0, height, 1e-3 * _RANGE * top), **_LOOK.line)
        return
    ax.vlines(order, 1e-3 * _RANGE * top, seen, color=_LOOK.colour, linewidth=1.2)
    ax.plot(order, seen, **_LOOK.marks())
