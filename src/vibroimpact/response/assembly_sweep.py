"""Sweeps of assemblies as a dataset, by mass and stop."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import hold
from vibroimpact.model import Assembly
from vibroimpact.model.rig import System
from vibroimpact.response.assembly_rows import measured_variables, names_of_parts, notes_on
from vibroimpact.response.section_states import SectionStates

_Array = NDArray[np.float64]


def assembly_dataset(
    system: System, rows: _Array, ends: _Array, phase: float
) -> tuple[xr.Dataset, list[str]]:
    """Label what holds of assemblies measured.

    Parameters
    ----------
    system
        One of the assemblies, which have parts of the same names.
    rows, ends
        Rows of `hold`, and the state at its end, with the dims rig, direction and frequency.
    phase
        That of the section, rad.

    Returns
    -------
    data, notes
        The dataset, and what was doubted of the motions.
    """
    assert isinstance(system, Assembly)
    dims = ("rig", "direction", "frequency")
    period = rows[..., hold.PERIOD].astype(np.int64)
    states = SectionStates(system)
    data = xr.Dataset(
        {
            **measured_variables(system, rows, dims),
            "motion": (dims, np.where(period > 0, "periodic", "undecided")),
            "period": (dims, period),
            "cycles": (dims, rows[..., hold.CYCLES].astype(np.int64)),
            "status": (dims, rows[..., hold.OUTCOME].astype(np.int64)),
            "section": ((*dims, "component"), states.components(ends, phase)),
        },
        coords={**names_of_parts(system), "component": states.names},
    )
    return data, notes_on(system, rows, "motions")
