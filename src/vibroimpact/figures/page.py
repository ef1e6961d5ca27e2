"""The composite page of motions: frequencies as columns, as in the paper's Figs. 8 and 16."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import xarray as xr
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.figures.history import PANELS, history_legend, history_panel
from vibroimpact.figures.lines import spectrum_lines
from vibroimpact.figures.motions import check_cycles, named, shown
from vibroimpact.figures.portrait import phase_portrait
from vibroimpact.response.spectrum import spectrum

_WIDTH, _HEIGHT = 4.4, 2.5  # inches, of a panel


def motion_page(
    columns: Mapping[str, xr.Dataset | Mapping[str, xr.Dataset]],
    *,
    cycles: float = 2.0,
    highest: float = 12.0,
    title: str | None = None,
) -> NDArray[Any]:
    """Draw motions on one page: portrait, spectrum, and histories of u, ü + A_t and u̇.

    Parameters
    ----------
    columns
        By heading, such as a frequency: a dataset of `steady` or `simulate`, or several by
        name that share the column; forward is red, backward blue.
    cycles
        Forcing cycles of the time histories.
    highest
        Highest order of the spectra, which are those of absolute acceleration.
    title
        Title of the page.

    Returns
    -------
    ndarray of Axes, shape (5, column)
        Each row shares its vertical scale; ``[0, 0].figure`` is the figure.

    Raises
    ------
    InputError
        If there is no column, or a dataset is not that of a motion with samples.
    """
    if isinstance(columns, xr.Dataset) or not columns:
        raise InputError("columns: at least one motion by its heading is accepted")
    check_cycles(cycles)
    count = len(columns)
    figure = Figure(figsize=(max(_WIDTH * count, 6.4), _HEIGHT * 5 + 1.6), layout="constrained")
    made: NDArray[Any] = figure.subplots(
        5, count, squeeze=False, sharey="row", height_ratios=[1.5, 1, 1, 1, 1]
    )
    handles: dict[object, Artist] = {}
    for axes, (heading, motions) in zip(made.T, columns.items(), strict=True):
        given = named(motions)
        phase_portrait(given, axes[0])
        # A motion that was given up may be too short for a spectrum.
        long = {name: motion for name, motion in given.items() if motion["cycle"][-1] >= 1.0}
        lines = {name: spectrum(motion, highest) for name, motion in long.items()}
        if lines:
            spectrum_lines(lines, axes[1], highest=highest)
        curves = shown(given, cycles)
        for ax, panel in zip(axes[2:], PANELS, strict=True):
            history_panel(ax, curves, panel)
        axes[4].set_xlabel("time in forcing cycles $t/T$ (–)")
        for handle in history_legend(curves):
            handles.setdefault(handle.get_label(), handle)
        for ax in axes:
            if (legend := ax.get_legend()) is not None:
                legend.remove()
        axes[0].set_title(heading, fontsize="medium", pad=8)
    for ax in made[:, 1:].flat:
        ax.set_ylabel("")
    if title:
        figure.suptitle(title)
    figure.legend(
        handles=list(handles.values()),
        loc="outside lower center",
        ncols=min(len(handles), 2 + 2 * count),
        frameon=False,
        fontsize="small",
    )
    return made
