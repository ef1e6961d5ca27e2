"""The branch of stable and unstable periodic orbits through the selected motion."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import base_at_rest
from vibroimpact.explorer.pictures.motion import at
from vibroimpact.explorer.pictures.numbers import forcings, short
from vibroimpact.explorer.state import PageState
from vibroimpact.figures.finish import in_unit
from vibroimpact.figures.resonance_panels import peak_force_unit
from vibroimpact.model import GRAVITY
from vibroimpact.model.rig import Rig
from vibroimpact.model.written_units import as_first_argument
from vibroimpact.stability.branch import branch
from vibroimpact.tasks.threads import Progress

_MOST = 2000
"""Largest number of orbits in each direction along a branch."""


@as_first_argument
def branches(state: PageState, data: xr.Dataset, progress: Progress) -> dict[str, Any]:
    """Return the branch through the selected motion, split into stable and unstable parts.

    Raises
    ------
    InputError
        If the motion is not periodic.
    """
    shaken, section, period = at(state, data)
    orbits = branch(
        Rig(state.oscillator, shaken),
        section,
        vary={"frequency": state.span},
        period=int(period) or None,
        most_points=_MOST,
        progress=progress,
    )
    return {
        "picture": "branch",
        "physical": state.physical,
        "panels": [_pieces(orbits, values) for values in _heights(state, data, orbits)],
    }


def _heights(state: PageState, data: xr.Dataset, orbits: xr.Dataset) -> list[NDArray[np.float64]]:
    """What the panels of the curves show, of each orbit."""
    still = base_at_rest(data)
    if not state.physical:
        kinds = ("acceleration", "displacement")
        shares = [
            orbits[f"{kind}_excursion"].values / float(data[f"largest_free_{kind}_excursion"])
            for kind in kinds
        ]
        return [*shares, *([orbits["transmissibility"].values] if still else [])]
    peaks = (
        np.fmax(np.abs(orbits[f"{kind}_max"].values), np.abs(orbits[f"{kind}_min"].values))
        for kind in ("acceleration", "displacement")
    )
    sizes = [
        size * unit
        for size, unit in zip(peaks, (in_unit(1.0 / GRAVITY), in_unit(1e3)), strict=True)
    ]
    if still:
        unit = peak_force_unit(data)
        sizes.append(orbits["peak_transmitted_force"].values / unit.size)
    return sizes


def _pieces(orbits: xr.Dataset, values: NDArray[np.float64]) -> list[dict[str, Any]]:
    """The branch, cut where its stability changes; neighbouring pieces share a point."""
    frequency, stable = orbits["frequency"].values, orbits["stable"].values.astype(bool)
    changes = np.flatnonzero(np.diff(stable.astype(int))) + 1
    ends = [0, *changes, len(stable) - 1]
    return [
        {
            "stable": bool(stable[first]),
            "frequency": forcings(frequency[first : last + 1]),
            "value": short(values[first : last + 1]),
        }
        for first, last in pairwise(ends)
    ]
