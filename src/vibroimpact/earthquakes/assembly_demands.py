"""What records ask of assemblies: peaks by mass, link and stop, from rest."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.earthquakes.free_vibration import free_tail
from vibroimpact.earthquakes.run_plan import Runs
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Assembly, Record, equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.assembly_contacts import coordinates, energies, extremes
from vibroimpact.response.assembly_motion import sections_of, too_much_work
from vibroimpact.response.assembly_phases import Measurer
from vibroimpact.response.assembly_pieces import NODES, NODES_OF_RANGES
from vibroimpact.response.assembly_rig import check_laws
from vibroimpact.response.assembly_state import assembly_vector
from vibroimpact.tasks.threads import Progress, Tally, Workers, each

_Array = NDArray[np.float64]

PEAKS = (
    *("peak_displacement", "displacement_max", "displacement_min", "peak_acceleration"),
    *("peak_drift", "drift_max", "drift_min"),
    *("peak_force", "impulse", "impact_count"),
    "peak_transmitted_force",
)
"""Results of each run."""
ENERGIES = ("total_supplied", "total_links", "total_damping", "total_stops", "total_stored")


class AssemblyRun(NamedTuple):
    """An assembly, a record, and the number that the record is multiplied by."""

    assembly: Assembly
    record: Record
    factor: float = 1.0


def response(
    run: AssemblyRun,
    tail: float | None,
    max_events: int,
    *,
    with_energies: bool = False,
    told: Callable[[int], None] | None = None,
) -> tuple[Status, dict[str, Any]]:
    """Return how a run ended, and its peaks (and energies) as variables; NaN if it was given up."""
    assembly, factor = run.assembly, run.factor
    record = run.record if factor == 1.0 else run.record.scaled(factor)
    after = free_tail(Rig(assembly, record)) if tail is None else tail
    if too_much_work(assembly, record, record.step):
        return Status.TOO_MUCH_WORK, _nothing(assembly, with_energies)
    nodes = NODES if with_energies else NODES_OF_RANGES
    measurer = Measurer(assembly, record, max_events, nodes)
    state = assembly_vector(assembly, equilibrium(assembly))
    found = measurer.follow(state, sections_of(record, after, 0.0), told)
    if found.status is not Status.DONE:
        return found.status, _nothing(assembly, with_energies)
    every = extremes(found, measurer.parts)
    values = {name: every[name] for name in PEAKS}
    return found.status, values | (energies(found, measurer.parts) if with_energies else {})


def _nothing(assembly: Assembly, with_energies: bool) -> dict[str, Any]:
    sizes = {name: len(found) for name, found in coordinates(assembly).items()}
    names = (*PEAKS, *(ENERGIES if with_energies else ()))
    return {
        name: (dim, np.full(sizes[dim], np.nan)) if dim else ((), np.nan)
        for name in names
        for dim in [VARIABLES[name].part]
    }


def check_alike(rigs: Runs) -> Assembly:
    """Return the first of some assemblies, whose parts have the same names.

    Raises
    ------
    InputError
        If one has other names, or is an oscillator, or has laws that are not accepted.
    """
    first = next(iter(rigs.rigs.values()))
    assert isinstance(first, Assembly)
    for name, one in rigs.rigs.items():
        if not isinstance(one, Assembly):
            raise InputError(
                f"rig[{name!r}]: an Oscillator beside an Assembly; pass rigs with the same parts"
            )
        check_laws(one)
        for part, names in coordinates(first).items():
            mine = coordinates(one)[part]
            if mine.tolist() != names.tolist():
                raise InputError(
                    f"rig[{name!r}]: its {part} names are {', '.join(mine) or 'none'}, not those "
                    f"of the first rig, {', '.join(names) or 'none'}; pass rigs with the same parts"
                )
    return first


def demands_of_assemblies(
    rigs: Runs,
    records: Sequence[Record],
    factors: _Array,
    tail: float | None,
    max_events: int,
    workers: Workers,
    progress: Progress | None,
) -> tuple[dict[str, Any], Mapping[str, _Array]]:
    """Compute the peaks of assemblies through scaled records.

    Parameters
    ----------
    factors : ndarray, shape (record, scale)
        What each record is multiplied by.
    tail, max_events, workers, progress
        As in `demands`.

    Returns
    -------
    variables, coordinates
        Variables with the dims ``record``, ``scale``, those of the rigs, and ``mass``, ``link`` or
        ``stop``.
    """
    first = check_alike(rigs)
    places = list(np.ndindex(*rigs.shape))
    systems = [rigs.system(at) for at in places]
    items = [
        AssemblyRun(system, record, float(factor))  # type: ignore[arg-type]
        for record, row in zip(records, factors, strict=True)
        for factor in row
        for system in systems
    ]

    def task(item: AssemblyRun, tally: Tally) -> tuple[Status, dict[str, Any]]:
        return response(item, tail, max_events)

    found = each(task, items, threads=workers, progress=progress)
    shape = (*factors.shape, *rigs.shape)
    dims = ("record", "scale", *rigs.dims)
    variables: dict[str, Any] = {}
    for name in PEAKS:
        dim = VARIABLES[name].part
        columns = [values[name][1] for _, values in found]
        whole = np.array(columns).reshape(*shape, *np.shape(columns[0]))
        variables[name] = ((*dims, dim) if dim else dims, whole)
    statuses = [int(status) for status, _ in found]
    variables["status"] = (dims, np.array(statuses, dtype=np.int64).reshape(shape))
    return variables, coordinates(first)


def seismic_response_of_assembly(
    rig: Rig, tail: float, max_events: int, progress: Progress | None
) -> tuple[Status, xr.Dataset]:
    """Return how the response of an assembly to its record ended, and its peaks and energies."""
    assembly, record = rig.system, rig.record
    assert isinstance(assembly, Assembly)
    check_laws(assembly)
    lines = len(sections_of(record, tail, 0.0).lines)

    def told(done: int) -> None:
        if progress is not None:
            progress(min(done, lines), lines)

    status, values = response(
        AssemblyRun(assembly, record), tail, max_events, with_energies=True, told=told
    )
    data = xr.Dataset(values, coordinates(assembly))
    data["status"] = int(status)
    return status, data
