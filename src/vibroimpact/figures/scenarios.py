"""Scenarios over two parameters, as in the paper's Fig. 21."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.figures.branches import axis_unit
from vibroimpact.figures.finish import finished
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.plane import node_edges, plane_axes
from vibroimpact.figures.style import SCENARIOS
from vibroimpact.scenarios.scenario import Scenario


class Mark(NamedTuple):
    """Rigs that are marked on a map of scenarios with the same symbol."""

    label: str
    marker: str
    x: Sequence[float]
    y: Sequence[float]
    face: str = "white"
    """Colour of the inside of the symbol."""


@finished
def scenario_map(
    data: xr.Dataset,
    ax: Axes | None = None,
    *,
    border: xr.Dataset | None = None,
    marks: Sequence[Mark] = (),
    lines: Mapping[str, tuple[Sequence[float], Sequence[float]]] | None = None,
    title: str | None = None,
) -> Axes:
    """Draw a map of scenarios as coloured, hatched and labelled areas.

    Parameters
    ----------
    data
        Dataset of `vibroimpact.scenario_map`.
    ax
        Axes to draw on. Default: a new figure.
    border
        Dataset of ``jump_border`` for the same map: the exact border between rigs with and without
        jumps, which is drawn as a line. Default: no line.
    marks
        Rigs that are marked. Default: none.
    lines
        Further lines, as a mapping from labels to pairs of x values and y values, in the units of
        the map (SI). Default: none.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If the dataset is not a map, or if the border belongs to another map.
    """
    if "scenario" not in data or data["scenario"].ndim != 2:
        raise InputError("data: this is not a map of scenarios; pass the result of scenario_map")
    second, first = (str(name) for name in data["scenario"].dims)
    if border is not None and not {first, second} <= set(border.variables):
        raise InputError(
            f"border: its parameters are not {first} and {second}, which are those of the map; "
            "pass the result of jump_border for this map"
        )
    ax = axes_or_new(ax, (7.2, 6.4), title)
    fx, fy = axis_unit(data[first])[0], axis_unit(data[second])[0]
    edges = [node_edges(data[first]), node_edges(data[second])]
    kinds = data["scenario"].values
    handles: list[Patch | Line2D] = []
    for scenario in Scenario:
        mine = kinds == scenario
        if mine.any():
            handles.append(_area(ax, edges, mine, scenario))
    if (kinds < 0).any():
        handles.append(Patch(facecolor="white", edgecolor="0.6", label="not computed yet"))
    _outlines(ax, edges[0], edges[1], kinds)
    if border is not None and border.sizes["border_point"]:
        order = np.argsort(border[second].values)
        (line,) = ax.plot(
            fx * border[first].values[order],
            fy * border[second].values[order],
            color="black",
            linewidth=1.6,
            linestyle=(0, (5, 1.5)),
            marker=".",
            label="cusps of the folds, where jumps begin (exact)",
            zorder=5,
        )
        handles.append(line)
    for dashes, (label, (px, py)) in zip(
        ("--", ":", "-.", (0, (1, 3))) * 3, (lines or {}).items(), strict=False
    ):
        (line,) = ax.plot(
            fx * np.asarray(px),
            fy * np.asarray(py),
            color="black",
            linewidth=1.1,
            linestyle=dashes,
            label=label,
            zorder=4,
        )
        handles.append(line)
    for mark in marks:
        (line,) = ax.plot(
            fx * np.asarray(mark.x),
            fy * np.asarray(mark.y),
            linestyle="",
            marker=mark.marker,
            markersize=5.5,
            markerfacecolor=mark.face,
            markeredgecolor="black",
            label=mark.label,
            zorder=6,
        )
        if mark.label:
            handles.append(line)
    plane_axes(ax, data[first], data[second])
    add_legend(
        ax,
        handles,
        columns=2,
        place="below",
        columnspacing=1.2,
        handlelength=2.2,
        handleheight=1.2,
    )
    return ax


def _area(
    ax: Axes,
    edges: list[NDArray[np.float64]],
    mine: NDArray[np.bool_],
    scenario: Scenario,
) -> Patch:
    look = SCENARIOS[scenario.label]
    ax.pcolormesh(
        *edges,
        np.ma.masked_where(~mine, mine),
        cmap=ListedColormap([look.colour]),
        zorder=1,
        rasterized=True,
    )
    if look.hatch:
        # Each node twice, close to both its edges: the hatches end where the colours do.
        hatched = ax.contourf(
            *(_doubled(edge) for edge in edges),
            np.kron(mine, np.ones((2, 2))),
            levels=[0.5, 1.5],
            colors="none",
            hatches=[look.hatch],
            zorder=2,
        )
        hatched.set_edgecolor(look.line)
        hatched.set_linewidth(0.0)
    at = _deepest(mine)
    if at is not None:
        row, column = at
        ax.text(
            _middle(edges[0], column),
            _middle(edges[1], row),
            scenario.label,
            ha="center",
            va="center",
            fontsize="medium",
            fontweight="bold",
            color="black",
            bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "linewidth": 0.0},
            zorder=7,
        )
    known = scenario is not Scenario.UNCLASSIFIED
    return look.entry(f"{scenario.label}: {scenario.meaning}" if known else "unclassified")


def _outlines(
    ax: Axes, x: NDArray[np.float64], y: NDArray[np.float64], kinds: NDArray[np.int8]
) -> None:
    """Draw lines between neighbouring nodes of different scenarios."""
    across, along = kinds[:, 1:] != kinds[:, :-1], kinds[1:] != kinds[:-1]
    segments = [[(x[j + 1], y[i]), (x[j + 1], y[i + 1])] for i, j in np.argwhere(across)]
    segments += [[(x[j], y[i + 1]), (x[j + 1], y[i + 1])] for i, j in np.argwhere(along)]
    ax.add_collection(
        LineCollection(segments, color="0.25", linewidth=0.6, zorder=3), autolim=False
    )


def _doubled(edges: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return two positions for each node, just inside its edges."""
    inset = 1e-3 * np.diff(edges)
    places = np.column_stack([edges[:-1] + inset, edges[1:] - inset])
    return places.ravel()


def _deepest(mine: NDArray[np.bool_]) -> tuple[int, int] | None:
    """Return the node farthest from other areas, or None if the area is too narrow."""
    depth = np.zeros(mine.shape, dtype=int)
    left = mine.copy()
    while left.any():
        depth[left] += 1
        framed = np.pad(left, 1)
        left = left & framed[2:, 1:-1] & framed[:-2, 1:-1] & framed[1:-1, 2:] & framed[1:-1, :-2]
    if depth.max() < max(2, min(mine.shape) // 30):
        return None
    at = np.argwhere(depth == depth.max())
    row, column = at[np.argmin(((at - at.mean(axis=0)) ** 2).sum(axis=1))]
    return int(row), int(column)


def _middle(edges: NDArray[np.float64], i: int) -> float:
    return float(0.5 * (edges[i] + edges[i + 1]))
