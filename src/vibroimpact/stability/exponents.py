"""Lyapunov exponents from the exact tangent flow, over many rigs and frequencies at once."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from vibroimpact.arguments import VALUES, check_mapping, check_progress
from vibroimpact.datasets.description import describe, rig_parameters
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.model import Rig, State, to_si
from vibroimpact.model.count_checks import check_max_events, whole
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.model.quantities import ANGLE
from vibroimpact.model.read_rig import AnyRig
from vibroimpact.model.varied import Varied, varied, vary_all
from vibroimpact.response.analytic_free_response import check_bounded
from vibroimpact.response.engine_input import as_state
from vibroimpact.response.prepared_rig import PreparedRig, prepare
from vibroimpact.response.sweep import check_frequencies, periodic_rigs
from vibroimpact.stability.block_averages import Averaged
from vibroimpact.tasks.executors import THREADS, placed
from vibroimpact.tasks.threads import DONE, Progress, Tally, each

DISCARD = 100
"""Cycles in which the disturbances turn into their directions."""


class _Grown(NamedTuple):
    """What one motion shows, per second."""

    exponents: NDArray[np.float64]
    uncertainty: NDArray[np.float64]
    damping: float
    cycles: int
    status: Status
    settling: bool


def lyapunov_exponents(
    rigs: Iterable[AnyRig] | Mapping[str, AnyRig] | AnyRig,
    frequencies: Iterable[float | str],
    cycles: int = 1000,
    *,
    transient: int = 500,
    start: State | xr.DataArray | xr.Dataset | None = None,
    vary: Mapping[str, ArrayLike] | None = None,
    phase: float | str = 0.0,
    max_events: int = 10_000,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Find the two largest Lyapunov exponents of many motions, in parallel over threads.

    Disturbances go through each phase by its closed form and through contacts and detachments
    by their saltation matrices (docs/theory.md, section 6). Nothing waits for a motion to
    settle: of a motion that does, the exponents are those of its orbit only if ``transient`` is
    long enough.

    Parameters
    ----------
    rigs
        Each a `Rig`, a laboratory case, its code, or the path of a study file; the keys of a
        mapping name them.
    frequencies
        Excitation frequencies in Hz, rising.
    cycles
        Forcing cycles over which the growth is averaged.
    transient
        Forcing cycles before that; another 100 are used to turn the disturbances.
    start
        Where every motion starts; None is rest.
    vary
        Values of parameters by name, as of `branch`, all combined: ``{"gap": [5e-3, 6e-3]}``.
    phase
        Phase φ of the base acceleration A sin(ωt + φ) at the start, in rad.
    max_events
        Contacts and detachments in one forcing cycle at which a motion is given up.
    threads
        How many motions run at once; None for one a processor. No result depends on it.
    where
        ``"threads"``, ``"processes"``, or a dask cluster, as of `scenario_map`. No result depends
        on it.
    progress
        Called from the calling thread with the forcing cycles done and all, those of ``transient``
        and of the directions included.

    Returns
    -------
    xarray.Dataset
        Dims ``rig``, ``frequency``, one for each parameter that is varied, and ``exponent`` (the
        largest first): ``exponents`` in 1/s,
        their ``exponents_uncertainty`` (of the mean, from 32 blocks of cycles; infinite with
        fewer cycles), ``effective_damping``, ``exponents_cycles``, ``status``, and ``settling``:
        whether the motion still came closer to a periodic one, of which a warning tells.

    Raises
    ------
    InputError
        If a value cannot be used.
    """
    check_progress(progress)
    named = periodic_rigs(rigs)
    names, pairs = list(named), list(named.values())
    grid = check_frequencies(frequencies)
    angle = to_si(phase, ANGLE, "phase")
    state = None if start is None else as_state(start)
    if state is not None and state.phase is not None:
        angle = state.phase
    cycles, transient = whole(cycles, "cycles"), whole(transient, "transient", 0)
    max_events = check_max_events(max_events)
    workers = placed(threads, where)
    first = pairs[0].oscillator
    every = tuple(
        varied(name, values, first, f"vary[{name!r}]", ("frequency",), "has an argument of its own")
        for name, values in check_mapping({} if vary is None else vary, "vary", VALUES).items()
    )
    shape = (len(pairs), len(grid), *(len(one.values) for one in every))
    items = [
        _rig_at(pairs[r], grid, i, angle, zip(every, at, strict=True))
        for r, i, *at in np.ndindex(shape)
    ]
    engines = [prepare(item) for item in items]

    steps = transient + DISCARD + cycles

    def follow(engine: PreparedRig, tally: Tally) -> _Grown:
        here = engine.shaking
        frequency = here.frequency
        kept = Averaged(cycles)

        def count(done: int, _: int | None) -> None:
            tally[DONE] = done

        status = engine.grow(
            engine.state(state),
            cycles,
            kept.add,
            max_events,
            transient=transient,
            discard=DISCARD,
            progress=count,
        )
        tally[DONE] = steps
        if not kept.done:
            nothing = np.full(2, np.nan)
            return _Grown(nothing, nothing, math.nan, 0, status, False)
        mean, spread = kept.exponents()
        size = np.array([1.0, here.angular_frequency, 1.0, 1.0, 1.0])
        return _Grown(
            mean * frequency,
            spread * frequency,
            kept.damping() * frequency,
            kept.done,
            status,
            kept.is_settling(size),
        )

    lyapunov.growth.prepare(
        *(engine.vector for engine in engines)
    )  # once, before threads would queue
    found = each(
        follow,
        engines,
        steps=steps * len(items),
        threads=workers,
        progress=progress,
    )
    dims = ("rig", "frequency", *(one.name for one in every))
    rates = {
        "exponents": [f.exponents for f in found],
        "exponents_uncertainty": [f.uncertainty for f in found],
    }
    data = xr.Dataset(
        {
            **{
                name: ((*dims, "exponent"), np.reshape(values, (*shape, 2)))
                for name, values in rates.items()
            },
            "effective_damping": (dims, np.reshape([f.damping for f in found], shape)),
            "exponents_cycles": (dims, np.reshape([f.cycles for f in found], shape)),
            "settling": (dims, np.reshape([f.settling for f in found], shape)),
            "status": (dims, np.reshape([int(f.status) for f in found], shape)),
        },
        coords={"rig": names, "frequency": grid, **{one.name: one.values for one in every}},
    )
    parameters: dict[str, Any] = {
        "rigs": [rig_parameters(rig, "frequency", "phase") for rig in pairs],
        "varied": {one.name: one.values.tolist() for one in every},
        "phase": angle,
        "cycles": cycles,
        "transient": transient,
        "max_events": max_events,
    }
    data = describe(data, "vibroimpact.lyapunov_exponents", parameters)
    if count := sum(f.settling for f in found):
        warnings.warn(
            f"{count} of {len(found)} motions still approach a periodic one after "
            f"{transient} + {DISCARD} cycles: their exponents are not those of its orbit; a larger "
            "transient is accepted; `settling` tells which",
            RuntimeWarning,
            stacklevel=2,
        )
    for one in every:
        data[one.name].attrs.update(units=one.units, long_name=one.long_name)
    return data


def _rig_at(
    rig: Rig,
    grid: NDArray[np.float64],
    i: int,
    phase: float,
    values: Iterable[tuple[Varied, int]],
) -> Rig:
    """A rig and its forcing at one of the frequencies and a value of each parameter."""
    numbers = [(PARAMETERS[one.name], float(one.values[k])) for one, k in values]
    here = rig.periodic.replace(frequency=float(grid[i]), phase=phase)
    moved = vary_all(Rig(rig.oscillator, here), numbers)
    check_bounded(moved, f"frequencies[{i}]")
    return moved
