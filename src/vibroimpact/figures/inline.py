"""Figures that a notebook shows where they are returned, without pyplot.

A notebook asks what a cell returns for a ``_repr_png_``. Figures that are made here answer with
their picture, and so do their axes, one alone or several together. Axes that a user made with
pyplot answer with nothing: pyplot shows them itself.
"""

from __future__ import annotations

from io import BytesIO
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray


class Drawing(Figure):
    """A figure that a notebook shows."""

    def _repr_png_(self) -> bytes:
        picture = BytesIO()
        self.savefig(picture, format="png", dpi=100)
        return picture.getvalue()


class Panel(Axes):
    """Axes of a `Drawing`, shown with all of it."""

    def _repr_png_(self) -> bytes | None:
        return _picture(self)


class Panels(tuple[Axes, ...]):
    """Several axes of one figure; ``panels[0].figure`` is the figure."""

    __slots__ = ()

    def _repr_png_(self) -> bytes | None:
        return _picture(self[0])


class Grid(np.ndarray[Any, np.dtype[Any]]):
    """Rows and columns of axes of one figure; ``grid[0, 0].figure`` is the figure."""

    def _repr_png_(self) -> bytes | None:
        return _picture(self.flat[0])


def new_axes(rows: int, columns: int, size: tuple[float, float], **how: Any) -> Grid:
    """Axes of a new figure; `how` is passed to `Figure.subplots`."""
    figure = Drawing(figsize=size, layout="constrained")
    made: NDArray[Any] = figure.subplots(
        rows, columns, squeeze=False, subplot_kw={"axes_class": Panel}, **how
    )
    return made.view(Grid)


def _picture(ax: Axes) -> bytes | None:
    figure = ax.get_figure(root=True)
    return figure._repr_png_() if isinstance(figure, Drawing) else None
