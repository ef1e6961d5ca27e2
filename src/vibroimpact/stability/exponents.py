"""Lyapunov exponents from the exact tangent flow, over many rigs and frequencies at once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.engine import lyapunov
from vibroimpact.model import State, equilibrium, to_si
from vibroimpact.model.counts import whole
from vibroimpact.model.quantities import ANGLE
from vibroimpact.model.rigs import AnyRig
from vibroimpact.response.follow import grown
from vibroimpact.response.free_flight import check_bounded
from vibroimpact.response.start import as_state, engine_rig, engine_state
from vibroimpact.response.sweep import check_frequencies, named_rigs
from vibroimpact.response.threads import Progress, run
from vibroimpact.response.variables import describe, excitation_parameters, oscillator_parameters
from vibroimpact.stability.kind import averages

DISCARD = 100
"""Cycles in which the disturbances turn into their directions."""


def lyapunov_exponents(
    rigs: Sequence[AnyRig] | Mapping[str, AnyRig] | AnyRig,
    frequencies: Iterable[float | str],
    cycles: int = 1000,
    *,
    transient: int = 500,
    start: State | xr.DataArray | xr.Dataset | None = None,
    phase: float | str = 0.0,
    max_events: int = 10_000,
    threads: int | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Find the two largest Lyapunov exponents of many motions, in parallel over threads.

    Disturbances go through each phase by its closed form and through contacts and detachments
    by their saltation matrices (docs/theory.md, section 6). Nothing waits for a motion to
    settle: of a motion that does, the exponents are those of its orbit only if `transient` is
    long enough.

    Parameters
    ----------
    rigs
        Laboratory cases or their codes, `Rig`s or (oscillator, amplitude) pairs; as a mapping, its
        keys name the rigs.
    frequencies
        Excitation frequencies in Hz, rising.
    cycles
        Forcing cycles over which the growth is averaged.
    transient
        Forcing cycles before that; another 100 are used to turn the disturbances.
    start
        Where every motion starts; None is rest.
    phase
        Phase φ of the base acceleration A sin(ωt + φ) at the start, in rad.
    max_events
        Contacts and detachments in one forcing cycle at which a motion is given up.
    threads
        How many motions run at once; None for one a processor. No result depends on it.
    progress
        Called from the calling thread with the motions done and all.

    Returns
    -------
    xarray.Dataset
        Dims ``rig``, ``frequency`` and ``exponent`` (the largest first): ``exponents`` in 1/s,
        their ``exponents_uncertainty`` (of the mean, from 32 blocks of cycles; infinite with
        fewer cycles), ``effective_damping``, ``exponents_cycles`` and ``status``.

    Raises
    ------
    InputError
        If a value cannot be used.
    """
    names, pairs = named_rigs(rigs)
    grid = check_frequencies(frequencies)
    angle = to_si(phase, ANGLE, "phase")
    state = None if start is None else as_state(start)
    if state is not None and state.phase is not None:
        angle = state.phase
    cycles, transient = whole(cycles, "cycles"), whole(transient, "transient", 0)
    max_events = whole(max_events, "max_events")
    threads = None if threads is None else whole(threads, "threads")
    prepared = []
    for oscillator, shaken, _ in pairs:
        for i, frequency in enumerate(grid):
            check_bounded(oscillator, shaken.replace(frequency=frequency), f"frequencies[{i}]")
        prepared.append(
            (
                engine_rig(oscillator, shaken),
                shaken,
                engine_state(oscillator, state or equilibrium(oscillator)),
            )
        )

    shape = (len(pairs), len(grid))
    exponents = np.full((*shape, 2), np.nan)
    uncertainty = np.full((*shape, 2), np.nan)
    damping = np.full(shape, np.nan)
    used = np.zeros(shape, dtype=np.int64)
    outcomes = np.zeros(shape, dtype=np.int64)
    counter = np.zeros((len(pairs) * len(grid), 2), dtype=np.int64)

    def one(task: int) -> None:
        r, i = divmod(task, len(grid))
        rig, shaken, begin = prepared[r]
        if counter[task, 1]:
            return
        here = shaken.replace(frequency=float(grid[i]), phase=angle)
        outcomes[r, i], rows = grown(
            rig, here, begin.copy(), cycles, max_events, transient=transient, discard=DISCARD
        )
        used[r, i] = len(rows)
        if len(rows):
            mean, spread = averages(rows[:, : lyapunov.DISSIPATION])
            exponents[r, i], uncertainty[r, i] = mean * grid[i], spread * grid[i]
            damping[r, i] = rows[:, lyapunov.DISSIPATION].mean() * grid[i]
        counter[task, 0] = 1

    lyapunov.growth.prepare(*(rig for rig, _, _ in prepared))  # once, before threads would queue
    run(one, counter, len(counter), threads, progress)
    dims = ("rig", "frequency")
    data = xr.Dataset(
        {
            "exponents": ((*dims, "exponent"), exponents),
            "exponents_uncertainty": ((*dims, "exponent"), uncertainty),
            "effective_damping": (dims, damping),
            "exponents_cycles": (dims, used),
            "status": (dims, outcomes),
        },
        coords={"rig": names, "frequency": grid},
    )
    parameters: dict[str, Any] = {
        "rigs": [
            {
                "oscillator": oscillator_parameters(oscillator),
                **excitation_parameters(shaken, "frequency", "phase"),
            }
            for oscillator, shaken, _ in pairs
        ],
        "phase": angle,
        "cycles": cycles,
        "transient": transient,
        "max_events": max_events,
    }
    return describe(data, "vibroimpact.lyapunov_exponents", parameters)
