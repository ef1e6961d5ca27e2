"""Figures that a notebook displays when they are returned, without pyplot.

A notebook calls ``_repr_png_`` of the value that a cell returns. Figures that are made here return
their image. So do their axes, alone or together. Axes that a user made with pyplot return nothing,
because pyplot displays them itself.
"""

from __future__ import annotations

import re
import warnings
from io import BytesIO
from typing import Any

import numpy as np
from matplotlib import rc_context, rcParams
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from numpy.typing import NDArray

from vibroimpact.errors import InputWarning, outside
from vibroimpact.figures.figure_dimensions import is_print, size_of_new

_MISSING = re.compile(r"Glyph (\d+) .* missing from font")


EMBEDDED: dict[Any, Any] = {"pdf.fonttype": 42, "ps.fonttype": 42}
"""Embed fonts as TrueType. Journals refuse Type 3, which is the default of matplotlib."""


class NotebookFigure(Figure):
    """A figure that a notebook displays. Its text is set by matplotlib, and never by LaTeX."""

    def __init__(self, *args: Any, **how: Any) -> None:
        super().__init__(*args, **how)
        # Tick labels are made only when the figure is drawn.
        self._text_size: Any = {"font.size": rcParams["font.size"]}
        self.is_print = is_print()

    def draw(self, renderer: Any) -> None:
        """Draw the figure with the font size with which it was made."""
        with rc_context(self._text_size):
            super().draw(renderer)

    def savefig(self, *args: Any, **how: Any) -> None:
        """Write the figure without LaTeX, which lacks some characters of the labels."""
        for text in self.findobj(Text):
            text.set_usetex(False)
        with (
            rc_context({"text.usetex": False, **EMBEDDED}),
            warnings.catch_warnings(record=True) as seen,
        ):
            warnings.simplefilter("always")
            super().savefig(*args, **how)
        missing = [match[1] for one in seen if (match := _MISSING.match(str(one.message)))]
        for one in seen:
            if not _MISSING.match(str(one.message)):
                warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
        if missing:
            signs = "".join(chr(int(code)) for code in dict.fromkeys(missing))
            warnings.warn(
                f"figure: the font lacks the characters {signs}, so boxes are drawn instead; set "
                "font.family in matplotlibrc to a font that has these characters",
                InputWarning,
                stacklevel=outside(),
            )

    def _repr_png_(self) -> bytes:
        picture = BytesIO()
        self.savefig(picture, format="png", dpi=100)
        return picture.getvalue()


class Panel(Axes):
    """Axes of a `NotebookFigure`. A notebook displays the whole figure."""

    def _repr_png_(self) -> bytes | None:
        return _picture(self)


class Panels(tuple[Axes, ...]):
    """Several axes of one figure. ``panels[0].figure`` is the figure."""

    __slots__ = ()

    def _repr_png_(self) -> bytes | None:
        return _picture(self[0])


class Grid(np.ndarray[Any, np.dtype[Any]]):
    """Rows and columns of axes of one figure. ``grid[0, 0].figure`` is the figure."""

    def _repr_png_(self) -> bytes | None:
        return _picture(self.flat[0])


def new_axes(rows: int, columns: int, size: tuple[float, float], **how: Any) -> Grid:
    """Return the axes of a new figure. `how` is passed to `Figure.subplots`."""
    figure = NotebookFigure(figsize=size_of_new(size), layout="constrained")
    made: NDArray[Any] = figure.subplots(
        rows, columns, squeeze=False, subplot_kw={"axes_class": Panel}, **how
    )
    return made.view(Grid)


def _picture(ax: Axes) -> bytes | None:
    figure = ax.get_figure(root=True)
    return figure._repr_png_() if isinstance(figure, NotebookFigure) else None
