"""Names that stand on curves."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

_Array = NDArray[np.float64]

_PLACES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
"""Shares of a curve's length where its name may stand, in this order."""
_APART = np.array([0.16, 0.06])
"""Least distance of names, in widths and heights of the panel."""
_CLEAR = np.array([0.08, 0.045])
"""Least distance of a name from a mark."""
_ON = 0.01
"""A curve that passes so close to a name has that name."""
_STEP = 0.005
"""Spacing of the points that a curve is looked at."""
_LETTER = 0.012
"""Width of a letter."""


class Names:
    """Writes names on the curves of a panel whose limits are final, none over another.

    The marks that the panel has stay clear of them.
    """

    def __init__(self, ax: Axes) -> None:
        self.ax = ax
        ax.autoscale_view()  # which matplotlib would put off until it draws
        self._to_panel = ax.transData + ax.transAxes.inverted()
        self._names: list[_Array] = []
        marks = [line.get_xydata() for line in ax.lines if line.get_linestyle() == "None"]
        self._marks = [spot for part in marks for spot in self._to_panel.transform(part)]

    def write(self, x: _Array, y: _Array, name: str, colour: str, *, once: bool) -> None:
        """Write a name on a curve, given in the units of the axes.

        A curve that is too short for it gets none; nor does, where `once`, one that lies on
        another that has a name.
        """
        at = self._visible(x, y)
        if once and any(np.hypot(*(at - spot).T).min(initial=np.inf) < _ON for spot in self._names):
            return
        if len(at) * _STEP < 2.0 * _LETTER * len(name):
            return  # it would hide half of the curve
        for place in _PLACES:
            spot = at[round(place * (len(at) - 1))]
            if not self._free(spot):
                continue
            self._names.append(spot)
            self.ax.text(
                spot[0],
                spot[1],
                name,
                transform=self.ax.transAxes,
                ha="center",
                va="center",
                fontsize="small",
                color=colour,
                bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "linewidth": 0.0},
                zorder=6,
            )
            return

    def _free(self, spot: _Array) -> bool:
        return not any(
            (np.abs(spot - other) < least).all()
            for others, least in ((self._names, _APART), (self._marks, _CLEAR))
            for other in others
        )

    def _visible(self, x: _Array, y: _Array) -> _Array:
        """The part of a curve inside the panel as evenly spaced points, in its width and height."""
        at = self._to_panel.transform(np.column_stack([x, y]))
        length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(at, axis=0).T))])
        even = np.arange(0.0, length[-1], _STEP)
        at = np.column_stack([np.interp(even, length, part) for part in at.T])
        return at[((at >= 0.02) & (at <= 0.98)).all(axis=1)]
