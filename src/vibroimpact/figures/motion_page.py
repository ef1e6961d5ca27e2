"""The composite page of motions: frequencies as columns, as in the paper's Figs. 8 and 16."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from vibroimpact.errors import InputError
from vibroimpact.figures.history import PANELS, history_legend, history_panel
from vibroimpact.figures.lines import spectrum_lines
from vibroimpact.figures.motion_style import Shown, cycles_shown, named, shown
from vibroimpact.figures.notebook import Grid, new_axes
from vibroimpact.figures.portrait import phase_portrait
from vibroimpact.response.spectrum import fourier_spectrum

ROWS = 2 + len(PANELS)


class _Paper(NamedTuple):
    """An A4 page within its margins, and the text that fits so many columns."""

    columns: int
    """At most."""
    width: float
    """inches."""
    height: float
    text: float
    """Size in points."""


_PAPERS = (
    _Paper(1, 7.2, 10.8, 9.0),
    _Paper(2, 7.4, 10.8, 8.0),
    _Paper(4, 10.8, 7.4, 6.0),
    _Paper(100, 10.8, 7.4, 5.5),
)


def motion_page(
    columns: Mapping[str, xr.Dataset | Mapping[str, xr.Dataset]],
    axes: Any = None,
    *,
    cycles: float | None = None,
    highest: float = 12.0,
    title: str | None = None,
) -> Grid:
    """Draw motions on one page: portrait, spectrum, and histories of u, ü + A_t and u̇.

    Below its heading, each column lists the types of its motions.

    Parameters
    ----------
    columns
        By heading, such as a frequency: a dataset of `steady` or `simulate`, or several by
        name that share the column; forward is red, backward blue.
    axes
        Axes to draw on, shape (5, column). None makes a new figure, which fits an A4 page: portrait
        up to two columns, landscape with more.
    cycles
        Number of forcing cycles of the time histories. Default: two, or more to complete whole
        periods of the column's motions.
    highest
        Highest order of the spectra, which are those of absolute acceleration.
    title
        Title of the page, if it is a new figure.

    Returns
    -------
    ndarray of Axes, shape (5, column)
        In a new figure each row shares its vertical scale; ``[0, 0].figure`` is the figure.

    Raises
    ------
    InputError
        If there is no column, a dataset is not that of a motion with samples, or there are not five
        axes per column.
    """
    if isinstance(columns, xr.Dataset) or not columns:
        raise InputError("columns: at least one motion by its heading is accepted")
    count = len(columns)
    if axes is not None:
        made = np.asarray(axes, dtype=object)
        if made.size != ROWS * count:
            raise InputError(
                f"axes: {made.size} given; {ROWS * count} are accepted, {ROWS} for each column"
            )
        grid = made.reshape(ROWS, count).view(Grid)
        handles = _columns(grid, columns, cycles, highest)
        grid[-1, 0].legend(
            handles=handles,
            loc="upper left",
            bbox_to_anchor=(0.0, -0.35),
            ncols=3,
            frameon=False,
            fontsize="small",
            borderaxespad=0.0,
        )
        return grid
    paper = next(paper for paper in _PAPERS if count <= paper.columns)
    with rc_context({"font.size": paper.text}):
        grid = new_axes(
            ROWS,
            count,
            (paper.width, paper.height),
            sharey="row",
            height_ratios=[1.5, 1, 1, 1, 1],
        )
        handles = _columns(grid, columns, cycles, highest)
        figure = grid[0, 0].figure
        for ax in figure.axes:
            # Marks are made later, too, with the size of that time if none is set.
            ax.tick_params(labelsize=paper.text)
        for column in grid.T:
            for ax in column[2:-1]:
                ax.tick_params(labelbottom=False)
        for ax in grid[:, 1:].flat:
            ax.set_ylabel("")
        if title:
            figure.suptitle(title)
        figure.legend(
            handles=handles,
            loc="outside lower center",
            ncols=min(len(handles), 2 + 2 * min(count, 3)) if count > 2 else min(len(handles), 4),
            frameon=False,
            fontsize="medium",
        )
    return grid


def _columns(
    grid: Grid,
    columns: Mapping[str, xr.Dataset | Mapping[str, xr.Dataset]],
    cycles: float | None,
    highest: float,
) -> list[Artist]:
    """Draw each column; return what the legend explains."""
    handles: dict[object, Artist] = {}
    for axes, (heading, motions) in zip(grid.T, columns.items(), strict=True):
        given = named(motions)
        curves = _column(axes, given, cycles, highest)
        axes[0].set_title("\n".join([heading, *_kinds(given, heading)]), fontsize="medium", pad=8)
        for handle in history_legend(curves):
            handles.setdefault(handle.get_label(), handle)
    return list(handles.values())


def _column(
    axes: Any, given: dict[str, xr.Dataset], cycles: float | None, highest: float
) -> list[Shown]:
    length = cycles_shown(given, cycles, 2)
    phase_portrait(given, axes[0])
    # A motion that was given up may be too short for a spectrum.
    long = {name: motion for name, motion in given.items() if motion["cycle"][-1] >= 1.0}
    lines = {name: fourier_spectrum(motion, highest) for name, motion in long.items()}
    if lines:
        spectrum_lines(lines, axes[1], highest=highest)
    curves = shown(given, length)
    panels: list[Axes] = list(axes[2:])
    for ax, panel in zip(panels, PANELS, strict=True):
        history_panel(ax, curves, panel)
    panels[-1].set_xlabel("time in forcing cycles $t/T$ (–)")
    for ax in axes:
        if (legend := ax.get_legend()) is not None:
            legend.remove()
    return curves


def _kinds(given: dict[str, xr.Dataset], heading: str) -> list[str]:
    """A line for each motion whose kind is known, with its name unless the heading has it."""
    lines = []
    for name, motion in given.items():
        if "period" not in motion:
            continue
        period = int(motion["period"])
        kind = f"period {period}" if period else str(motion["motion"].item())
        lines.append(kind if name == "motion" or name in heading else f"{name}: {kind}")
    return lines
