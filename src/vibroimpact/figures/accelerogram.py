"""A record over time, with its peak, and its response spectrum."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.errors import InputError
from vibroimpact.figures.finish import acceleration_text, finished
from vibroimpact.figures.notebook import Panels
from vibroimpact.figures.response_spectra import response_spectra
from vibroimpact.figures.style import EDGE, also_in_g, note_peak, panels
from vibroimpact.model import Record
from vibroimpact.model.written_units import unit


@finished
def accelerogram(
    record: Record,
    spectrum: xr.Dataset | None = None,
    axes: Any = None,
    *,
    title: str | None = None,
) -> Panels:
    """Draw a record over time, mark its peak, and draw its response spectrum below.

    Parameters
    ----------
    record
        The record.
    spectrum
        Dataset of `response_spectrum` for the record. If it has no units, neither has the figure.
        Default: the figure has no panel of the spectrum.
    axes
        Axes to draw on, one per panel. Default: a new figure.
    title
        Title of the figure, if a new one is made.

    Returns
    -------
    tuple of Axes
        ``axes[0].figure`` is the figure.

    Raises
    ------
    InputError
        If ``record`` is not a record, or if the number of axes is wrong.
    """
    if not isinstance(record, Record):
        raise InputError(f"record: an object of type {type(record).__name__}; pass a Record")
    count = 1 if spectrum is None else 2
    what = "the record" if spectrum is None else "the record and its spectrum"
    panel_axes = panels(axes, count, what, (7.2, 2.8 * count + 0.4), title, sharex=False)
    ax = panel_axes[0]
    ax.axhline(0.0, color=EDGE, linewidth=0.6, zorder=1)
    ax.plot(record.time, record.acceleration, color="black", linewidth=0.7, zorder=3)
    at = int(np.abs(record.acceleration).argmax())
    peak = float(record.acceleration[at])
    ax.set_xlim(0.0, record.duration)
    words = f"{acceleration_text(peak)} at {record.time[at]:.5g}{unit(' s')}"
    note_peak(ax, record.time[at], peak, words)
    ax.set_xlabel("time (s)")
    ax.set_ylabel("base acceleration\n$A_t$ (m/s²)")
    also_in_g(ax)
    if spectrum is not None:
        response_spectra(spectrum, panel_axes[1])
    return panel_axes
