"""Stepped-sine sweeps: resonance curves, forward and backward.

As in the experiment (the paper's Section 3), each frequency is held until the motion is steady. The
motion at the next frequency starts from the final state and phase.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import check_list
from vibroimpact.datasets.description import (
    describe,
    rig_parameters,
)
from vibroimpact.engine import batch
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, shown
from vibroimpact.model import State, to_si
from vibroimpact.model.argument_types import (
    MaxEvents,
    PositiveInt,
    Share,
)
from vibroimpact.model.periodic_shaking import as_periodic
from vibroimpact.model.public import public
from vibroimpact.model.quantities import ANGLE, FREQUENCY
from vibroimpact.model.quantity_lists import read_rising
from vibroimpact.model.read_rig import AnyRig, as_rigs
from vibroimpact.model.rig import Rig
from vibroimpact.response.assembly_rows import check_alike
from vibroimpact.response.curve_pair import DIRECTIONS
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.hold_rows import HoldRows, Settling
from vibroimpact.response.outputs import Outputs, about, read_outputs
from vibroimpact.response.plausibility import doubt_stops, note_stiff_stops, note_unbounded
from vibroimpact.response.sweep_arrays import plan_sweep, rows
from vibroimpact.response.sweep_dataset import sweep_dataset
from vibroimpact.response.sweep_outputs import add_sweep_outputs
from vibroimpact.tasks.executors import THREADS, workers_for
from vibroimpact.tasks.threads import Progress, each


@public
def sweep(
    rig: AnyRig,
    frequencies: Iterable[float | str],
    directions: Sequence[str] = DIRECTIONS,
    *,
    start: State | xr.DataArray | xr.Dataset | None = None,
    phase: float | str = 0.0,
    tolerance: Share = 1e-12,
    max_cycles: PositiveInt = 2000,
    window: PositiveInt = 500,
    max_events: MaxEvents = 10_000,
    outputs: Outputs | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Sweep the forcing frequency up and down, and hold each frequency until the motion is steady.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    frequencies
        Rising frequencies in Hz, or strings such as ``"2.5 Hz"``.
    directions
        Sweep directions: ``"forward"`` (rising frequency), ``"backward"`` (falling frequency) or
        both. Each of the two sweeps starts from ``start``.
    start, phase, tolerance, max_cycles, window, max_events, outputs, threads, progress
        As in `sweeps`.

    Returns
    -------
    xarray.Dataset
        The dims are ``direction`` and ``frequency``. A hold is the motion at one frequency in one
        direction. Its variables are extremes, excursions and peaks of the displacement, of the
        absolute acceleration and of the force transmitted to the base; ``eta_d`` and ``eta_a``;
        ``transmissibility``; contacts, forces and impulses of each stop (dim ``stop``: the stops of
        the rig, ``right`` and ``left``, or those of an assembly); ``section``, the state at the end
        of the hold; the ``outputs``, by their names; ``motion`` and ``status``.

        ``eta_d`` and ``eta_a`` do not depend on the swept range (the paper's Section 4). If the
        isolator has no damping, the largest excursions without stops do not exist, and the
        excursions are divided by 2A/ω0² and 2A. A motion that does not settle is ``"undecided"``,
        and its status is 1. To find its type, start `steady` from ``section``.

        Values are NaN only where ``status`` reports that there is no value.

        Of an assembly, displacements and accelerations have the additional dim ``mass``;
        ``simultaneous_impacts`` counts the impacts whose order the order of the stops decided.
        ``eta_d``, ``eta_a`` and ``transmissibility`` are those of an oscillator alone.

    Raises
    ------
    InputError
        If a value is invalid.
    """
    data = sweeps(
        [rig],
        frequencies,
        directions,
        start=start,
        phase=phase,
        tolerance=tolerance,
        max_cycles=max_cycles,
        window=window,
        max_events=max_events,
        outputs=outputs,
        threads=threads,
        progress=progress,
    )
    data = data.isel(rig=0, drop=True)
    data.attrs["created_by"] = "vibroimpact.sweep"
    return data


