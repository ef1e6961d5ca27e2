"""The sweep of an assembly as a dataset, by mass and stop."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, rig_parameters
from vibroimpact.engine import batch, hold
from vibroimpact.model import Assembly, AssemblyState, Rig
from vibroimpact.response.assembly_rig import assembly_numbers, check_size
from vibroimpact.response.assembly_rows import measured_variables, notes_on
from vibroimpact.response.hold_rows import Settling, sweep_holds
from vibroimpact.response.section_states import SectionStates
from vibroimpact.tasks.threads import Progress, Tally, Workers, each

_Array = NDArray[np.float64]


def sweep_assembly(
    rig: Rig,
    frequencies: _Array,
    directions: tuple[str, ...],
    start: AssemblyState,
    phase: float,
    settling: Settling,
    workers: Workers,
    progress: Progress | None,
) -> xr.Dataset:
    """Return what `sweep` returns of an assembly; the arguments are checked ones of `sweep`."""
    assembly = rig.system
    assert isinstance(assembly, Assembly)
    check_size(assembly)
    states = SectionStates(assembly)
    levels = rig.levels(len(frequencies))
    vector = assembly_numbers(assembly, rig.hardest.periodic, tables=True)
    begin = states.vector_of(start)
    batch.sweep.prepare(vector)  # once, before the threads would queue for it

    def follow(direction: str, tally: Tally) -> tuple[_Array, _Array]:
        order = slice(None, None, 1 if direction == "forward" else -1)
        rows, reached = sweep_holds(
            vector, levels[order], frequencies[order], phase, begin, settling, tally
        )
        return rows.array[order], reached[order]

    done = each(
        follow,
        list(directions),
        steps=len(frequencies) * len(directions),
        threads=workers,
        progress=progress,
    )
    rows = np.array([found for found, _ in done])
    ends = np.array([reached for _, reached in done])
    dims = ("direction", "frequency")
    period = rows[..., hold.PERIOD].astype(np.int64)
    sections = [[states.components(one, phase) for one in some] for some in ends]
    data = xr.Dataset(
        {
            **measured_variables(assembly, rows, dims),
            "motion": (dims, np.where(period > 0, "periodic", "undecided")),
            "period": (dims, period),
            "cycles": (dims, rows[..., hold.CYCLES].astype(np.int64)),
            "status": (dims, rows[..., hold.OUTCOME].astype(np.int64)),
            "section": ((*dims, "component"), np.array(sections)),
        },
        coords={
            "direction": list(directions),
            "frequency": frequencies,
            "mass": np.array(assembly.names, dtype=np.str_),
            "stop": np.array(list(assembly.stops), dtype=np.str_),
            "component": states.names,
        },
    )
    return describe(
        data,
        "vibroimpact.sweep",
        {
            "rigs": [rig_parameters(rig, "frequency", "phase")],
            "phase": phase,
            "tolerance": settling.tolerance,
            "max_cycles": settling.max_cycles,
            "window": settling.window,
            "max_events": settling.max_events,
        },
        notes_on(assembly, rows, "motions"),
    )
