"""Where the renderer puts the text of a figure, and what is cut off or overlaps."""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox


class Piece(NamedTuple):
    """A text or a legend, and the box of its ink in points."""

    words: str
    kind: str
    box: Bbox


def pieces(figure: Figure) -> list[Piece]:
    """Return all visible texts of a figure, and its legends, each as one piece."""
    figure.draw_without_rendering()
    parts = []
    top = getattr(figure, "_suptitle", None)
    if top is not None:
        parts.append(_piece(top, "title"))
    legends = list(figure.legends)
    panels: list[Axes] = [*figure.axes]
    for ax in figure.axes:
        panels += ax.child_axes
    for ax in panels:
        if ax.get_legend() is not None:
            legends.append(ax.get_legend())
        parts += [
            _piece(one, "title")
            for one in ax.get_children()
            if isinstance(one, Text) and one.get_text() and one not in ax.texts
        ]
        parts += [_piece(text, "note") for text in ax.texts if text.get_text().strip()]
        if ax.axison:
            for axis in (ax.xaxis, ax.yaxis):
                parts += _of_axis(axis)
    for legend in legends:
        words = ", ".join(text.get_text() for text in legend.get_texts())
        parts.append(Piece(words, "legend", _points(legend.get_window_extent(), figure)))
    return parts


def _of_axis(axis: Axis) -> list[Piece]:
    if not axis.get_visible():
        return []
    labels = []
    low, high = sorted(axis.get_view_interval())
    slack = 1e-9 * (high - low)
    for minor in (False, True):
        places = axis.get_ticklocs(minor=minor)
        for place, tick in zip(
            places, axis.get_minor_ticks() if minor else axis.get_major_ticks(), strict=False
        ):
            if low - slack <= place <= high + slack:
                labels += [
                    _piece(label, "tick")
                    for label in (tick.label1, tick.label2)
                    if label.get_visible() and label.get_text().strip()
                ]
    for text, kind in ((axis.label, "label"), (axis.get_offset_text(), "tick")):
        if text.get_visible() and text.get_text().strip():
            labels.append(_piece(text, kind))
    return labels


def _piece(text: Text, kind: str) -> Piece:
    return Piece(text.get_text(), kind, _points(text.get_window_extent(), text.figure))


def _points(box: Bbox, figure: Figure) -> Bbox:
    return Bbox(box.get_points() * 72.0 / figure.get_figure(root=True).dpi)


def problems(figure: Figure, touching: float = 1.0) -> list[str]:
    """Return what is cut off at the edge of a figure, and which texts overlap.

    Parameters
    ----------
    figure
        The figure.
    touching
        Overlap in points that is accepted: the box of a text is larger than its ink.
    """
    every = pieces(figure)
    wide, high = 72.0 * figure.get_size_inches()
    lines = [
        f"cut: {one.kind} {one.words!r} {np.round(one.box.extents, 1).tolist()} of {wide:.0f} x "
        f"{high:.0f}"
        for one in every
        if one.box.x0 < -0.5
        or one.box.y0 < -0.5
        or one.box.x1 > wide + 0.5
        or one.box.y1 > high + 0.5
    ]
    for a, b in combinations(every, 2):
        x = min(a.box.x1, b.box.x1) - max(a.box.x0, b.box.x0)
        y = min(a.box.y1, b.box.y1) - max(a.box.y0, b.box.y0)
        if min(x, y) > touching:
            lines.append(
                f"overlap by {x:.1f} x {y:.1f}: {a.kind} {a.words!r} and {b.kind} {b.words!r}"
            )
    return lines