@public
def sweeps(
    rigs: Iterable[AnyRig] | Mapping[str, AnyRig] | AnyRig,
    frequencies: Iterable[float | str],
    directions: Sequence[str] = DIRECTIONS,
    *,
    start: State | xr.DataArray | xr.Dataset | None = None,
    phase: float | str = 0.0,
    tolerance: Share = 1e-12,
    max_cycles: PositiveInt = 2000,
    window: PositiveInt = 500,
    max_events: MaxEvents = 10_000,
    outputs: Outputs | None = None,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Sweep the forcing frequency of many rigs, in parallel.

    Parameters
    ----------
    rigs
        One or several rigs. Each is a `Rig`, a published case or its code such as ``"B2-G1-A3"``,
        or the path of a study file. If they are passed as a mapping, its keys are the names of the
        rigs.
    frequencies, directions
        As in `sweep`.
    start
        Initial state of each sweep. Default: the mass at rest.
    phase
        Phase φ of the base acceleration A sin(ωt + φ) at the stroboscopic section, in rad.
    tolerance
        Relative tolerance of a steady motion. A motion counts as steady when its state, recorded
        once per forcing cycle, is within this tolerance of a periodic orbit whose period is at most
        16 forcing cycles.
    max_cycles
        Largest number of forcing cycles to wait for a steady motion. If a motion is still
        approaching a periodic orbit by then, for example with light damping, the limit is increased
        up to 50-fold.
    window
        Number of forcing cycles over which a motion is measured if it did not become steady.
    max_events
        Largest number of events (contacts, detachments, yielding and turning points) in one forcing
        cycle. When a motion reaches this number, its computation is given up.
    outputs
        Own outputs, as a mapping from names to formulas, functions, or `Output` objects, such as
        ``{"top_speed": "max(abs(velocity))"}``. Each is computed from one period of the motion at
        each frequency, or from ``window`` cycles of a motion that did not settle.
    threads
        Number of threads (default: one per processor).
    where
        ``"threads"``, ``"processes"``, or a dask cluster: a ``distributed.Client`` or the address
        of its scheduler (docs/how-to/many-machines.md). Neither ``where`` nor ``threads`` affects
        the result.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the completed work
        and the total work.

    Returns
    -------
    xarray.Dataset
        As in `sweep`, with the additional first dim ``rig``. Several assemblies must have masses
        and stops of the same names.

    Raises
    ------
    InputError
        If a value is invalid.
    """
    named = periodic_rigs(rigs)
    systems = {name: rig.system for name, rig in named.items()}
    if any(one.by_mass for one in systems.values()):
        check_alike(systems, "rigs", "mass", "stop")
    names, pairs = list(named), list(named.values())
    grid = check_frequencies(frequencies)
    directions = _directions(directions)
    angle = to_si(phase, ANGLE, "phase")
    starts = [None if start is None else engine_system(rig.system).read(start) for rig in pairs]
    if starts[0] is not None and starts[0].phase is not None:
        angle = starts[0].phase
    settling = Settling(tolerance, max_cycles, window, max_events)
    workers = workers_for(threads, where)

    own = [read_outputs(outputs, rig) for rig in pairs]
    ready = [plan_sweep(rig, grid, one) for rig, one in zip(pairs, starts, strict=True)]

    batch.sweep.prepare(*(one.rig for one in ready))  # once, before the threads would queue for it
    items = [(one, direction) for one in ready for direction in directions]
    steps = len(grid) * len(items)
    total = 2 * steps if outputs else steps
    done = each(
        lambda item, tally: rows(*item, angle, settling, tally),
        items,
        steps=steps,
        threads=workers,
        progress=progress and (lambda done, _: progress(done, total)),
    )
    shape = (len(pairs), len(directions), len(grid))
    results = np.array([hold_rows for hold_rows, _ in done]).reshape(*shape, -1)
    states = np.array([reached for _, reached in done]).reshape(*shape, -1)
    del done  # as large as both
    about_sweeps = {
        "rigs": [rig_parameters(rig, "frequency", "phase") for rig in pairs],
        "phase": angle,
        **settling._asdict(),
        **about(own[0]),
    }
    doubts: list[str] = []
    for r, rig in enumerate(pairs):
        held, hardest = HoldRows(results[r]), rig.hardest
        swing = held.peak_displacement
        held.status[...] = engine_system(rig.system).judged(held.status, swing)
        doubts += [
            *doubt_stops(hardest, swing),
            *note_unbounded(hardest),
            *note_stiff_stops(hardest, float(grid[0])),
        ]
    doubts += engine_system(pairs[0].system).doubts_of_rows(results, "motions")
    data = sweep_dataset([rig.system for rig in pairs], ready, results, states, angle)
    data = data.assign_coords(rig=names, direction=list(directions), frequency=grid)
    if outputs:
        levels = [one.levels for one in ready]
        add_sweep_outputs(data, own, pairs, levels, angle, states, window, workers, progress)
    return describe(data, "vibroimpact.sweeps", about_sweeps, dict.fromkeys(doubts), own[0])


def check_frequencies(frequencies: Iterable[float | str]) -> NDArray[np.float64]:
    """Read frequencies in Hz: at least one, positive, rising.

    Raises
    ------
    InputError
        If they are not; the message has the position and the value of the first wrong one.
    """
    return read_rising(frequencies, FREQUENCY, "frequencies", above=0.0)


def periodic_rigs(rigs: Any) -> dict[str, Rig]:
    """Read one or several rigs, each with a periodic shaking, by their names.

    Raises
    ------
    InputError
        If there is none, or one is invalid.
    """
    named_rigs = as_rigs(rigs)
    for name, rig in named_rigs.items():
        as_periodic(rig.shaking, "shaking" if len(named_rigs) == 1 else f"rigs[{name}].shaking")
    return named_rigs


def _directions(directions: Sequence[str]) -> tuple[str, ...]:
    names = (directions,) if isinstance(directions, str) else check_list(directions, "directions")
    for direction in names:
        if not isinstance(direction, str) or direction not in DIRECTIONS:
            raise InputError(
                f"directions: {shown(direction)}; pass 'forward', 'backward' or a list of both"
            )
    if not names or len(set(names)) < len(names):
        raise InputError(
            f"directions: {list(names)!r}; pass 'forward', 'backward' or both, each only once"
        )
    return names


def advice(data: xr.Dataset) -> list[str]:
    """Return the advice for frequencies whose motion did not end well; empty if all did."""
    codes, counts = np.unique(data["status"].values, return_counts=True)
    return [
        f"{count} of {data['status'].size} frequency steps: {Status(code).advice}"
        for code, count in zip(codes, counts, strict=True)
        if Status(code) is not Status.DONE
    ]
