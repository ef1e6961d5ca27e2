"""Width, height and font size of new figures."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple

from matplotlib import rc_context

from vibroimpact.errors import InputError
from vibroimpact.model import to_si
from vibroimpact.model.quantities import LENGTH

INCH = 0.0254
"""Metres per inch."""
_LEAST, _MOST = 0.03, 1.5
"""Limits of width and height (m). A number beyond them is in another unit."""
_FONTS = 3.0, 72.0
"""Limits of the font size (points)."""
_PANEL = 2.2
"""Smallest width of panels that stand side by side, in inches."""


class _Size(NamedTuple):
    """Size in inches."""

    width: float
    height: float | None


_CHOSEN: ContextVar[_Size | None] = ContextVar("figure_size", default=None)


@contextmanager
def figure_size(
    width: float | str, height: float | str | None = None, *, font_size: float = 8.0
) -> Iterator[None]:
    """Set the size of the figures that are made in a ``with`` block, such as the width of a column.

    Legends have as many columns as fit the width, labels are broken into lines, and panels that do
    not fit side by side are arranged below each other. The block does not affect figures whose axes
    you pass: they have the size and the fonts that you set.

    Parameters
    ----------
    width
        Width in m, or a string with a unit, such as ``"86 mm"`` or ``"3.4 in"``.
    height
        Height, in the same form. Default: the height shrinks with the square root of the width,
        because text does not shrink with the figure.
    font_size
        Font size of the axis labels in points. Legends and notes are a sixth smaller.

    Raises
    ------
    InputError
        If width, height or font size is invalid.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> from vibroimpact.figures import figure_size, resonance_curves
    >>> curves = vi.sweep("B2-G1-A3", [1.0, 2.0, 3.0])
    >>> with figure_size("86 mm"):
    ...     axes = resonance_curves(curves)
    >>> round(25.4 * axes[0].figure.get_figwidth(), 6)
    86.0
    """
    chosen = _Size(inches(width, "width"), None if height is None else inches(height, "height"))
    least, most = _FONTS
    if not least <= font_size <= most:
        raise InputError(f"font_size: {font_size!r}; pass a size from {least:g} to {most:g} points")
    before = _CHOSEN.set(chosen)
    try:
        with rc_context({"font.size": font_size}):
            yield
    finally:
        _CHOSEN.reset(before)


def inches(value: float | str, name: str) -> float:
    """Read a width or a height, and return it in inches.

    Raises
    ------
    InputError
        If the value is not a length, or not a size that a figure can have.
    """
    metres = to_si(value, LENGTH, name, above=0.0)
    if not _LEAST <= metres <= _MOST:
        raise InputError(
            f"{name}: {metres:g} m; pass a length from {1e3 * _LEAST:g} mm to {_MOST:g} m, "
            'such as "86 mm"'
        )
    return metres / INCH


def size_of_new(size: tuple[float, float]) -> tuple[float, float]:
    """Return the size of a new figure in inches: as set by `figure_size`, or the default size."""
    chosen = _CHOSEN.get()
    if chosen is None:
        return size
    usual, high = size
    return chosen.width, chosen.height or high * (chosen.width / usual) ** 0.5


def is_print() -> bool:
    """Return whether `figure_size` sets the size of new figures."""
    return _CHOSEN.get() is not None


def columns_that_fit(count: int) -> int:
    """Return how many of several panels fit side by side in a new figure."""
    chosen = _CHOSEN.get()
    return count if chosen is None else max(1, min(count, int(chosen.width / _PANEL)))
