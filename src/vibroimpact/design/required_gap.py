"""The gap with which a mass does not touch its stops: its largest displacement without stops."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.arguments import check_mapping
from vibroimpact.datasets.description import describe, system_parameters
from vibroimpact.design.assembly_gap import gaps_for_records, gaps_for_sines
from vibroimpact.design.design_shaking import (
    AnyRecords,
    ByRecords,
    BySines,
    design_system,
    split_frequency,
)
from vibroimpact.design.worst_sine import STEP, Sines
from vibroimpact.earthquakes.suites import quantiles
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, shown
from vibroimpact.model import Assembly, Oscillator, equilibrium
from vibroimpact.model.argument_types import Fractile, Share, Tail
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.parameter_ranges import Ranges
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import RigOrSystem
from vibroimpact.model.rig import Rig, one_mass_only, several_masses_only
from vibroimpact.response.analytic_free_response import free_flight_excursions, peak_ratio
from vibroimpact.tasks.executors import THREADS, workers_for
from vibroimpact.tasks.threads import Progress, Workers


@public
def required_gap(
    rig: RigOrSystem,
    vary: Ranges | None = None,
    *,
    records: AnyRecords | None = None,
    fractile: Fractile = 1.0,
    step: Share = STEP,
    tail: Tail | None = None,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute the gap without contact: the largest displacement of a rig without stops.

    Of an assembly it is the largest closing displacement of the two bodies of each stop: the moat
    of an isolated building, or the separation of neighbours. For sines this requires linear links.

    For records the gap is exact for a motion that starts at rest. For sines the gap holds for the
    steady motion; a transient may reach farther. If the isolator is linear, the frequency of the
    largest displacement is known in closed form, and the gap is exact for all frequencies of the
    range, or for all frequencies if no range is passed. For other isolators the gap is computed
    from sweeps up and down.

    Parameters
    ----------
    vary
        Range of the frequency (Hz) of a sine, as ``{"frequency": (low, high)}``. Default: all
        frequencies; for isolators that are not linear, a range around the primary resonance. An
        assembly has no default.
    rig, records, fractile, step, tail, threads, where, progress
        As in `design_chart`. The fractile over the records is computed for the larger side of each
        record, and also for each side separately. Therefore the common gap may exceed both
        one-sided gaps.

    Returns
    -------
    xarray.Dataset
        ``common_gap`` (m) is the required gap if both sides have the same gap. ``required_gap`` (m)
        are the required gaps of the right and of the left side (dim ``stop``) if the sides may
        differ. For sines, ``displacement_frequency`` (Hz) is the frequency of the largest
        displacement. For records, ``displacement_max`` and ``displacement_min`` are
        the ends of the motion of each record (dim ``record``).

        Of an assembly, ``required_gap`` and ``displacement_frequency`` have the dim ``stop``. For
        records, ``peak_closing`` is the largest closing displacement of each record and stop.

    Raises
    ------
    InputError
        If a value is invalid. Also if the motion without stops is unbounded, or if its computation
        was given up.
    """
    workers = workers_for(threads, where)
    others, frequencies = split_frequency({} if vary is None else vary)
    check_mapping(others, "vary", 'a dict of ranges by parameter, such as {"frequency": (1, 3)}')
    if others:
        raise InputError(
            f"vary: {', '.join(map(shown, others))}; the gap is required for one rig, so only "
            "'frequency' is varied; remove other parameters"
        )
    system, what = design_system(rig, records, frequencies, fractile=fractile, step=step, tail=tail)
    if system.by_mass:
        return _of_assembly(several_masses_only(system), what, workers, progress)
    oscillator = one_mass_only(system)
    free = oscillator.without_bumpers()
    if isinstance(what, ByRecords):
        gaps = _of_records(free, what, workers, progress)
    elif free.isolator.linear:
        gaps = _in_closed_form(free, what.sines)
    else:
        gaps = _swept(free, what.sines, workers, progress)
    if not np.isfinite(gaps["common_gap"]):
        raise InputError(
            "shaking: without stops the motion of the mass grows without bound, so no gap is wide "
            "enough; give the isolator more damping or stiffness, or reduce the shaking"
        )
    parameters = {**system_parameters(oscillator), **what.parameters()}
    return describe(gaps, "vibroimpact.required_gap", parameters, what.notes())


def _of_assembly(
    assembly: Assembly, what: BySines | ByRecords, workers: Workers, progress: Progress | None
) -> xr.Dataset:
    """Return the gap of each stop of an assembly."""
    if isinstance(what, ByRecords):
        gaps = gaps_for_records(assembly, what.records, what.fractile, what.tail, workers, progress)
    else:
        if not assembly.linear:
            raise InputError(
                "links: the gaps for sines require linear links and stops; pass records, or use "
                "sweep"
            )
        sines = what.sines
        gaps = gaps_for_sines(assembly, sines.shaken, (sines.low, sines.high))
    parameters = {**system_parameters(assembly), **what.parameters()}
    return describe(gaps, "vibroimpact.required_gap", parameters, what.notes())


def _in_closed_form(free: Oscillator, sines: Sines) -> xr.Dataset:
    """Compute the gap in closed form: the displacement rises up to its resonance, then falls."""
    natural = free.natural_frequency
    worst = natural * peak_ratio(free.damping_ratio, sines.shaken)
    # Without a peak it is largest at an end; far beyond resonance stands for infinity.
    low = 1e-9 * natural if sines.low is None else sines.low
    high = 1e9 * natural if sines.high is None else sines.high
    at = min(max(worst, low), high)
    swing, _ = free_flight_excursions(Rig(free, sines.shaken), np.array([at]))
    rest = equilibrium(free).displacement
    reach = 0.5 * float(swing[0])
    return _sides(reach + rest, reach - rest, displacement_frequency=at)


def _swept(
    free: Oscillator, sines: Sines, workers: Workers, progress: Progress | None
) -> xr.Dataset:
    (worst,) = sines.worst([free], workers, progress)
    _refuse(worst.status)
    return _sides(
        float(worst.right),
        float(worst.left),
        displacement_frequency=float(worst.displacement_frequency),
    )


def _of_records(
    free: Oscillator, what: ByRecords, workers: Workers, progress: Progress | None
) -> xr.Dataset:
    runs = what.runs([free], workers, progress)
    for status in runs["status"].ravel():
        _refuse(int(status))
    right, left = runs["displacement_max"][:, 0], 0.0 - runs["displacement_min"][:, 0]
    # A fractile of both is not the larger of the two fractiles.
    wide, *each = (
        float(quantiles(one, [what.fractile], 0)[0])
        for one in (np.maximum(right, left), right, left)
    )
    data = _sides(*each)
    data["common_gap"] = wide
    data["displacement_max"] = ("record", right)
    data["displacement_min"] = ("record", 0.0 - left)
    return data.assign_coords(record=list(what.records))


def _sides(right: float, left: float, **others: Any) -> xr.Dataset:
    return xr.Dataset(
        {
            "common_gap": max(right, left),
            "required_gap": ("stop", [right, left]),
            **others,
        },
        {"stop": list(SIDES)},
    )


def _refuse(status: int) -> None:
    if status not in (Status.DONE, Status.NOT_FINITE, Status.REVERSED):
        raise InputError(
            f"shaking: the motion without stops could not be computed: {Status(status).advice}"
        )
