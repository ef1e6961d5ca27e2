"""Basins of attraction in the plane of displacement and velocity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import patheffects
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import Transform
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from vibroimpact.attraction.adaptive_curve import CONTINUES
from vibroimpact.errors import InputError
from vibroimpact.figures.finish import base_label, finished, in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.model.names import literal
from vibroimpact.model.written_units import unit

COLOURS = (
    "#f6e7bd",
    "#233a6b",
    "#dd6b4a",
    "#86c1ae",
    "#6f1d3f",
    "#c3b3e0",
    "#43803c",
    "#eab63c",
)
"""Colours of the motions, in turn. Neighbours differ in brightness, so that they can be
distinguished in grey."""

_SHADE = 0.3
"""How much the colour of a state is darkened if its motion was identified late."""
_LISTED = 10
"""Largest number of motions in the legend. For the others only their number is stated."""
_LOOKED_AT = 200
"""Largest number of points of a motion that are tried as a place of its number."""
_ASIDE = np.array([0.024, 0.024])
_BEHIND, _GIVEN_UP = "0.82", "white"


@finished
def basin_portrait(
    data: xr.Dataset,
    ax: Axes | None = None,
    *,
    manifolds: xr.Dataset | None = None,
    shade: bool = True,
    title: str | None = None,
) -> Axes:
    """Draw basins of attraction as areas, and the section points of each motion with its number.

    The motions of an assembly do not lie in the plane of the initial states. Their numbers stand
    where their basins are widest.

    Parameters
    ----------
    data
        Dataset of `vibroimpact.basins`.
    ax
        Axes to draw on. Default: a new figure.
    manifolds
        Dataset of `vibroimpact.manifolds` for the same rig. Stable curves are drawn solid, and
        unstable curves dashed. Crosses mark the saddles, and dots mark the points where curves
        cross. The legend counts the curves that continue beyond their ends. Default: no curves.
    shade
        Whether the colour of a state is darker if more forcing cycles were required to find out
        to which motion the state leads.
    title
        Title of the figure, if a new one is made.

    Raises
    ------
    InputError
        If ``data`` has no basins, or if ``manifolds`` has no curves.
    """
    if "basin" not in data or data["basin"].ndim != 2:
        raise InputError("data: it has no basins; pass the result of basins")
    ax = axes_or_new(ax, (6.6, 6.4), title)
    up, across = map(str, data["basin"].dims)
    u, v = _factor(across) * data[across].values, _factor(up) * data[up].values
    half = 0.5 * (u[1] - u[0]), 0.5 * (v[1] - v[0])
    ax.imshow(
        _image(data, shade),
        origin="lower",
        aspect="auto",
        extent=(u[0] - half[0], u[-1] + half[0], v[0] - half[1], v[-1] + half[1]),
        interpolation="nearest",
        zorder=1,
    )
    handles: list[Patch | Line2D] = [
        basin_entry(colour_of(number), _label(one))
        for number, one in enumerate(_motions(data)[:_LISTED])
    ]
    more = data.sizes["attractor"] - _LISTED
    if more > 0:
        handles.append(Patch(facecolor="none", label=f"and {more} more"))
    if shade and _lateness(data) is not None:
        red, green, blue = ((1.0 - _SHADE) * part for part in to_rgb(COLOURS[0]))
        handles.append(basin_entry((red, green, blue), "darker: settles later"))
    labels = data["basin"].values
    for code, colour, text in (
        (-1, _GIVEN_UP, "computation stopped"),
        (-2, _BEHIND, "beyond a stop"),
    ):
        if (labels == code).any():
            handles.append(Patch(facecolor=colour, edgecolor="0.4", linewidth=0.5, label=text))
    in_plane = "section_attractor" in data
    if in_plane:
        for number, one in enumerate(_motions(data)):
            _mark(ax, one, number)
    ax.set(
        xlim=(u[0], u[-1]),
        ylim=(v[0], v[-1]),
        xlabel=base_label(_axis(across), [data]),
        ylabel=base_label(_axis(up), [data]),
    )
    if manifolds is not None:
        handles += _curves(ax, manifolds)
    if in_plane:
        _name(ax, _motions(data))
    else:
        _name_basins(ax, labels, u, v)
    add_legend(
        ax,
        handles,
        columns=1 if len(handles) < 4 else 2,
        place="below",
        handlelength=1.6,
        handleheight=1.2,
    )
    return ax


def basin_entry(colour: Any, label: str) -> Patch:
    """Return the legend entry of an area."""
    return Patch(facecolor=colour, edgecolor="black", linewidth=0.5, label=label)


def colour_of(number: int) -> str:
    """Return the colour of a motion."""
    return COLOURS[number % len(COLOURS)]


def _image(data: xr.Dataset, shade: bool) -> NDArray[np.float64]:
    labels = data["basin"].values
    palette = np.array(
        [to_rgb(_BEHIND), to_rgb(_GIVEN_UP)]
        + [to_rgb(colour_of(i)) for i in range(data.sizes["attractor"])]
    )
    image: NDArray[np.float64] = palette[labels + 2]
    if shade and (late := _lateness(data)) is not None:
        image = image * (1.0 - _SHADE * late[..., None])
    return image


def _lateness(data: xr.Dataset) -> NDArray[np.float64] | None:
    """Return how late each state was identified, from 0 to 1, or None if all were at once."""
    cycles = data["capture_cycles"].values
    known = (cycles > 0) & (data["basin"].values >= 0)
    if not known.any():
        return None
    late = np.log1p(np.where(cycles > 0, cycles, 0))
    # The few that are caught first or last set no scale.
    soon, full = np.quantile(late[cycles > 0], [0.02, 0.995])
    if full <= soon:
        return None
    share: NDArray[np.float64] = np.clip((late - soon) / (full - soon), 0.0, 1.0) * known
    return share


def _factor(coordinate: str) -> float:
    """Return the factor of a coordinate of the plane: displacements are drawn in mm."""
    return in_unit(1e3) if coordinate.startswith("displacement") else 1.0


def _axis(coordinate: str) -> str:
    """Return the label of a coordinate, such as ``"velocity"`` or ``"velocity.roof"``."""
    part, _, mass = coordinate.partition(".")
    symbol, units = ("$u$", "mm") if part == "displacement" else ("$\\dot u$", "m/s")
    return f"relative {part} {f'of {literal(mass)}' if mass else symbol} ({units})"


def _motions(data: xr.Dataset) -> list[xr.Dataset]:
    """Return the motions, each with its points if they lie in the plane."""
    every = [data.isel(attractor=number) for number in range(data.sizes["attractor"])]
    if "section_attractor" not in data:
        return every
    points = data["section_attractor"].values
    return [one.isel(point=points == number) for number, one in enumerate(every)]


def _label(one: xr.Dataset) -> str:
    period = int(one["period"])
    what = str(one["motion"].values)
    if period:
        what = f"period {period}"
    size = in_unit(1e3) * float(one["displacement_excursion"].max())
    wide = f"{size:.3g}" if size < 1000.0 else f"{size:.0f}"
    low, high = 100.0 * float(one["share_low"]), 100.0 * float(one["share_high"])
    return (
        f"{int(one['attractor']) + 1}: {what}, "
        f"{'largest ' if one['displacement_excursion'].ndim else ''}excursion {wide}{unit(' mm')}, "
        f"{100.0 * float(one['share']):.1f} % ({low:.1f}–{high:.1f})"
    )


def _mark(ax: Axes, one: xr.Dataset, number: int) -> None:
    """Draw the points of a motion at the section."""
    u, v = in_unit(1e3) * one["section_displacement"].values, one["section_velocity"].values
    if not int(one["period"]):
        ax.plot(u, v, linestyle="", marker=".", markersize=2.6, color="white", zorder=4)
        ax.plot(u, v, linestyle="", marker=".", markersize=1.2, color="black", zorder=5)
    else:
        ax.plot(
            u,
            v,
            linestyle="",
            marker="o",
            markersize=6.0,
            markerfacecolor=colour_of(number),
            markeredgecolor="black",
            markeredgewidth=1.3,
            path_effects=[patheffects.withStroke(linewidth=2.6, foreground="white")],
            zorder=6,
        )


def _curves(ax: Axes, data: xr.Dataset) -> list[Line2D]:
    """Draw stable and unstable curves with a white outline, and their saddles and crossings."""
    if "curve_kind" not in data:
        raise InputError("manifolds: it has no curves; pass the result of manifolds")
    handles = []
    looks = {"stable": ("-", 1.3, "black"), "unstable": ((0, (3, 1.2)), 1.1, "#7a0019")}
    for kind, (dashes, width, colour) in looks.items():
        for number in np.flatnonzero(data["curve_kind"].values == kind):
            mine = data["curve_number"].values == number
            (line,) = ax.plot(
                in_unit(1e3) * data["curve_displacement"].values[mine],
                data["curve_velocity"].values[mine],
                color=colour,
                linestyle=dashes,
                linewidth=width,
                label=f"{kind} manifolds of saddles{_count_continued(data, kind)}",
                path_effects=[patheffects.withStroke(linewidth=width + 1.2, foreground="white")],
                zorder=3,
            )
        if (data["curve_kind"] == kind).any():
            handles.append(line)
    for name, marker, size, label in (
        ("crossing", ".", 3.0, "crossings"),
        ("saddle", "X", 8.0, "saddles"),
    ):
        if data.sizes[name]:
            (line,) = ax.plot(
                in_unit(1e3) * data[f"{name}_displacement"].values,
                data[f"{name}_velocity"].values,
                linestyle="",
                marker=marker,
                markersize=size,
                markerfacecolor="white",
                markeredgecolor="black",
                markeredgewidth=0.5 if name == "crossing" else 1.0,
                label=label,
                zorder=4,
            )
            handles.append(line)
    return handles


def _count_continued(data: xr.Dataset, kind: str) -> str:
    """Count the curves of a kind that continue beyond their ends."""
    ends = data["curve_ended"].values[data["curve_kind"].values == kind]
    count = int(np.isin(ends, CONTINUES).sum())
    return f" ({count} of {len(ends)} continue)" if count else ""


def _name(ax: Axes, motions: list[xr.Dataset]) -> None:
    """Write the number of each motion next to the point with the most room."""
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    places = [
        np.column_stack(
            [
                (in_unit(1e3) * one["section_displacement"].values - left) / (right - left),
                (one["section_velocity"].values - low) / (high - low),
            ]
        )
        for one in motions
    ]
    every = np.vstack([*places, np.empty((0, 2))])
    for number, mine in enumerate(places):
        inside = mine[((mine >= 0.0) & (mine <= 1.0)).all(axis=1)][:_LOOKED_AT]
        if not len(inside):
            continue
        text = inside + _ASIDE  # where the number would stand
        away = np.linalg.norm(text[:, None] - every[None], axis=2).min(axis=1)
        edge = np.minimum(text, 1.0 - text).min(axis=1)
        best = int(np.argmax(np.minimum(away, edge)))
        write_number(ax, number, text[best], ax.transAxes)
        every = np.vstack([every, text[best]])


def _name_basins(
    ax: Axes, labels: NDArray[np.integer], u: NDArray[np.float64], v: NDArray[np.float64]
) -> None:
    """Write the number of each motion where its basin is widest."""
    for number in range(int(labels.max(initial=-1)) + 1):
        inside = np.pad(labels == number, 1)
        if inside.any():
            depth = distance_transform_edt(inside)[1:-1, 1:-1]
            i, j = np.unravel_index(np.argmax(depth), depth.shape)
            write_number(ax, number, (u[j], v[i]), ax.transData)


def write_number(ax: Axes, number: int, at: Sequence[float], transform: Transform) -> None:
    """Write the number of a motion at a place, readable on any colour."""
    made = ax.text(
        float(at[0]),
        float(at[1]),
        str(number + 1),
        transform=transform,
        ha="center",
        va="center",
        fontsize="medium",
        fontweight="bold",
        clip_on=True,
        zorder=7,
    )
    made.set_path_effects([patheffects.withStroke(linewidth=2.4, foreground="white")])
