"""The sweep of an assembly as a dataset, by mass and stop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, rig_parameters
from vibroimpact.engine import batch, hold
from vibroimpact.errors import InputError
from vibroimpact.model import Assembly, AssemblyState, Rig
from vibroimpact.response.assembly_rig import assembly_numbers, check_size
from vibroimpact.response.assembly_rows import measured_variables, notes_on
from vibroimpact.response.hold_rows import Settling, sweep_holds
from vibroimpact.response.outputs import NamedOutput, about
from vibroimpact.response.section_states import SectionStates
from vibroimpact.response.sweep_outputs import add_sweep_outputs
from vibroimpact.tasks.threads import Progress, Tally, Workers, each

_Array = NDArray[np.float64]


def sweep_assemblies(
    rigs: Mapping[str, Rig],
    frequencies: _Array,
    directions: tuple[str, ...],
    starts: Mapping[str, AssemblyState],
    phase: float,
    settling: Settling,
    own: Sequence[tuple[NamedOutput, ...]],
    workers: Workers,
    progress: Progress | None,
) -> xr.Dataset:
    """Return what `sweeps` returns of assemblies with parts of the same names.

    Raises
    ------
    InputError
        If their parts have other names.
    """
    first = next(iter(rigs.values())).system
    for name, rig in rigs.items():
        if not isinstance(rig.system, Assembly) or not isinstance(first, Assembly):
            raise InputError(
                f"rigs[{name}]: an Oscillator beside an Assembly; pass rigs with the same parts"
            )
        for part in ("names", "stops"):
            mine, theirs = (list(getattr(one, part)) for one in (rig.system, first))
            if mine != theirs:
                raise InputError(
                    f"rigs[{name}]: its {'masses' if part == 'names' else part} are "
                    f"{', '.join(mine) or 'none'}, not those of the first rig, "
                    f"{', '.join(theirs) or 'none'}; pass rigs with the same parts"
                )
    ready = {}
    for name, rig in rigs.items():
        assert isinstance(rig.system, Assembly)
        check_size(rig.system)
        vector = assembly_numbers(rig.system, rig.hardest.periodic, tables=True)
        begin = SectionStates(rig.system).vector_of(starts[name])
        ready[name] = (vector, rig.levels(len(frequencies)), begin)
    batch.sweep.prepare(*(vector for vector, _, _ in ready.values()))  # before threads would queue

    def follow(item: tuple[str, str], tally: Tally) -> tuple[_Array, _Array]:
        vector, levels, begin = ready[item[0]]
        order = slice(None, None, 1 if item[1] == "forward" else -1)
        rows, reached = sweep_holds(
            vector, levels[order], frequencies[order], phase, begin, settling, tally
        )
        return rows.array[order], reached[order]

    items = [(name, direction) for name in rigs for direction in directions]
    steps = len(frequencies) * len(items)
    total = 2 * steps if own[0] else steps
    told = progress and (lambda done, _: progress(done, total))
    done = each(follow, items, steps=steps, threads=workers, progress=told)
    shape = (len(rigs), len(directions), len(frequencies), -1)
    rows = np.array([found for found, _ in done]).reshape(shape)
    ends = np.array([reached for _, reached in done]).reshape(shape)
    dims = ("rig", "direction", "frequency")
    period = rows[..., hold.PERIOD].astype(np.int64)
    assembly = next(iter(rigs.values())).system
    assert isinstance(assembly, Assembly)
    states = SectionStates(assembly)
    sections = np.array(
        [[[states.components(one, phase) for one in some] for some in of_rig] for of_rig in ends]
    )
    data = xr.Dataset(
        {
            **measured_variables(assembly, rows, dims),
            "motion": (dims, np.where(period > 0, "periodic", "undecided")),
            "period": (dims, period),
            "cycles": (dims, rows[..., hold.CYCLES].astype(np.int64)),
            "status": (dims, rows[..., hold.OUTCOME].astype(np.int64)),
            "section": ((*dims, "component"), sections),
        },
        coords={
            "direction": list(directions),
            "frequency": frequencies,
            "mass": np.array(assembly.names, dtype=np.str_),
            "stop": np.array(list(assembly.stops), dtype=np.str_),
            "component": states.names,
        },
    )
    if own[0]:
        pairs, levels = list(rigs.values()), [levels for _, levels, _ in ready.values()]
        given = (phase, ends, settling.window)
        add_sweep_outputs(data, own, pairs, levels, *given, workers, progress)
    notes = notes_on(assembly, rows, "motions")
    data = data.assign_coords(rig=list(rigs))
    return describe(
        data,
        "vibroimpact.sweeps",
        {
            "rigs": [rig_parameters(rig, "frequency", "phase") for rig in rigs.values()],
            "phase": phase,
            "tolerance": settling.tolerance,
            "max_cycles": settling.max_cycles,
            "window": settling.window,
            "max_events": settling.max_events,
            **about(own[0]),
        },
        notes,
        own[0],
    )
