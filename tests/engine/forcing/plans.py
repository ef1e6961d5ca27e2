"""A plan with a forcing, its tables not built."""

from __future__ import annotations

from types import ModuleType

import numpy as np

from vibroimpact.engine.flow_dispatch import flow_of
from vibroimpact.engine.parameters import SIZE, Drive, rig_vector


def begun(forcing: ModuleType, drive: Drive, amplitude: float, omega: float) -> np.ndarray:
    rig = rig_vector(2.0, 8.0, 0.5, (0.5, 1.0), None, 0.0, drive)
    plan: np.ndarray = flow_of(rig).memory
    plan[:SIZE] = rig[:SIZE]
    forcing.begin(plan, amplitude, omega)
    return plan
