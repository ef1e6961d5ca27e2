"""Where curves of the plane cross."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

_Array = NDArray[np.float64]


def crossings(one: _Array, other: _Array) -> _Array:
    """The points in which two lines through points cross, in the order of the first.

    Pieces that only touch at their ends belong to one of them.
    """
    begin, way = _pieces(one)
    there, its_way = _pieces(other)
    if not (len(begin) and len(there)):
        return np.empty((0, 2))
    reach = 0.5 * (np.linalg.norm(way, axis=1).max() + np.linalg.norm(its_way, axis=1).max())
    middles = scipy.spatial.KDTree(begin + 0.5 * way)
    near = middles.query_ball_tree(
        scipy.spatial.KDTree(there + 0.5 * its_way), reach * (1.0 + 1e-9)
    )
    i = np.repeat(np.arange(len(begin)), [len(neighbours) for neighbours in near])
    j = np.array([k for neighbours in near for k in neighbours], dtype=int)
    if not len(i):
        return np.empty((0, 2))
    between = there[j] - begin[i]
    turn = _cross(way[i], its_way[j])
    with np.errstate(divide="ignore", invalid="ignore"):
        along, across = _cross(between, its_way[j]) / turn, _cross(between, way[i]) / turn
    met = (along >= 0.0) & (along < 1.0) & (across >= 0.0) & (across < 1.0)
    order = np.argsort(i[met] + along[met], kind="stable")
    return (begin[i] + along[:, None] * way[i])[met][order]


def _pieces(points: _Array) -> tuple[_Array, _Array]:
    """Where the pieces of a line begin, and where they go; rows of NaN part it."""
    way = np.diff(points, axis=0)
    there = ~np.isnan(way).any(axis=1)
    return points[:-1][there], way[there]


def _cross(one: _Array, other: _Array) -> _Array:
    return one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
