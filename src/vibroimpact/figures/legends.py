"""Legends that fit the width of their panel, and axis labels that fit its sides."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from typing import Any, Literal

import numpy as np
from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.offsetbox import OffsetBox, VPacker
from matplotlib.text import Text
from matplotlib.transforms import Bbox, IdentityTransform

from vibroimpact.figures.notebook import NotebookFigure

Place = Literal["above", "below"]

_STYLE: dict[str, Any] = {
    "frameon": False,
    "fontsize": "small",
    "borderpad": 0.1,
    "borderaxespad": 0.0,
    "columnspacing": 1.6,
    "labelspacing": 0.4,
}
_APART = 3.0
"""Distance between a legend and its panel, in points."""
_FULL = 0.95
"""Share of a side of the panel that a label may cover."""


class FittedLegend(Legend):
    """A legend above or below a panel, in as many columns as fit the width of the panel.

    Columns and position are determined whenever the figure is drawn: they fit after a change of its
    size, too. Labels that are wider than the panel are broken into lines. The legend is never wider
    than the panel with its tick labels and axis labels. Hence a layout engine need not shrink the
    panel for it.
    """

    def __init__(
        self,
        parent: Axes | Figure,
        handles: Sequence[Artist],
        *,
        most: int,
        place: Place,
        apart: float = _APART,
        **style: Any,
    ) -> None:
        self._most, self._place, self._gap = most, place, apart
        labels = [str(handle.get_label()) for handle in handles]
        super().__init__(parent, handles, labels, **{**_STYLE, **style})

    def remove(self) -> None:
        """Remove the legend from its figure."""
        if self.axes is not None:
            self.axes.legend_ = None
        elif isinstance(self.figure, Figure):
            self.figure.legends.remove(self)

    def draw(self, renderer: Any) -> None:
        """Draw the legend where it fits."""
        self._fit(renderer)
        super().draw(renderer)

    def get_window_extent(self, renderer: Any = None) -> Bbox:
        """Return the extent of the legend in pixels."""
        self._fit(renderer)
        return super().get_window_extent(renderer)

    def get_tightbbox(self, renderer: Any = None) -> Bbox | None:
        """Return the extent of the legend in pixels."""
        self._fit(renderer)
        return super().get_tightbbox(renderer)

    def _fit(self, renderer: Any) -> None:
        """Choose columns, lines and, of the legend of a panel, the position."""
        figure = self.get_figure(root=True)
        if figure is None:
            return
        renderer = RendererAgg(1, 1, figure.dpi) if renderer is None else renderer  # type: ignore[no-untyped-call]
        if self.axes is None:
            edge = figure.bbox
            self._arrange(edge.width - 2.0 * self._pixels(_APART), renderer)
            return
        room = _decorated(self.axes, renderer)
        self._arrange(room.width, renderer)
        wide = super().get_window_extent(renderer).width
        middle = 0.5 * (self.axes.bbox.x0 + self.axes.bbox.x1)
        left = max(room.x0, min(middle - 0.5 * wide, room.x1 - wide))
        apart = self._pixels(self._gap)
        corner = room.y1 + apart if self._place == "above" else room.y0 - apart
        anchor = (left, corner, 0.0, 0.0)
        if not np.allclose(anchor, self.get_bbox_to_anchor().bounds, rtol=0.0, atol=1e-3):
            self.set_bbox_to_anchor(anchor, IdentityTransform())

    def _pixels(self, points: float) -> float:
        figure = self.get_figure(root=True)
        return points * (figure.dpi if figure is not None else 72.0) / 72.0

    def _arrange(self, room: float, renderer: Any) -> None:
        """Distribute the entries over as many columns as fit, and break lines that are wider."""
        entries = _entries(self)
        if not entries:
            return
        sep = self._pixels(self.columnspacing * self.prop.get_size_in_points())
        pad = self._pixels(2.0 * self.borderpad * self.prop.get_size_in_points())
        room -= pad
        for text in self.get_texts():
            _set_text(text, _unbroken(text.get_text()))
        widths = [entry.get_bbox(renderer).width for entry in entries]
        count = next(
            (
                n
                for n in range(min(self._most, len(entries)), 1, -1)
                if _width(widths, n, sep) <= room
            ),
            1,
        )
        if count == 1:
            for text, wide in zip(self.get_texts(), widths, strict=True):
                if wide > room:
                    own = text.get_window_extent(renderer).width
                    break_lines(text, room - (wide - own), renderer)
        _distribute(self, entries, count)


def _entries(legend: Legend) -> list[OffsetBox]:
    """Return the entries of a legend in order."""
    return [entry for column in _columns(legend) for entry in column.get_children()]


def _columns(legend: Legend) -> list[Any]:
    """Return the columns of a legend. A change of this list changes the legend."""
    (box,) = (one for one in legend.get_children() if isinstance(one, VPacker))
    _, handles = box.get_children()
    columns: list[Any] = handles.get_children()
    return columns


def _width(widths: Sequence[float], count: int, sep: float) -> float:
    parts = np.array_split(widths, count)
    return float(sum(part.max() for part in parts) + sep * (count - 1))


def _distribute(legend: Legend, entries: Sequence[OffsetBox], count: int) -> None:
    figure, columns = legend.get_figure(root=False), _columns(legend)
    assert figure is not None
    sizes = [len(part) for part in np.array_split(np.arange(len(entries)), count)]
    if [len(column.get_children()) for column in columns] == sizes:
        return
    made, first = [], 0
    for size in sizes:
        column = VPacker(
            pad=0,
            sep=legend.labelspacing * legend.prop.get_size_in_points(),
            align="baseline",
            children=list(entries[first : first + size]),
        )
        column.set_figure(figure)
        made.append(column)
        first += size
    columns[:] = made


def _decorated(ax: Axes, renderer: Any) -> Bbox:
    """Return the extent of a panel with its ticks, labels, title and second scales."""
    boxes = [ax.bbox]
    for panel in (ax, *ax.child_axes):
        for axis in (panel.xaxis, panel.yaxis):
            # Without the ends of a label that is longer than the panel.
            box = axis.get_tightbbox(renderer, for_layout_only=True)
            if box is not None and axis.get_visible():
                boxes.append(box)
    for title in ax.get_children():  # on the left, in the middle or on the right
        if isinstance(title, Text) and title.get_text() and title not in ax.texts:
            box = title.get_window_extent(renderer)
            boxes.append(Bbox.from_extents(ax.bbox.x0, box.y0, ax.bbox.x1, box.y1))
    return Bbox.union([box for box in boxes if np.isfinite(box.get_points()).all()])


def add_legend(
    parent: Axes | Figure,
    handles: Iterable[Any] | None = None,
    *,
    columns: int = 4,
    place: Place = "above",
    **style: Any,
) -> FittedLegend:
    """Add a legend above or below a panel, or below all panels of a figure.

    It has at most so many columns. Default of the entries: all of the panel that have a label.
    """
    if handles is None:
        assert isinstance(parent, Axes)
        handles, labels = parent.get_legend_handles_labels()
        for handle, label in zip(handles, labels, strict=True):
            handle.set_label(label)
    shown = list(handles)
    if isinstance(parent, Axes):
        loc = "lower left" if place == "above" else "upper left"
        made = FittedLegend(parent, shown, most=columns, place=place, loc=loc, **style)
        parent.legend_ = made
    else:
        made = FittedLegend(
            parent, shown, most=columns, place=place, loc="outside lower center", **style
        )
        parent.legends.append(made)
    return made


def fit_labels(*axes: Axes, share: float = _FULL) -> None:
    """Break axis labels and titles that cover more than `share` of their side into lines.

    Call it when the panels and their legends are complete.
    """
    with _as_saved(axes):
        if not any(_length(text, None) > 0.5 * side for ax in axes for text, side in _labels(ax)):
            return
        apply_layout(*axes)
        for ax in axes:
            for text, side in _labels(ax):
                if _length(text, None) > share * side:
                    # The lines of a title say different things.
                    whole = text.get_text()
                    lines = whole.split("\n") if text is ax.title else [_unbroken(whole)]
                    broken = []
                    for line in lines:
                        text.set_text(line)
                        break_lines(text, share * side, None)
                        broken.append(text.get_text())
                    text.set_text("\n".join(broken))


def apply_layout(*axes: Axes) -> None:
    """Give panels the sizes that they have when their figure is drawn."""
    with _as_saved(axes):
        for figure in _figures(axes):
            if (engine := figure.get_layout_engine()) is not None:
                engine.execute(figure)


@contextmanager
def _as_saved(axes: Sequence[Axes]) -> Iterator[None]:
    """Measure texts as `NotebookFigure.savefig` writes them: without LaTeX.

    Characters that the font lacks are reported when the figure is saved.
    """
    drawings = [figure for figure in _figures(axes) if isinstance(figure, NotebookFigure)]
    for figure in drawings:
        for text in figure.findobj(Text):
            text.set_usetex(False)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing from font")
        with rc_context({"text.usetex": False}) if drawings else nullcontext():
            yield


def _figures(axes: Sequence[Axes]) -> set[Figure]:
    return {figure for ax in axes if (figure := ax.get_figure(root=True)) is not None}


def _labels(ax: Axes) -> list[tuple[Text, float]]:
    """Return the axis labels and the title of a panel, and the lengths of their sides in pixels."""
    wide, high = ax.bbox.size
    every = ((ax.xaxis.label, wide), (ax.yaxis.label, high), (ax.title, wide))
    return [(text, float(side)) for text, side in every if text.get_text()]


def break_lines(text: Text, room: float, renderer: Any) -> None:
    """Break a text of one line into the fewest lines, of similar length, that fit the room (px).

    By default, the renderer is that of the figure.
    """
    if _length(text, renderer) <= room:
        return
    words = _words(text.get_text())
    lengths = []
    for word in words:
        text.set_text(word)
        lengths.append(_length(text, renderer))
    text.set_text("n n")
    space = _length(text, renderer)
    text.set_text("nn")
    space -= _length(text, renderer)

    def filled(limit: float) -> list[str]:
        lines: list[str] = []
        left = -1.0
        for word, length in zip(words, lengths, strict=True):
            if length + space <= left:
                lines[-1] += f" {word}"
                left -= length + space
            else:
                lines.append(word)
                left = limit - length
        return lines

    fewest = len(filled(room))
    # The shortest lines of the same number: of similar length.
    limits = np.linspace(0.4 * room, room, 13)
    lines = next(lines for limit in limits if len(lines := filled(float(limit))) <= fewest)
    text.set_text("\n".join(lines))


def _words(text: str) -> list[str]:
    """Return the words of a text. Formulas stay whole, and a unit stays with the last word."""
    words = re.findall(r"(?:\$[^$]*\$|[^\s$])+", text)
    if len(words) > 1 and re.fullmatch(r"\(\S*\)", words[-1]):
        words[-2:] = [f"{words[-2]} {words[-1]}"]
    return words


def _unbroken(text: str) -> str:
    return " ".join(text.split())


def _set_text(text: Text, string: str) -> None:
    if text.get_text() != string:
        text.set_text(string)


def _length(text: Text, renderer: Any) -> float:
    """Return the length of the lines of a text in pixels."""
    extent = text.get_window_extent(renderer)
    return float(max(extent.width, 0.0) if text.get_rotation() % 180.0 == 0.0 else extent.height)
