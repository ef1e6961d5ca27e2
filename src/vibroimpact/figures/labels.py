"""Names that are written next to curves."""

from __future__ import annotations

import itertools
from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from numpy.typing import NDArray

_Array = NDArray[np.float64]

_PLACES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
"""Positions of a name along its curve, as shares of its length, in the order in which they are
tried."""
_APART = np.array([0.16, 0.06])
"""Smallest distance between names, as shares of the width and the height of the panel."""
_CLEAR = np.array([0.08, 0.045])
"""Smallest distance of a name from a mark."""
_ON = 0.01
"""Distance from a name below which a curve is assumed to have this name."""
_STEP = 0.005
"""Spacing of the points at which a curve is checked."""
_BESIDE, _OFF = 4.0, 4.0
"""Distance of a name from its curve, along and across, in points."""
_LETTER = 0.6
"""Width of a letter, as a share of the font size."""


class Names:
    """Writes names next to the curves of a panel with final limits, without overlaps.

    The names do not cover marks.
    """

    def __init__(self, ax: Axes, marks: Iterable[Line2D] = ()) -> None:
        self.ax = ax
        ax.autoscale_view()  # which matplotlib would put off until it draws
        self._to_panel = ax.transData + ax.transAxes.inverted()
        size = FontProperties(size="small").get_size_in_points()
        self._size = size
        self._point = ax.figure.dpi / 72.0 / np.array(ax.bbox.size)
        self._letter = _LETTER * size / 72.0 * ax.figure.dpi / ax.bbox.width
        self._names: list[_Array] = []
        self._marks = [
            spot for line in marks for spot in self._to_panel.transform(line.get_xydata())
        ]

    def write(self, x: _Array, y: _Array, name: str, colour: str, *, once: bool) -> None:
        """Write a name next to a curve, whose points are in the units of the axes.

        If the curve is too short, no name is written. With `once`, no name is written either if the
        curve lies on another curve that has a name.
        """
        known = np.isfinite(x) & np.isfinite(y)
        if not known.any():
            return
        at = self._visible(x[known], y[known])
        if once and any(np.hypot(*(at - spot).T).min(initial=np.inf) < _ON for spot in self._names):
            return
        wide = self._letter * len(name)
        if len(at) * _STEP < 2.0 * wide:
            return
        # Rather a name that its curve does not cross.
        for crossed, place in itertools.product((False, True), _PLACES):
            spot = at[round(place * (len(at) - 1))]
            near = at[np.abs(at - spot).max(axis=1) < 0.04]
            across, up = near[-1] - near[0]
            # Above the curve, on the side that it comes from, where it does not run into the name.
            rising = 0.0 if abs(up) < 0.1 * abs(across) else float(np.sign(across * up))
            middle = spot[0] - 0.5 * rising * wide
            inside = 0.5 * wide < middle < 1.0 - 0.5 * wide and spot[1] < 0.94
            if not inside or not self._free(spot):
                continue
            side = next(
                (one for one in (1.0, -1.0) if self._clear(at, spot, rising, one, wide)), 0.0
            )
            if not (side or crossed):
                continue
            side = side or 1.0
            self._names.append(spot)
            self.ax.annotate(
                name,
                (spot[0], spot[1]),
                xycoords="axes fraction",
                xytext=(-_BESIDE * rising * side, _OFF * side),
                textcoords="offset points",
                ha={1.0: "right", 0.0: "center", -1.0: "left"}[rising * side],
                va="bottom" if side > 0.0 else "top",
                fontsize="small",
                color=colour,
                zorder=6,
            )
            return

    def _clear(self, at: _Array, spot: _Array, rising: float, side: float, wide: float) -> bool:
        """Return whether a curve does not cross its name above (1) or below (-1) the curve."""
        along = rising * side
        middle = spot[0] - along * (0.5 * wide + _BESIDE * self._point[0])
        near = side * (at[:, 1] - spot[1]) / self._point[1]
        above = (near > 0.5 * _OFF) & (near < 1.5 * _OFF + self._size)
        low, high = middle - 0.5 * wide, middle + 0.5 * wide
        inside = low > 0.0 and high < 1.0 and 0.0 < spot[1] + 0.08 * side < 1.0
        return bool(inside and not (above & (at[:, 0] > low) & (at[:, 0] < high)).any())

    def _free(self, spot: _Array) -> bool:
        return not any(
            (np.abs(spot - other) < least).all()
            for others, least in ((self._names, _APART), (self._marks, _CLEAR))
            for other in others
        )

    def _visible(self, x: _Array, y: _Array) -> _Array:
        """Return the visible part of a curve as evenly spaced points, relative to the panel."""
        at = self._to_panel.transform(np.column_stack([x, y]))
        length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(at, axis=0).T))])
        even = np.arange(0.0, length[-1], _STEP)
        at = np.column_stack([np.interp(even, length, part) for part in at.T])
        return at[((at >= 0.02) & (at <= 0.98)).all(axis=1)]
