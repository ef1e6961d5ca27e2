"""States on a grid, written down where they are followed: they need not be kept, nor travel."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Lattice:
    """Some nodes of a grid of displacement and velocity; an array of states to numpy."""

    displacement: _Array
    """Of each column (m)."""
    velocity: _Array
    """Of each row (m/s)."""
    others: _Array
    """u_R, u_L, z of all."""
    chosen: NDArray[np.int32]
    """Which nodes, rows one after the other."""

    def __len__(self) -> int:
        """How many states they are."""
        return len(self.chosen)

    def __getitem__(self, which: slice | NDArray[np.int64]) -> Lattice:
        """Some of them."""
        return replace(self, chosen=self.chosen[which])

    def __array__(self, dtype: object = None, copy: bool | None = None) -> _Array:
        """u, u̇, u_R, u_L, z of each, shape (n, 5): a new array of floats whatever is asked for."""
        row, column = np.divmod(self.chosen, len(self.displacement))
        points = np.empty((len(self), 5))
        points[:, 0], points[:, 1] = self.displacement[column], self.velocity[row]
        points[:, 2:] = self.others
        return points


def lattice(
    displacement: tuple[float, float],
    velocity: tuple[float, float],
    nodes: tuple[int, int],
    others: tuple[float, float, float] | _Array = (0.0, 0.0, 0.0),
) -> Lattice:
    """All nodes of a grid, by its ranges and the nodes along each; `others` are relaxed."""
    return Lattice(
        np.linspace(*displacement, nodes[0]),
        np.linspace(*velocity, nodes[1]),
        np.array(others),
        np.arange(nodes[0] * nodes[1], dtype=np.int32),
    )
