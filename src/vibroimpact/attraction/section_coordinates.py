"""Parts of the stroboscopic state that outlast a cycle, which a plane of u and u̇ does not show."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.attraction.label_states import Stage
from vibroimpact.engine import parameters as par
from vibroimpact.engine.one_mass import PARTS
from vibroimpact.response.engine_system import engine_rig

FORGOTTEN = 20.0
"""What relaxes by more powers of e in a cycle is forgotten: 2e-9 of it is left."""


def remembered(stage: Stage) -> NDArray[np.bool_]:
    """Which of u, u̇, u_R, u_L and z a motion remembers from one section to the next."""
    rig = engine_rig(stage.rig)
    parts = np.zeros(PARTS, dtype=bool)
    parts[:2] = True
    for i, at in enumerate((par.BUMPER, par.BUMPER + par.WIDTH)):
        rests = rig[at + par.RATE] < FORGOTTEN * stage.excitation.frequency
        parts[2 + i] = rig[at + par.KIND] == par.KELVIN_VOIGT and rests
    parts[4] = rig[par.HYSTERETIC] != 0.0
    return parts


def met(stage: Stage, point: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which parts of one point hold the speed at which a stop was met.

    A power-law stop with a restitution divides by it as long as it is pressed, and keeps it where
    others keep their deformation.
    """
    rig = engine_rig(stage.rig)
    parts = np.zeros(PARTS, dtype=bool)
    for i, at in enumerate((par.BUMPER, par.BUMPER + par.WIDTH)):
        curved = rig[at + par.KIND] in par.CURVED_STOPS
        parts[2 + i] = curved and rig[at + par.DISSIPATION] < 0.0 and point[2 + i] != 0.0
    return parts


def has_no_memory(stage: Stage) -> bool:
    """Whether u and u̇ at the section determine a motion."""
    return not remembered(stage)[2:].any()
