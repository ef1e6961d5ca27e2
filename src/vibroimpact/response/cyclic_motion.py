"""What a recorded motion under a repeated forcing is of: an oscillator or an assembly."""

from __future__ import annotations

from typing import NamedTuple

import xarray as xr

from vibroimpact.model import Repeated
from vibroimpact.model.rig import System
from vibroimpact.response.assembly_contacts import assembly_origin, has_assembly
from vibroimpact.response.motion_phases import check_repeated, recorded


class CyclicMotion(NamedTuple):
    """Origin of the motion of a dataset."""

    system: System
    shaking: Repeated
    """Its phase is that at the beginning of the motion."""
    cycles: float
    """Length of the motion."""
    periodic: bool
    """Whether the motion is one period of a periodic one: its end is its beginning."""


def cyclic_motion(motion: xr.Dataset) -> CyclicMotion:
    """Return whose motion under a repeated forcing a dataset holds.

    Raises
    ------
    InputError
        If it is not the dataset of such a motion with samples and events.
    """
    if not has_assembly(motion):
        return CyclicMotion(*recorded(motion))
    origin = assembly_origin(motion)
    shaking = check_repeated(origin.shaking)
    cycles = float(motion["cycle"].values[-1])
    return CyclicMotion(origin.assembly, shaking, cycles, origin.periodic)
