"""Numbers on contour lines."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from numpy.typing import NDArray

_Array = NDArray[np.float64]

_SIZE = 8.0
"""Font size (points) for which the lengths below, in inches, are meant."""
_LETTER = 0.072
"""Width of a letter."""
_HEIGHT = 0.14
"""Height of a number, with its white margin."""
_LEFT = 0.06
"""Smallest visible length of a line on either side of its number."""
_APART = 0.24
"""Smallest distance between the middle of a number and another number."""
_CLEAR = 0.14
"""Smallest distance between the middle of a number and a mark."""
_BESIDE = 0.09
"""Smallest distance between the middle of a number and another line. A closer number would hide the
line."""
_ROOM = 0.25
"""Distance from other lines above which a larger distance is not better."""
_BEND = 0.035
"""Largest deviation of a line from its straight number."""
_STEP = 0.02
"""Spacing of the points at which a line is checked."""
_NOWHERE: _Array = np.empty((0, 2))


class _Line(NamedTuple):
    """A contour line, as evenly spaced points in inches."""

    level: float
    at: _Array


def number_lines(
    ax: Axes, levels: Iterable[tuple[float, Sequence[_Array]]], marks: Iterable[Line2D]
) -> None:
    """Write the level on each contour line of a panel whose limits are final.

    A number is written along its line, in a gap of the line, where the line is straight and its
    neighbours are far. It does not cover other numbers, lines or marks. If a line is too short or
    has no room for a number, no number is written. Points of lines are in the units of the axes.
    """
    ax.autoscale_view()  # which matplotlib would put off until it draws
    font = FontProperties(size="small").get_size_in_points()
    # Lengths are in inches at the font size 8.
    size = np.array([ax.bbox.width, ax.bbox.height]) / ax.figure.dpi * _SIZE / font
    to_inches = ax.transData + ax.transAxes.inverted()
    seen = [(mark, size * to_inches.transform(mark.get_xydata())) for mark in marks]
    spots = np.concatenate(
        [*(at if mark.get_linestyle() == "None" else _even(at) for mark, at in seen), _NOWHERE]
    )
    lines = [
        _Line(level, _even(size * to_inches.transform(part)))
        for level, parts in levels
        for part in parts
        if len(part)
    ]
    written = _NOWHERE
    # The shortest has the fewest places, and chooses first.
    for line in sorted(lines, key=lambda one: len(one.at)):
        text = f"{line.level:.6g}"
        others = np.concatenate([*(one.at for one in lines if one is not line), _NOWHERE])
        place = _place(line.at, _LETTER * len(text) + 0.04, size, others, spots, written)
        if place is None:
            continue
        written = np.concatenate([written, place])
        middle = 0.5 * (place[0] + place[-1]) / size
        across, up = place[-1] - place[0]
        steep = np.degrees(np.arctan2(up / size[1], across / size[0]))
        ax.text(
            middle[0],
            middle[1],
            text,
            transform=ax.transAxes,
            # The angle is that in shares of the panel, which stays along the line if the panel's
            # width and height change.
            rotation=(steep + 90.0) % 180.0 - 90.0,
            rotation_mode="anchor",
            transform_rotates_text=True,
            ha="center",
            va="center_baseline",
            fontsize=font,
            color="0.05",
            bbox={"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none"},
            zorder=4,
        )


def _even(at: _Array) -> _Array:
    """Return evenly spaced points of a line."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(at, axis=0).T))])
    even = np.arange(0.0, length[-1], _STEP)
    return np.column_stack([np.interp(even, length, part) for part in at.T])


def _place(
    at: _Array, wide: float, size: _Array, others: _Array, marks: _Array, written: _Array
) -> _Array | None:
    """Return the best place of a number on a line, as points along its middle, or None."""
    half = int(np.ceil(0.5 * wide / _STEP))
    rim = half + int(np.ceil(_LEFT / _STEP))
    back = half + int(np.ceil(_ROOM / _STEP))
    beside, mark, number = (_distances(at, those) for those in (others, marks, written))
    best, points = -np.inf, None
    for k in range(rim, len(at) - rim):
        under = slice(k - half, k + half + 1)
        if mark[under].min() < _CLEAR or number[under].min() < _APART:
            continue
        along = np.linspace(at[k - half], at[k + half], 2 * half + 1)
        bend = float(np.abs(along - at[under]).max())
        if bend > _BEND or np.minimum(along, size - along).min() < 0.6 * _HEIGHT:
            continue
        # Where the line comes back to its number, it counts as another.
        own = np.concatenate([at[: max(k - back, 0)], at[k + back + 1 :]])
        room = min(float(beside[under].min()), float(_distances(own, along).min(initial=np.inf)))
        if room < _BESIDE:
            continue
        # Room counts most, then straightness, then the middle of the line.
        good = min(room, _ROOM) - bend - 0.1 * abs(k / len(at) - 0.5)
        if good > best:
            best, points = good, along
    return points


def _distances(some: _Array, others: _Array) -> _Array:
    """Return the distance of each point from the nearest other point."""
    if not len(others):
        return np.full(len(some), np.inf)
    apart = some[:, None] - others[None]
    least: _Array = np.sqrt((apart**2).sum(axis=-1).min(axis=1))
    return least
