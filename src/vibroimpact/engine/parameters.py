"""The rig as the kernels see it: one vector of plain numbers, everything per unit mass."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

# Positions in the vector. Side 1 is the right bumper and side 2 the left one, so that
# `BUMPER + WIDTH * (side - 1)` is where a bumper's numbers start.
STIFFNESS = 0  # K/M, 1/s²
DAMPING = 1  # C/M, 1/s
BUMPER = 2
WIDTH = 6
KIND = 0  # ABSENT, KELVIN_VOIGT or RIGID
BUMPER_STIFFNESS = 1  # K_j/M, 1/s²
BUMPER_DAMPING = 2  # C_j/M, 1/s
GAP = 3  # G0_j, m; infinite where there is no bumper
RATE = 4  # K_j/C_j, 1/s: how fast the free bumper relaxes; infinite where C_j = 0
RESTITUTION = 5  # of a rigid stop
SIZE = BUMPER + 2 * WIDTH

ABSENT, KELVIN_VOIGT, RIGID = 0.0, 1.0, 2.0

Stop = tuple[float, ...]
"""K_j (N/m), C_j (N s/m) and G0_j (m) of a bumper; e and G0_j (m) of a rigid stop."""


def rig_vector(
    mass: float, stiffness: float, damping: float, right: Stop | None, left: Stop | None
) -> NDArray[np.float64]:
    """Pack a rig for the kernels.

    Parameters
    ----------
    mass, stiffness, damping : float
        M (kg), K (N/m) and C (N s/m) of the mass and its isolator.
    right, left : tuple of float or None
        Each stop; None where there is none.

    Returns
    -------
    ndarray of float, shape (SIZE,)
    """
    vector = np.zeros(SIZE)
    vector[STIFFNESS] = stiffness / mass
    vector[DAMPING] = damping / mass
    for side, stop in ((1, right), (2, left)):
        at = BUMPER + WIDTH * (side - 1)
        vector[at + GAP] = stop[-1] if stop else np.inf
        vector[at + RATE] = np.inf
        if stop is None:
            continue
        if len(stop) == 2:
            vector[at + KIND], vector[at + RESTITUTION] = RIGID, stop[0]
            continue
        bumper_stiffness, bumper_damping, _ = stop
        vector[at + KIND] = KELVIN_VOIGT
        vector[at + BUMPER_STIFFNESS] = bumper_stiffness / mass
        vector[at + BUMPER_DAMPING] = bumper_damping / mass
        if bumper_damping:
            vector[at + RATE] = bumper_stiffness / bumper_damping
    return vector


def free_rig() -> NDArray[np.float64]:
    """A rig without stops, of unit mass and stiffness."""
    return rig_vector(1.0, 1.0, 0.0, None, None)
