"""Lyapunov exponents from the exact linearised flow, for many rigs and frequencies."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, rig_parameters
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.errors import warn_of_result
from vibroimpact.model import AssemblyState, Rig, State, to_si
from vibroimpact.model.argument_types import (
    MaxEvents,
    NonNegativeInt,
    PositiveInt,
    whole,
)
from vibroimpact.model.parameter_ranges import ParameterValues, Values, read_values
from vibroimpact.model.parameters import set_values
from vibroimpact.model.public import public
from vibroimpact.model.quantities import ANGLE
from vibroimpact.model.read_rig import AnyRig
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.prepared_rig import PreparedRig, prepare
from vibroimpact.response.sweep import check_frequencies, periodic_rigs
from vibroimpact.stability.block_averages import Averaged
from vibroimpact.stability.settled_motion import section_sizes
from vibroimpact.tasks.executors import THREADS, workers_for
from vibroimpact.tasks.threads import DONE, Progress, Tally, each

DISCARD = 100
"""Cycles in which the disturbances align with their directions."""


class _Grown(NamedTuple):
    """Results of one motion, per second."""

    exponents: NDArray[np.float64]
    uncertainty: NDArray[np.float64]
    damping: float
    cycles: int
    status: Status
    settling: bool


@public
def lyapunov_exponents(
    rigs: Iterable[AnyRig] | Mapping[str, AnyRig] | AnyRig,
    frequencies: Iterable[float | str],
    cycles: PositiveInt = 1000,
    *,
    transient: NonNegativeInt = 500,
    start: State | xr.DataArray | xr.Dataset | None = None,
    vary: Values | None = None,
    count: PositiveInt | None = None,
    phase: float | str = 0.0,
    max_events: MaxEvents = 10_000,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute the largest Lyapunov exponents of many motions in parallel.

    Small disturbances are propagated exactly: in closed form between events, and by saltation
    matrices at contacts and detachments (docs/theory.md, section 6). The computation does not wait
    until a motion becomes periodic. If a motion does become periodic, its exponents are the
    exponents of the orbit only if ``transient`` is long enough.

    Parameters
    ----------
    rigs
        One or several rigs. Each is a `Rig`, a published case or its code such as ``"B2-G1-A3"``,
        or the path of a study file. If they are passed as a mapping, its keys are the names of the
        rigs. A `Rig` may have an `Assembly`.
    frequencies
        Rising forcing frequencies, in Hz.
    cycles
        Number of forcing cycles over which the growth of disturbances is averaged.
    transient
        Number of forcing cycles before the averaging starts. Another 100 forcing cycles are used to
        align the disturbances.
    start
        Initial state of each motion. Default: the mass at rest.
    vary
        Parameters that are varied, as a mapping from names to values, such as
        ``{"gap": [5e-3, 6e-3]}``. The names are those of `branch`. All combinations of the values
        are computed.
    count
        Number of exponents, at most two for each mass. Default: two for each mass, which are those
        of its displacement and velocity.
    phase
        Phase φ of the base acceleration A sin(ωt + φ) at the start, in rad.
    max_events
        Largest number of events (contacts, detachments, yielding and turning points) in one forcing
        cycle. When a motion reaches this number, its computation is given up.
    threads
        Number of threads (default: one per processor).
    where
        ``"threads"``, ``"processes"``, or a dask cluster: a ``distributed.Client`` or the address
        of its scheduler (docs/how-to/many-machines.md). Neither ``where`` nor ``threads`` affects
        the result.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the completed and
        the total number of forcing cycles. Both include the cycles of ``transient`` and of the
        alignment.

    Returns
    -------
    xarray.Dataset
        The dims are ``rig``, ``frequency``, one dim for each parameter that is varied, and
        ``exponent`` (the largest exponent first). The variables are:

        - ``exponents``, in 1/s. If the rigs have different numbers of masses, NaN fills the rest;
        - ``exponents_uncertainty``, the uncertainty of the mean, estimated from 32 blocks of
          cycles. It is infinite if there are fewer than 32 cycles;
        - ``effective_damping``, the mean damping per unit mass, in 1/s;
        - ``exponents_cycles``, the number of averaged forcing cycles, and ``status``;
        - ``settling``: whether the motion was still converging to a periodic motion. In that case a
          warning is issued.

    Raises
    ------
    InputError
        If a value is invalid.
    """
    named = periodic_rigs(rigs)
    names, pairs = list(named), list(named.values())
    grid = check_frequencies(frequencies)
    angle = to_si(phase, ANGLE, "phase")
    starts = [_start(rig, start) for rig in pairs]
    for one in starts:
        if one is not None and one.phase is not None:
            angle = one.phase
    workers = workers_for(threads, where)
    counts = [2 * engine_system(rig.system).masses for rig in pairs]
    if count is not None:
        asked = whole(count, "count", most=max(counts))
        counts = [min(asked, one) for one in counts]
    every = read_values(
        vary, pairs[0], but=("frequency",), why="is set by the argument frequencies"
    )
    shape = (len(pairs), len(grid), *(len(one.values) for one in every))
    items = [
        (r, prepare(_rig_at(pairs[r], grid, i, angle, zip(every, at, strict=True))))
        for r, i, *at in np.ndindex(shape)
    ]

    steps = transient + DISCARD + cycles

    def follow(item: tuple[int, PreparedRig], tally: Tally) -> _Grown:
        r, engine = item
        here, states = engine.shaking, engine.states
        frequency = here.frequency
        kept = Averaged(cycles, states.parts, counts[r])

        def count_done(done: int, _: int | None) -> None:
            tally[DONE] = done

        status = engine.grow(
            engine.state(starts[r]),
            cycles,
            kept.add,
            max_events,
            transient=transient,
            discard=DISCARD,
            count=counts[r],
            progress=count_done,
        )
        tally[DONE] = steps
        if not kept.done:
            nothing = np.full(counts[r], np.nan)
            return _Grown(nothing, nothing, math.nan, 0, status, False)
        mean, spread = kept.exponents()
        return _Grown(
            mean * frequency,
            spread * frequency,
            kept.damping() * frequency,
            kept.done,
            status,
            kept.is_settling(section_sizes(engine)),
        )

    lyapunov.growth.prepare(
        *(engine.vector for _, engine in items)
    )  # once, before threads would queue
    motions = each(
        follow,
        items,
        steps=steps * len(items),
        threads=workers,
        progress=progress,
    )
    dims = ("rig", "frequency", *(one.name for one in every))
    most = max(counts)

    def filled(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.append(values, np.full(most - len(values), np.nan))

    rates = {
        "exponents": [filled(f.exponents) for f in motions],
        "exponents_uncertainty": [filled(f.uncertainty) for f in motions],
    }
    data = xr.Dataset(
        {
            **{
                name: ((*dims, "exponent"), np.reshape(values, (*shape, most)))
                for name, values in rates.items()
            },
            "effective_damping": (dims, np.reshape([f.damping for f in motions], shape)),
            "exponents_cycles": (dims, np.reshape([f.cycles for f in motions], shape)),
            "settling": (dims, np.reshape([f.settling for f in motions], shape)),
            "status": (dims, np.reshape([int(f.status) for f in motions], shape)),
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
    data = describe(data, "vibroimpact.lyapunov_exponents", parameters, varied=every)
    if count := sum(f.settling for f in motions):
        warn_of_result(
            f"{count} of {len(motions)} motions were still converging to a periodic motion after "
            f"{transient + DISCARD} cycles, so their exponents are not those of the periodic "
            f"motion; pass a transient larger than {transient}; `settling` marks these motions"
        )
    return data


def _start(rig: Rig, start: Any) -> State | AssemblyState | None:
    """Return the initial state of a rig; None for its rest."""
    engine_system(rig.system).check_size()
    return None if start is None else engine_system(rig.system).read(start)


def _rig_at(
    rig: Rig,
    grid: NDArray[np.float64],
    i: int,
    phase: float,
    values: Iterable[tuple[ParameterValues, int]],
) -> Rig:
    """Return the rig at one of the frequencies and one value of each parameter."""
    numbers = {one.name: float(one.values[k]) for one, k in values}
    size = float(rig.levels(len(grid))[i])
    here = rig.hardest.periodic.replace(amplitude=size, frequency=float(grid[i]), phase=phase)
    moved = set_values(Rig(rig.system, here), numbers)
    engine_system(moved.system).check_bounded(moved, f"frequencies[{i}]")
    return moved
