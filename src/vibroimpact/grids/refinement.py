"""Which nodes of a map are computed: all of a coarse grid, then those beside a border.

A map of n nodes along an axis that is refined k times has (n - 1) 2^k + 1 of them. Level 0 is
every 2^k-th node. Each further level halves the distance: of a square whose corners have one
scenario the new nodes are given that scenario, of any other square they are computed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Scenarios = NDArray[np.int8]
"""Number of the scenario of each node; `UNKNOWN` where it is not known yet."""

UNKNOWN = -1


class Nodes(NamedTuple):
    """The nodes of a map: rows are y, columns x."""

    shape: tuple[int, int]
    """Of the finest grid."""
    refine: int
    """How often it is refined."""

    def spacing(self, level: int) -> int:
        """Distance of a level's nodes on the finest grid."""
        return 1 << (self.refine - level)

    def nodes_to_compute(self, level: int, scenarios: Scenarios) -> NDArray[np.bool_]:
        """Which nodes have to be computed at a level, by the scenarios of the one before."""
        chosen = np.zeros(self.shape, dtype=bool)
        step = self.spacing(level)
        if level == 0:
            chosen[::step, ::step] = True
            return chosen
        for rows, columns in self._mixed(level, scenarios):
            chosen[rows : rows + 2 * step + 1 : step, columns : columns + 2 * step + 1 : step] = (
                True
            )
        chosen[:: 2 * step, :: 2 * step] = False  # the corners are known
        return chosen

    def fill(self, level: int, scenarios: Scenarios) -> None:
        """Give the new nodes of squares with one scenario that scenario."""
        step = self.spacing(level)
        corners = scenarios[:: 2 * step, :: 2 * step]
        same = _same(corners)
        for i, j in zip(*np.nonzero(same), strict=True):
            rows = slice(2 * step * i, 2 * step * (i + 1) + 1, step)
            columns = slice(2 * step * j, 2 * step * (j + 1) + 1, step)
            square = scenarios[rows, columns]
            square[square == UNKNOWN] = corners[i, j]

    def _mixed(self, level: int, scenarios: Scenarios) -> list[tuple[int, int]]:
        """First row and column of each square whose corners differ."""
        step = 2 * self.spacing(level)
        differ = ~_same(scenarios[::step, ::step])
        return [(step * int(i), step * int(j)) for i, j in zip(*np.nonzero(differ), strict=True)]


def _same(corners: Scenarios) -> NDArray[np.bool_]:
    first = corners[:-1, :-1]
    same: NDArray[np.bool_] = (
        (first == corners[1:, :-1]) & (first == corners[:-1, 1:]) & (first == corners[1:, 1:])
    )
    return same
