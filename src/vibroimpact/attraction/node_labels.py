"""The motions to which the nodes of a grid of states lead, refined near borders."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vibroimpact.grids.refinement import UNKNOWN, Nodes

UNDECIDED, NOWHERE = -1, -2
"""Number of a state that was given up, and of a state beyond a rigid stop."""
_WALL = np.int8(127)
"""A state beyond a rigid stop, while nodes are labelled."""
_Label: TypeAlias = Callable[
    [slice | NDArray[np.int64]], tuple[NDArray[np.int8], NDArray[np.integer[Any]]]
]


class NodeLabels(NamedTuple):
    """What is known of each node."""

    motion: NDArray[np.int16]
    """Number of the motion, or `UNDECIDED` or `NOWHERE`."""
    cycles: NDArray[np.int32]
    """Forcing cycles until that was known; -1 where the state was not followed."""
    level: NDArray[np.int8]
    """Refinement at which the state was followed; -1 where it was not."""


def label_nodes(plan: Nodes, label: _Label, outside: NDArray[np.bool_] | None = None) -> NodeLabels:
    """Label all nodes, those of each level at once.

    Parameters
    ----------
    label
        Returns the motions, or `UNDECIDED` or `NOWHERE`, and the cycles of some nodes, by their
        numbers.
    outside
        Columns that are known to lie beyond a rigid stop.
    """
    # One more than the number of the motion; 0 is given up.
    known = np.full(plan.shape, UNKNOWN, dtype=np.int8)
    cycles = np.full(plan.shape, -1, dtype=np.int32)
    levels = np.full(plan.shape, -1, dtype=np.int8)
    if outside is not None:
        known[:, outside] = _WALL
    for level in range(plan.refine + 1):
        chosen = plan.nodes_to_compute(level, known)
        chosen &= known == UNKNOWN
        at = slice(None) if chosen.all() else np.flatnonzero(chosen)
        del chosen
        owner, followed = label(at)
        known.ravel()[at] = np.where(owner == NOWHERE, _WALL, owner + np.int8(1))
        cycles.ravel()[at] = followed
        levels.ravel()[at] = level
        if level:
            plan.fill(level, known)
    motion = known.astype(np.int16) - np.int16(1)
    motion[known == _WALL] = NOWHERE
    return NodeLabels(motion, cycles, levels)
