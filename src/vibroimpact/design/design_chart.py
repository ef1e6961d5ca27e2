"""Displacement, acceleration and contact force of many designs as one dataset."""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from vibroimpact.arguments import check_progress
from vibroimpact.datasets.description import describe, oscillator_parameters
from vibroimpact.design.design_shaking import AnyRecords, design_rig
from vibroimpact.design.limits import limits_of
from vibroimpact.design.pareto import non_dominated
from vibroimpact.design.worst_sine import STEP
from vibroimpact.earthquakes.run_plan import Runs, runs
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Oscillator
from vibroimpact.model.read_rig import AnyRig
from vibroimpact.tasks.executors import THREADS, placed
from vibroimpact.tasks.threads import Progress

_STIFFNESSES = {
    "bumper_stiffness",
    "proportional_stiffness",
    "stiffness_at_restitution",
    "stiffness_ratio",
}


def design_chart(
    rig: AnyRig | Oscillator,
    vary: Mapping[str, ArrayLike],
    *,
    records: AnyRecords | None = None,
    limits: Mapping[str, float | str] | None = None,
    fractile: float = 1.0,
    frequency_span: tuple[float | str, float | str] | None = None,
    step: float = STEP,
    tail: float | str | None = None,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute the trade-off between displacement and acceleration over parameters of a rig.

    Parameters
    ----------
    rig
        The rig: a `Rig`, a laboratory case, its code, or the path of a study file.
        If a sine shakes it, the largest steady motion over all frequencies counts, swept up and
        down. If a record shakes it, the motion from rest counts.
    vary
        Values of parameters by name, in all combinations, such as ``"gap"``,
        ``"bumper_stiffness"``, ``"bumper_damping"``, ``"isolator_period"``, ``"damping_ratio"`` or
        ``"yield_force"``. Parameters of stops are set on both sides, if the stop has them.
        ``"bumper_stiffness"`` keeps the damping of the bumpers; ``"stiffness_at_restitution"``
        changes it so that the restitution is the same.
    records
        A record, or several by name or as a list, which replace the shaking of the rig. The rig may
        then be an `Oscillator` alone. Each run starts from rest, with the record unscaled, and the
        fractile over the records counts.
    limits
        Largest accepted values, by name: ``"peak_force"`` (N), ``"penetration"`` (m),
        ``"peak_displacement"`` (m; ``_right``, ``_left``). A design that exceeds a limit is
        reported like the others, but is excluded from ``pareto``.
    fractile
        Share of the records below the reported value; 1 for the largest of all. It is computed for
        each quantity separately, by interpolation between records, and is compared with the limits.
    frequency_span
        Lowest and highest forcing frequency (Hz). Default: a range around the primary resonance of
        each design.
    step
        Step of the sweeps, as a share of the natural frequency. It is smaller for light damping,
        and 64 times as fine near the largest responses.
    tail
        Duration of free vibration after the record (s); see `seismic_response`.
    threads
        Number of threads (default: one per processor). It does not affect the result.
    where
        ``"threads"``, ``"processes"``, or a dask cluster, as in `scenario_map`. It does not affect
        the result.
    progress
        Function that is called in the calling thread with the number of designs done and their
        total.

    Returns
    -------
    xarray.Dataset
        One dim per parameter that is varied. ``peak_displacement`` (m; ``_right``, ``_left``),
        ``peak_acceleration`` (absolute, m/s²), ``peak_force`` of a stop (N), ``penetration`` beyond
        a gap (m), ``hitting``: the share of the records with which the mass hits a stop; for sines,
        whether the mass hits a stop at any frequency. ``pareto``: whether no other design has less
        displacement without more acceleration, or less acceleration without more displacement;
        among designs with equal responses, such as those that hit nothing, the first one counts.
        ``within_limits``, if there are limits: whether the design keeps all of them.
        ``bumper_damping`` (N s/m), if a stiffness of both bumpers is varied. For sines also the
        frequencies of the largest values (``displacement_frequency``, ``acceleration_frequency``),
        and ``unsettled_count``, the number of holds without a periodic motion, whose peaks are
        those of 100 cycles. ``status`` is 0 for a completed design. The values of a design that was
        given up are NaN; those of an unbounded motion are infinite.

    Raises
    ------
    InputError
        If a value is invalid.
    """
    check_progress(progress)
    oscillator, what = design_rig(
        rig, records, fractile=fractile, frequency_span=frequency_span, step=step, tail=tail
    )
    plan = _designs(oscillator, vary)
    most = limits_of(limits)
    workers = placed(threads, where)
    places = list(itertools.product(*(range(n) for n in plan.shape)))
    rigs = [plan.oscillator(at) for at in places]
    data = _dataset(plan, {**what.peaks(rigs, workers, progress), **_dampings(plan, rigs)}, most)
    warn(data["status"].values, "design")
    parameters = {
        "oscillator": oscillator_parameters(oscillator),
        "varied": {one.name: one.values.tolist() for one in plan.varied},
        "limits": most,
        **what.parameters(),
    }
    data = describe(data, "vibroimpact.design_chart", parameters, what.notes())
    for one in plan.varied:
        data[one.name].attrs.update(units=one.units, long_name=one.long_name)
    return data


def _designs(oscillator: Oscillator, vary: Any) -> Runs:
    """Read which rigs are computed.

    Raises
    ------
    InputError
        If nothing is varied, or a value is invalid.
    """
    if not isinstance(vary, Mapping) or not vary:
        raise InputError(
            f"vary: {vary!r}; values of one parameter or more are accepted, such as "
            '{"gap": ["200 mm", "300 mm"]}'
        )
    return runs(oscillator, None, vary)


def _dampings(plan: Runs, rigs: list[Oscillator]) -> dict[str, NDArray[Any]]:
    """Return the damping of both bumpers along the varied stiffness, if they share one."""
    names = {one.name for one in plan.varied}
    if "bumper_damping" in names or not names & _STIFFNESSES:
        return {}
    every = [{stop.damping for stop in rig.stops if isinstance(stop, Bumper)} for rig in rigs]
    if any(len(one) != 1 for one in every):
        return {}
    return {"bumper_damping": np.array([one.pop() for one in every])}


def _dataset(
    plan: Runs, found: Mapping[str, NDArray[Any]], limits: Mapping[str, float]
) -> xr.Dataset:
    """Return the results of all designs, over the parameters that were varied."""
    within = np.ones(found["status"].shape, dtype=bool)
    for name, limit in limits.items():
        within &= found[name] <= limit
    u, a = (
        np.where(within, found[name], np.nan) for name in ("peak_displacement", "peak_acceleration")
    )
    own = {"pareto": non_dominated(u, a), **({"within_limits": within} if limits else {})}
    shaped = {
        name: (plan.dims, values.reshape(plan.shape)) for name, values in {**found, **own}.items()
    }
    return xr.Dataset(shaped, {one.name: one.values for one in plan.varied})


def warn(status: NDArray[Any], who: str) -> None:
    """Warn of designs that were given up."""
    for code in np.unique(status[status != Status.DONE]):
        count = int((status == code).sum())
        warnings.warn(
            f"{who}: {count} of {status.size} designs were given up: {Status(int(code)).advice}",
            RuntimeWarning,
            stacklevel=3,
        )
