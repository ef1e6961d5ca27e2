"""Fourier spectra as stems, as in the paper's Figs. 8, 16 and 18."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import Literal

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

from vibroimpact.arguments import check_name
from vibroimpact.datasets.description import motion_parameters
from vibroimpact.errors import InputError
from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.motion_style import axes_or_new, by_name, looks
from vibroimpact.model.written_units import unitless

_LABELS = {
    "displacement": (1e3, "amplitude of $u$ (mm)"),
    "velocity": (1.0, "amplitude of $\\dot u$ (m/s)"),
    "acceleration": (1.0, "amplitude of $\\ddot u + A_t$ (m/s²)"),
}


@finished
def spectrum_lines(
    spectra: xr.Dataset | Mapping[str, xr.Dataset],
    ax: Axes | None = None,
    *,
    quantity: Literal["displacement", "velocity", "acceleration"] = "acceleration",
    highest: float = 12.0,
    title: str | None = None,
) -> Axes:
    """Draw the lines of a Fourier spectrum as stems, over the order and the frequency.

    Parameters
    ----------
    spectra
        Dataset of `fourier_spectrum`. For several spectra, pass a mapping from names to datasets.
        Of an assembly, pass ``spectrum.sel(mass=…)``; `mass_spectra` draws all masses.
    ax
        Axes to draw on. Default: a new figure.
    quantity
        Quantity whose amplitude is drawn: the relative displacement, the relative velocity or the
        absolute acceleration.
    highest
        Highest order that is drawn.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If a dataset does not hold a spectrum, or if the quantity is unknown.
    """
    check_lines(_LABELS, quantity, highest)
    # A dataset is a mapping, too.
    datasets = by_name(spectra, "motion")
    if not datasets:
        raise InputError("spectra: empty; pass at least one result of fourier_spectrum")
    for name, data in datasets.items():
        if not isinstance(data, xr.Dataset) or "order" not in data.coords:
            which = f"{name!r}" if len(datasets) > 1 else "this"
            raise InputError(
                f"spectra: {which} is not a spectrum; pass the result of fourier_spectrum"
            )
        if "mass" in data.dims:
            raise InputError(
                "spectra: it is of an Assembly of several masses; draw it with figures.mass_spectra"
            )
    factor, label = _LABELS[quantity]
    factor = in_unit(factor)
    ax = axes_or_new(ax, (5.6, 3.6), title)
    for i, (data, look) in enumerate(zip(datasets.values(), looks(list(datasets)), strict=True)):
        kept = data["order"].values <= highest
        order = data["order"].values[kept]
        height = factor * data[f"{quantity}_amplitude"].values[kept]
        # Side by side, so that the lines of one do not hide those of the other.
        shift = (i - 0.5 * (len(datasets) - 1)) * min(0.12, 0.8 / len(datasets))
        if nearly_continuous(order, highest):
            ax.plot(order, height, color=look.colour, linewidth=0.8, label=look.label)
            continue
        ax.vlines(order + shift, 0.0, height, color=look.colour, linewidth=1.4)
        ax.plot(
            order + shift,
            height,
            label=look.label,
            **look.marks(empty="white") | {"markersize": 4.0},
        )
    ax.set_xlim(-0.4, highest + 0.4)
    ax.set_xticks(np.arange(0, int(highest) + 1, max(1, int(highest) // 6)))
    ax.autoscale(axis="y")  # together with the axes that share this one's scale
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel(base_label(label, datasets.values()))
    label_orders(ax, ax, list(datasets.values()))
    if len(datasets) > 1:
        ax.legend(loc="upper right", frameon=False, fontsize="small")
    return ax


def check_lines(quantities: Collection[str], quantity: str, highest: float) -> None:
    """Check the quantity and the highest order of a figure of a spectrum.

    Raises
    ------
    InputError
        If one of them is invalid.
    """
    check_name(quantity, quantities, "quantity")
    if not 0.0 < highest < math.inf:
        raise InputError(f"highest: {highest!r}; use a finite order greater than 0")


def nearly_continuous(order: NDArray[np.float64], highest: float) -> bool:
    """Return whether the lines of a spectrum are too close to each other for stems."""
    return len(order) > 30 * highest


def label_orders(below: Axes, above: Axes, data: Sequence[xr.Dataset]) -> None:
    """Label orders below a panel, and frequencies above a panel if all spectra have one."""
    below.set_xlabel("order $f/f_{exc}$ (–)")
    frequencies = {motion_parameters(one)["frequency"] for one in data}
    if len(frequencies) == 1:
        frequency = frequencies.pop() * (math.tau if unitless() else 1.0)
        scale = above.secondary_xaxis(
            "top", functions=(lambda x: x * frequency, lambda x: x / frequency)
        )
        scale.set_xlabel("frequency (Hz)")
