"""Basins at several values of a parameter, in which isolated branches of orbits are searched."""

from __future__ import annotations

import xarray as xr

from vibroimpact.attraction.basins import basins
from vibroimpact.model.argument_types import whole
from vibroimpact.model.parameters import parameter as registered
from vibroimpact.model.rig import Rig
from vibroimpact.tasks.threads import Progress

_NODES = 40
"""States along each axis."""


def basins_along(
    rig: Rig,
    parameter: str,
    span: tuple[float, float],
    count: int,
    progress: Progress | None = None,
) -> list[xr.Dataset]:
    """Compute `basins` at a number of values, each in the middle of its part of the range.

    Raises
    ------
    InputError
        If the number is below 0.
    """
    varied = registered(parameter, rig)
    step = (span[1] - span[0]) / max(whole(count, "basins", 0), 1)
    values = [span[0] + (i + 0.5) * step for i in range(count)]
    return [basins(varied.vary(rig, one), nodes=_NODES, progress=progress) for one in values]
