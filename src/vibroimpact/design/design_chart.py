"""Displacement, acceleration and contact force of many designs as one dataset."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, system_parameters
from vibroimpact.datasets.stops import each_by_stop, has_stops, shared_part_names
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.design.design_shaking import (
    PEAKS,
    AnyRecords,
    ByRecords,
    design_system,
    split_frequency,
)
from vibroimpact.design.limits import limits_of, severity
from vibroimpact.design.pareto import non_dominated
from vibroimpact.design.worst_sine import STEP
from vibroimpact.earthquakes.demands import warn_given_up
from vibroimpact.earthquakes.run_plan import Runs, runs
from vibroimpact.model.argument_types import Fractile, Share, Tail
from vibroimpact.model.parameter_ranges import Values
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import RigOrSystem
from vibroimpact.model.system import System
from vibroimpact.tasks.executors import THREADS, workers_for
from vibroimpact.tasks.threads import Progress

_STIFFNESSES = {
    "stops.stiffness",
    "proportional_stiffness",
    "stiffness_at_restitution",
    "stiffness_ratio",
}


@public
def design_chart(
    rig: RigOrSystem,
    vary: Values,
    *,
    records: AnyRecords | None = None,
    limits: Mapping[str, float | str] | None = None,
    fractile: Fractile = 1.0,
    step: Share = STEP,
    tail: Tail | None = None,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute how displacement and acceleration depend on the design parameters of a rig.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
        If a sine shakes the rig, the frequency is swept up and down, and the largest steady
        response over all frequencies is reported. If a record shakes the rig, the response of the
        motion from rest is reported.
    vary
        Parameters that are varied, as a mapping from names to values. All combinations of the
        values are computed. Names are, for example, ``"gap"``, ``"stops.stiffness"``,
        ``"stops.damping"``, ``"isolator_period"``, ``"damping_ratio"`` and
        ``"isolator.yield_force"``. A parameter of stops is set on both sides, if the stop there has
        this parameter. If ``"stops.stiffness"`` is varied, the damping of the bumpers stays
        constant. If ``"stiffness_at_restitution"`` is varied, the damping changes so that the
        coefficient of restitution stays constant. ``"frequency"`` is the lowest and the highest
        frequency (Hz) of the sine, ``(low, high)``, and not a dim of the result. Its default is a
        range around the primary resonance of each design. An assembly, which has several
        resonances, has no default.
    records
        One record, or several as a list or as a mapping from names to records. They replace the
        shaking of the rig, and the rig may then be an `Oscillator` or an `Assembly` alone. The
        motion through each
        record starts from rest, and the records are not scaled. The result is a fractile over the
        records; see ``fractile``.
    limits
        Largest accepted values, by name: ``"peak_force"`` (N) of each stop, ``"penetration"``,
        ``"peak_displacement"`` and ``"displacement_max"`` (m). ``"displacement_min"`` (m) is the
        lowest accepted value, at most 0. Of an assembly, a limit holds for each mass, stop or link,
        or for one of them, such as ``"peak_force.moat"``; ``"peak_drift"`` is accepted for records,
        and ``"penetration"`` is not.
        A design that exceeds a limit is reported like the others, but it cannot be in the Pareto
        front ``pareto``.
    fractile
        Share of the records whose response is below the reported value, from 0 to 1. 1 gives the
        largest response of all records. The fractile is computed for each quantity separately, by
        interpolation between the records. These fractiles are compared with the limits.
    step
        Frequency step of the sweeps, as a share of the lowest natural frequency. The step is
        smaller if the damping is light. Near the largest responses the steps are 64 times as fine.
    tail
        Duration of free vibration after the record, in s; see `seismic_response`.
    threads
        Number of threads (default: one per processor).
    where
        ``"threads"``, ``"processes"``, or a dask cluster: a ``distributed.Client`` or the address
        of its scheduler (docs/how-to/many-machines.md). Neither ``where`` nor ``threads`` affects
        the result.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the completed and
        the total number of designs.

    Returns
    -------
    xarray.Dataset
        The dataset has one dim for each parameter that is varied. Its variables are
        ``peak_displacement``, ``displacement_max``, ``displacement_min``, ``peak_acceleration``,
        ``peak_force`` (dim ``stop``), ``penetration``, ``hitting``, ``pareto``, ``within_limits``
        if there are limits, ``stops.damping`` if a stiffness of both bumpers is varied, and
        ``status``. If the computation of a design was given up, its values are NaN. If a motion is
        unbounded, the values are infinite. Among designs with equal responses, such as designs
        without contact, ``pareto`` marks only the first one.

        For sines there are also ``displacement_frequency`` and ``acceleration_frequency``, the
        frequencies of the largest values. Of an assembly, displacements, accelerations and these
        frequencies have the dim ``mass``, and forces the dim ``stop``. For records, ``peak_drift``
        has the dim ``link``. ``pareto`` compares the largest values of all masses, and there is no
        ``penetration``. ``unsettled_count`` is the number of frequency steps at
        which no periodic motion was reached. At such a step the peaks are those of 100 forcing
        cycles.

    Raises
    ------
    InputError
        If a value is invalid.
    """
    vary, frequencies = split_frequency(vary)
    system, what = design_system(rig, records, frequencies, fractile=fractile, step=step, tail=tail)
    plan = runs(system, vary, least=1)
    workers = workers_for(threads, where)
    rigs = [plan.system(at) for at in np.ndindex(*plan.shape)]
    known = [name for name in PEAKS if not system.by_mass or VARIABLES[name].part]
    if system.by_mass and isinstance(what, ByRecords):
        known.append("peak_drift")
    parts: dict[str, list[str]] = {}
    if system.by_mass:
        parts = {name: system.part_names[VARIABLES[name].part].tolist() for name in known}
    most = limits_of(limits, known, parts)
    responses = what.peaks(rigs, workers, progress)
    data = _dataset(plan, rigs, {**responses, **_dampings(plan, rigs)}, most)
    warn_given_up(data["status"].values, "design", "designs")
    parameters = {
        **system_parameters(system),
        "varied": {one.name: one.values.tolist() for one in plan.varied},
        "limits": most,
        **what.parameters(),
    }
    return describe(data, "vibroimpact.design_chart", parameters, what.notes(), plan.varied)


