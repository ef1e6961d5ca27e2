"""How basins are mixed, and how near a motion is to their border; of any labelled grid."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

_Array = NDArray[np.float64]
_Labels = NDArray[np.integer[Any]]

BOX = 5
"""Nodes along each side of a box of the basin entropy."""
_LEAST_PAIRS = 20
"""Pairs of nodes with different labels from which on their share counts in a fit."""


class Entropies(NamedTuple):
    """Mean entropy of boxes: of all, and of those with more than one label (natural logarithm)."""

    basin: float
    border: float


def entropies(labels: _Labels, box: int = BOX) -> Entropies:
    """The basin entropy and the boundary basin entropy.

    The grid is cut into boxes, and each has the entropy −Σ p ln p of the shares p of its labels
    (A. Daza et al., Scientific Reports 6, 31416, 2016). A boundary basin entropy above ln 2 proves
    a fractal border. Nodes beyond the last whole box are left out, and so are negative labels.
    """
    rows, columns = (n // box for n in labels.shape)
    names = np.unique(labels[labels >= 0])
    if not rows or not columns or not len(names):
        return Entropies(np.nan, np.nan)
    cut = labels[: rows * box, : columns * box].reshape(rows, box, columns, box)
    boxes = cut.transpose(0, 2, 1, 3).reshape(rows * columns, box * box)
    counts = np.stack([(boxes == one).sum(axis=1) for one in names], 1)
    counts = counts[counts.sum(axis=1) > 0]
    if not len(counts):
        return Entropies(np.nan, np.nan)
    shares = counts / counts.sum(axis=1, keepdims=True)
    each = -(shares * np.log(np.where(shares > 0.0, shares, 1.0))).sum(axis=1)
    mixed = (counts > 0).sum(axis=1) > 1
    return Entropies(float(each.mean()), float(each[mixed].mean()) if mixed.any() else 0.0)


class Exponent(NamedTuple):
    """How the share of uncertain states falls with what is not known of them."""

    value: float
    """1 of a smooth border, less of a fractal one, whose dimension is the grid's less this."""
    uncertainty: float
    """Standard error of the fit."""


def uncertainty_exponent(labels: _Labels) -> Exponent:
    """The exponent α of f(ε) ∝ ε^α, f the share of pairs at a distance ε that lead elsewhere.

    Pairs of nodes a power of two apart along each axis, fitted by least squares of the logarithms
    (C. Grebogi et al., Physics Letters A 99, 415, 1983). NaN where there is no border, or if it
    is too short.
    """
    steps = [1 << k for k in range(max(min(labels.shape) // 8, 1).bit_length())]
    rows, columns = (n - steps[-1] for n in labels.shape)
    here = labels[:rows, :columns]  # the same nodes for each distance
    apart, shares = [], []
    for step in steps:
        differ = total = 0
        for there in (labels[step : step + rows, :columns], labels[:rows, step : step + columns]):
            known = (here >= 0) & (there >= 0)
            differ += int((known & (here != there)).sum())
            total += int(known.sum())
        if differ >= _LEAST_PAIRS:
            apart.append(float(step))
            shares.append(differ / total)
    if len(apart) < 3:
        return Exponent(np.nan, np.nan)
    x, y = np.log(apart), np.log(shares)
    line, covariance = np.polyfit(x, y, 1, cov="unscaled")
    left = y - np.polyval(line, x)
    spread = np.sqrt((left @ left) / (len(x) - 2) * covariance[0, 0])
    return Exponent(float(line[0]), float(spread))


def border(labels: _Labels) -> NDArray[np.bool_]:
    """Which nodes have a neighbour, on one of four sides, with another label."""
    mixed = np.zeros(labels.shape, dtype=bool)
    for axis in (0, 1):
        one, other = (
            labels.take(range(*part), axis=axis)
            for part in ((0, labels.shape[axis] - 1), (1, labels.shape[axis]))
        )
        differs = one != other
        first = [slice(None)] * 2
        second = [slice(None)] * 2
        first[axis], second[axis] = slice(None, -1), slice(1, None)
        mixed[tuple(first)] |= differs
        mixed[tuple(second)] |= differs
    return mixed


def border_distances(labels: _Labels, x: _Array, y: _Array, points: list[_Array]) -> _Array:
    """How far each basin's own points are from the nearest node with another label.

    Parameters
    ----------
    labels
        Rows along y, columns along x.
    x, y
        Of the nodes, both in the unit of the distance.
    points
        For each label from 0 on, points (x, y) in its basin.

    Returns
    -------
    ndarray
        Infinite where no node has another label, NaN where no point lies within the grid.
    """
    rows, columns = np.nonzero(border(labels))
    places, owners = np.column_stack([x[columns], y[rows]]), labels[rows, columns]
    distances = np.full(len(points), np.nan)
    for label, mine in enumerate(points):
        low, high = (x[0], y[0]), (x[-1], y[-1])
        inside = mine[((mine >= low) & (mine <= high)).all(axis=1)]
        if not len(inside):
            continue
        others = places[(owners != label) & (owners >= 0)]
        distances[label] = (
            scipy.spatial.KDTree(others).query(inside)[0].min() if len(others) else np.inf
        )
    return distances
