"""Cells of the plane that a wandering motion, chaotic or not, visits, and that nothing leaves.

The cells that the motion visits are joined by those that their images meet, and these by those of
theirs, until no image lies outside: from there nothing gets out (the outer approximation of
set-oriented methods, M. Dellnitz and A. Hohmann, Numerische Mathematik 75, 1997). Each cell is
sampled, the images of neighbouring samples are joined by straight lines, and all cells beside them
are taken as well.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from vibroimpact.attraction.label_states import SectionSetup, images
from vibroimpact.tasks.threads import Workers

_Array = NDArray[np.float64]
_Mask = NDArray[np.bool_]

SIDE = 400
"""Cells along each axis."""
_ROOM = 0.5
"""Of what the motions visit, left around it on each side."""
_MOST = 0.4
"""Of all cells: a set that grows beyond closes around more than one motion."""
_SAMPLES = 5
"""Along each side of a cell."""
_STEPS = 64
"""Points of the longest line between two images."""
_AROUND = np.ones((3, 3), dtype=bool)


class Cells(NamedTuple):
    """A grid of cells: its corner, and the sides of a cell (m, m/s)."""

    corner: _Array
    side: _Array

    def of(self, points: _Array) -> NDArray[np.int64]:
        """Column and row of each point (u, u̇)."""
        return np.floor((points - self.corner) / self.side).astype(np.int64)


def cells_around(points: _Array) -> Cells:
    """A grid with room around points (u, u̇)."""
    low, high = points.min(axis=0), points.max(axis=0)
    room = _ROOM * (high - low)
    return Cells(low - room, (high - low + 2.0 * room) / SIDE)


def closed(stage: SectionSetup, cells: Cells, points: _Array, threads: Workers) -> _Mask | None:
    """The cells that the points (u, u̇) of a motion visit, and all that follows from them.

    Returns
    -------
    ndarray of bool, shape (row, column)
        None if the set does not close.
    """
    mask = np.zeros((SIDE, SIDE), dtype=bool)
    if not _enter(mask, cells.of(points)):
        return None
    mask = _wider(mask)
    fresh = mask
    while fresh.any():
        reached = _images(stage, cells, fresh, threads)
        if reached is None:
            return None
        fresh = _wider(reached) & ~mask
        mask = mask | fresh
        if mask.mean() > _MOST:
            return None
    return mask


def _wider(mask: _Mask) -> _Mask:
    """The cells, and those beside them."""
    wider: _Mask = scipy.ndimage.binary_dilation(mask, _AROUND)
    return wider


def _enter(mask: _Mask, at: NDArray[np.int64]) -> bool:
    """Mark cells; False if one of them lies outside."""
    if ((at < 0) | (at >= SIDE)).any():
        return False
    mask[at[:, 1], at[:, 0]] = True
    return True


def _images(stage: SectionSetup, cells: Cells, chosen: _Mask, threads: Workers) -> _Mask | None:
    """The cells that the images of some cells meet."""
    rows, columns = np.nonzero(chosen)
    inside = np.linspace(0.0, 1.0, _SAMPLES)
    u = cells.corner[0] + cells.side[0] * (columns[:, None, None] + inside[None, None, :])
    v = cells.corner[1] + cells.side[1] * (rows[:, None, None] + inside[None, :, None])
    u, v = np.broadcast_arrays(u, v)
    points = np.zeros((u.size, 5))
    points[:, 0], points[:, 1] = u.ravel(), v.ravel()
    image_points, known = images(stage, points, 1, threads)
    if not known.all():
        return None
    image = image_points[:, :2].reshape(len(rows), _SAMPLES, _SAMPLES, 2)
    mask = np.zeros((SIDE, SIDE), dtype=bool)
    for one, other in (
        (image[:, 1:], image[:, :-1]),
        (image[:, :, 1:], image[:, :, :-1]),
    ):
        begin, way = one.reshape(-1, 2), (other - one).reshape(-1, 2)
        longest = np.abs(way / cells.side).max()
        if longest > _STEPS:
            return None
        for share in np.linspace(0.0, 1.0, int(np.ceil(longest)) + 2):
            if not _enter(mask, cells.of(begin + share * way)):
                return None
    return mask