def _dampings(plan: Runs, rigs: list[System]) -> dict[str, NDArray[Any]]:
    """Return the damping of all bumpers along the varied stiffness, if they share one."""
    names = {one.name for one in plan.varied}
    if "stops.damping" in names or not names & _STIFFNESSES:
        return {}
    laws = [rig.stop_laws.values() for rig in rigs]
    every = [{pair[1] for stop in some if (pair := stop.spring_and_dashpot)} for some in laws]
    if any(len(one) != 1 for one in every):
        return {}
    return {"stops.damping": np.array([one.pop() for one in every])}


def _dataset(
    plan: Runs,
    rigs: list[System],
    responses: Mapping[str, NDArray[Any]],
    limits: Mapping[str, float],
) -> xr.Dataset:
    """Return the results of all designs, over the parameters that were varied."""
    within, first = np.ones(responses["status"].shape, dtype=bool), rigs[0]
    for name, limit in limits.items():
        base, _, part = name.partition(".")
        values: Any = responses[base]
        if part:
            values = values[:, first.part_names[VARIABLES[base].part].tolist().index(part)]
        within &= severity(name, values) <= severity(name, limit)
    u, a = (
        np.where(within, severity(name, responses[name]), np.nan)
        for name in ("peak_displacement", "peak_acceleration")
    )
    own = {"pareto": non_dominated(u, a), **({"within_limits": within} if limits else {})}
    names = shared_part_names(rigs)
    shaped = {}
    for name, values in {**responses, **own}.items():
        dims = plan.dims
        if first.by_mass:
            dims += (part,) if (part := VARIABLES[name].part) else ()
        elif has_stops(name):
            dims, values = (*dims, "stop"), each_by_stop(rigs, values, names["stop"])
        shaped[name] = (dims, values.reshape(*plan.shape, *values.shape[1:]))
    varied = {one.name: one.values for one in plan.varied}
    used = {dim for dims, _ in shaped.values() for dim in dims}
    return xr.Dataset(shaped, {**{k: v for k, v in names.items() if k in used}, **varied})
