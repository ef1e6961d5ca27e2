"""The rig as the kernels see it: one vector of plain numbers, everything per unit mass."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

# Positions in the vector. Side 1 is the right bumper and side 2 the left one, so that
# `BUMPER + WIDTH * (side - 1)` is where a bumper's numbers start.
STIFFNESS = 0  # K/M, 1/s²
DAMPING = 1  # C/M, 1/s
BUMPER = 2
WIDTH = 5
PRESENT = 0  # 1.0 or 0.0
BUMPER_STIFFNESS = 1  # K_j/M, 1/s²
BUMPER_DAMPING = 2  # C_j/M, 1/s
GAP = 3  # G0_j, m; infinite where there is no bumper
RATE = 4  # K_j/C_j, 1/s: how fast the free bumper relaxes; infinite where C_j = 0
SIZE = BUMPER + 2 * WIDTH

Bumper = tuple[float, float, float]


def rig_vector(
    mass: float, stiffness: float, damping: float, right: Bumper | None, left: Bumper | None
) -> NDArray[np.float64]:
    """Pack a rig for the kernels.

    Parameters
    ----------
    mass, stiffness, damping : float
        M (kg), K (N/m) and C (N s/m) of the mass and its isolator.
    right, left : tuple of float or None
        K_j (N/m), C_j (N s/m) and G0_j (m) of each bumper; None where there is none.

    Returns
    -------
    ndarray of float, shape (SIZE,)
    """
    vector = np.zeros(SIZE)
    vector[STIFFNESS] = stiffness / mass
    vector[DAMPING] = damping / mass
    for side, bumper in ((1, right), (2, left)):
        at = BUMPER + WIDTH * (side - 1)
        if bumper is None:
            vector[at + GAP] = np.inf
            vector[at + RATE] = np.inf
            continue
        bumper_stiffness, bumper_damping, gap = bumper
        vector[at + PRESENT] = 1.0
        vector[at + BUMPER_STIFFNESS] = bumper_stiffness / mass
        vector[at + BUMPER_DAMPING] = bumper_damping / mass
        vector[at + GAP] = gap
        vector[at + RATE] = bumper_stiffness / bumper_damping if bumper_damping else np.inf
    return vector
