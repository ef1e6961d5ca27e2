"""Parts of the stroboscopic state that outlast a cycle, which a plane of u and u̇ does not show."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.attraction.label_states import SectionSetup
from vibroimpact.engine import parameters as par
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.response.engine_system import engine_rig

_PARTS = ONE_MASS.of_point

FORGOTTEN = 20.0
"""What relaxes by more powers of e in a cycle is forgotten: 2e-9 of it is left."""


def remembered(stage: SectionSetup) -> NDArray[np.bool_]:
    """Which of u, u̇, u_R, u_L and z a motion remembers from one section to the next."""
    rig = engine_rig(stage.rig)
    parts = np.zeros(_PARTS.total, dtype=bool)
    parts[:2] = True
    for stop in range(_PARTS.stops):
        at = par.stop_at(stop)
        rests = rig[at + par.RATE] < FORGOTTEN * stage.excitation.frequency
        parts[_PARTS.deformation(stop)] = rig[at + par.KIND] == par.KELVIN_VOIGT and rests
    parts[_PARTS.memory()] = rig[par.HYSTERETIC] != 0.0
    return parts


def met(stage: SectionSetup, point: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which parts of one point hold the speed at which a stop was met.

    A power-law stop with a restitution divides by it as long as it is pressed, and keeps it where
    others keep their deformation.
    """
    rig = engine_rig(stage.rig)
    parts = np.zeros(_PARTS.total, dtype=bool)
    for stop in range(_PARTS.stops):
        at = par.stop_at(stop)
        curved = rig[at + par.KIND] in par.CURVED_STOPS
        parts[_PARTS.deformation(stop)] = (
            curved and rig[at + par.DISSIPATION] < 0.0 and point[_PARTS.deformation(stop)] != 0.0
        )
    return parts


def has_no_memory(stage: SectionSetup) -> bool:
    """Whether u and u̇ at the section determine a motion."""
    return not remembered(stage)[2:].any()
