"""A page of motions with one column per frequency, as in the paper's Figs. 8 and 16."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from vibroimpact.errors import InputError
from vibroimpact.figures.figure_dimensions import is_print
from vibroimpact.figures.finish import finished
from vibroimpact.figures.history import PANELS, history_legend, history_panel, panels_of
from vibroimpact.figures.legends import add_legend, fit_labels
from vibroimpact.figures.lines import spectrum_lines
from vibroimpact.figures.motion_style import (
    DrawnMotion,
    cycles_label,
    cycles_shown,
    drawn_motions,
    named,
)
from vibroimpact.figures.notebook import Grid, new_axes
from vibroimpact.figures.portrait import SECTION, phase_portrait
from vibroimpact.response.spectrum import fourier_spectrum

ROWS = 2 + len(PANELS)


class _Paper(NamedTuple):
    """An A4 page within its margins, and the font size for a number of columns."""

    columns: int
    """Largest number of columns."""
    width: float
    """Width in inches."""
    height: float
    text: float
    """Font size in points."""


_PAPERS = (
    _Paper(1, 7.2, 10.8, 9.0),
    _Paper(2, 7.4, 10.8, 8.0),
    _Paper(4, 10.8, 7.4, 6.0),
    _Paper(100, 10.8, 7.4, 5.5),
)


@finished
def motion_page(
    columns: Mapping[str, xr.Dataset | Mapping[str, xr.Dataset]],
    axes: Any = None,
    *,
    cycles: float | None = None,
    highest: float = 12.0,
    title: str | None = None,
) -> Grid:
    """Draw motions on one page: phase portrait, spectrum, and time histories of u, ü + A_t and u̇.

    Each column lists the types of its motions below its heading.

    Parameters
    ----------
    columns
        Columns of the page, as a mapping from headings, such as a frequency, to datasets of
        `steady` or `simulate`. To draw several motions in one column, pass a mapping from names to
        datasets. If a name contains "forward", the curve is red. If it contains "backward", the
        curve is blue.
    axes
        Array of Axes to draw on, of shape (5, number of columns). Default: a new figure that fits
        an A4 page, in portrait format for up to two columns and in landscape format for more.
    cycles
        Number of forcing cycles in the time histories. Default: two, or more cycles so that whole
        periods of the motions in the column are drawn.
    highest
        Highest order of the spectra. They are the spectra of the absolute acceleration.
    title
        Title of the page, if a new figure is made.

    Returns
    -------
    ndarray of Axes, shape (5, column)
        In a new figure, the panels of a row share their vertical scale. ``[0, 0].figure`` is the
        figure.

    Raises
    ------
    InputError
        If there is no column, if a dataset does not hold a motion with samples, or if there are not
        five axes per column.
    """
    if isinstance(columns, xr.Dataset) or not columns:
        what = "a dataset without a heading" if isinstance(columns, xr.Dataset) else "empty"
        raise InputError(
            f"columns: {what}; pass a mapping from headings to motions with at least one entry, "
            'such as {"2 Hz": motion}'
        )
    count = len(columns)
    if axes is not None:
        made = np.asarray(axes, dtype=object)
        if made.size != ROWS * count:
            raise InputError(
                f"axes: {made.size} Axes; pass {ROWS * count}, {ROWS} for each of the "
                f"{count} columns"
            )
        grid = made.reshape(ROWS, count).view(Grid)
        handles = _columns(grid, columns, cycles, highest)
        add_legend(grid[-1, 0], handles, columns=3, place="below")
        return grid
    paper = next(paper for paper in _PAPERS if count <= paper.columns)
    with rc_context({} if is_print() else {"font.size": paper.text}):
        grid = new_axes(
            ROWS,
            count,
            (paper.width, paper.height),
            sharey="row",
            height_ratios=[1.5, 1, 1, 1, 1],
        )
        handles = _columns(grid, columns, cycles, highest)
        figure = grid[0, 0].figure
        for column in grid.T:
            for ax in column[2:-1]:
                ax.tick_params(labelbottom=False)
        for ax in grid[:, 1:].flat:
            ax.set_ylabel("")
        if title:
            figure.suptitle(title)
        add_legend(
            figure, handles, columns=4 if count < 3 else 2 + 2 * min(count, 3), fontsize="medium"
        )
        fit_labels(*grid.flat)
    return grid


def _columns(
    grid: Grid,
    columns: Mapping[str, xr.Dataset | Mapping[str, xr.Dataset]],
    cycles: float | None,
    highest: float,
) -> list[Artist]:
    """Draw each column, and return the entries of the legend."""
    handles: dict[object, Artist] = {}
    for axes, (heading, motions) in zip(grid.T, columns.items(), strict=True):
        by_name = named(motions)
        curves = _column(axes, by_name, cycles, highest)
        axes[0].set_title("\n".join([heading, *_kinds(by_name, heading)]), fontsize="medium", pad=8)
        drawn = zip(*axes[0].get_legend_handles_labels(), strict=True)
        section = [handle for handle, label in drawn if label == SECTION]
        for handle in [*history_legend(curves), *section]:
            handles.setdefault(handle.get_label(), handle)
    return list(handles.values())


def _column(
    axes: Any, motions: dict[str, xr.Dataset], cycles: float | None, highest: float
) -> list[DrawnMotion]:
    length = cycles_shown(motions, cycles, 2)
    phase_portrait(motions, axes[0])
    # A motion that was given up may be too short for a spectrum.
    long = {name: motion for name, motion in motions.items() if motion["cycle"][-1] >= 1.0}
    lines = {name: fourier_spectrum(motion, highest) for name, motion in long.items()}
    if lines:
        spectrum_lines(lines, axes[1], highest=highest)
    curves = drawn_motions(motions, length)
    panels: list[Axes] = list(axes[2:])
    for ax, panel in zip(panels, panels_of(motions), strict=True):
        history_panel(ax, curves, panel)
    panels[-1].set_xlabel(cycles_label(motions))
    for ax in axes:
        if (legend := ax.get_legend()) is not None:
            legend.remove()
    return curves


def _kinds(motions: dict[str, xr.Dataset], heading: str) -> list[str]:
    """Return a line for each motion with a known type, with its name unless the heading has it."""
    lines = []
    for name, motion in motions.items():
        if "period" not in motion:
            continue
        period = int(motion["period"])
        kind = f"period {period}" if period else str(motion["motion"].item())
        lines.append(kind if name == "motion" or name in heading else f"{name}: {kind}")
    return lines
