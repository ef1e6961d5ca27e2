"""A map that is quickly made."""

from __future__ import annotations

from functools import cache

import numpy as np
import xarray as xr

import vibroimpact as vi
from samples import sample

AXES = {"stiffness_ratio": np.geomspace(1.0, 64.0, 4), "gap_ratio": np.linspace(0.0, 1.0, 5)}
OPTIONS = {"refine": 1, "block": 2, "step": sample(0.02, 0.04)}


@cache
def small() -> xr.Dataset:
    return vi.scenario_map(None, AXES, **OPTIONS)


def rig_of(case) -> vi.Rig:
    """A case as the rig of a map."""
    return case.rig
