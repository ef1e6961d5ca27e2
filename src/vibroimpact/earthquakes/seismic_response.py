"""The seismic response of a rig to a record: peaks, impacts and energies."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.datasets.description import describe, system_parameters
from vibroimpact.datasets.stops import by_stop, has_stops
from vibroimpact.earthquakes.assembly_demands import seismic_response_of_assembly
from vibroimpact.earthquakes.free_vibration import free_tail
from vibroimpact.earthquakes.peak_demands import MAX_EVENTS, ScaledRecord, peaks
from vibroimpact.engine.status import Status
from vibroimpact.errors import warn_of_result
from vibroimpact.model import to_si
from vibroimpact.model.argument_types import MOST_TAIL, MaxEvents
from vibroimpact.model.public import public
from vibroimpact.model.quantities import TIME
from vibroimpact.model.read_rig import AnyRig, as_rig_of_any_masses
from vibroimpact.model.rig import Rig
from vibroimpact.response.plausibility import doubt_stops
from vibroimpact.response.record_dataset import record_parameters
from vibroimpact.response.totals import energy_notes
from vibroimpact.tasks.threads import Progress


@public
def seismic_response(
    rig: AnyRig,
    *,
    tail: float | str | None = None,
    max_events: MaxEvents = MAX_EVENTS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute the peak response of a rig to a record from rest, and the energies of the motion.

    The peaks are the peaks of the continuous motion. They may lie between the samples of the
    record, or after its end (docs/theory.md, section 4).

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    tail
        Duration of free vibration after the record, in seconds or as a string such as ``"10s"``.
        Default: two natural periods of the mass with the smallest stiffness of the isolator.
    max_events
        Largest number of events (contacts, detachments, yielding and turning points) in one step of
        the record. When the motion reaches this number, the computation is given up.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the number of
        completed steps of the record and the number of all steps.

    Returns
    -------
    xarray.Dataset
        Its variables are ``peak_displacement``, ``displacement_max``, ``displacement_min``,
        ``peak_acceleration``, ``peak_force``, ``impulse`` and ``impact_count`` (dim ``stop``: the
        stops that the rig has), the energies of `totals`, ``residual_displacement``,
        ``residual_swing`` and ``status``.

        At an impact on a rigid stop the force is infinite. The acceleration at the impact itself is
        left out: the values just before and just after the impact are used.

        If the isolator is hysteretic or has friction, the free motion is simulated beyond the tail
        until its swing is smaller than a billionth of the peak displacement. It is simulated for
        2,000 natural periods at most. ``residual_displacement`` is the middle of the last swing,
        because an undamped motion swings about the position at which it would rest.
        ``residual_swing`` is half the width of this last swing. If it is below a billionth of the
        peak, it is an upper bound of the error of ``residual_displacement``. For other isolators
        ``residual_displacement`` is the equilibrium, and ``residual_swing`` is not computed.

        Of an assembly, ``peak_displacement``, ``displacement_max``, ``displacement_min`` and
        ``peak_acceleration`` have the dim ``mass``, the drift u_right − u_left (``peak_drift``,
        ``drift_max``, ``drift_min``) has the dim ``link``, and ``peak_force``, ``impulse`` and
        ``impact_count`` have the dim ``stop``. The energies are those of `totals`. The default
        ``tail`` is two of the longest natural periods. There are no residual displacements.

        If the computation was given up, all values are NaN, and ``status`` gives the reason.

    Raises
    ------
    InputError
        If the rig is not shaken by a record, or if a value is invalid.
    """
    rig = as_rig_of_any_masses(rig)
    system, record = rig.system, rig.record
    behind = (
        free_tail(Rig(system, record))
        if tail is None
        else to_si(tail, TIME, "tail", minimum=0.0, maximum=MOST_TAIL)
    )
    if system.by_mass:
        status, data = seismic_response_of_assembly(rig, behind, max_events, progress)
        notes = [*record.about.notes, *energy_notes(system)]
        return _described(data, status, rig, behind, notes)
    oscillator = rig.oscillator
    peak_values = peaks(
        [ScaledRecord(oscillator, record, np.ones(1))],
        tail=behind,
        energies=True,
        residuals=True,
        max_events=max_events,
        threads=1,
        progress=progress,
        by_line=True,
    )
    values: dict[str, Any] = {name: one[0, 0] for name, one in peak_values.items()}
    for name in filter(has_stops, [*values]):
        values[name] = ("stop", by_stop(oscillator, values[name]))
    data = xr.Dataset(values, oscillator.part_names)
    notes = [*record.about.notes, *doubt_stops(Rig(oscillator, record), data["peak_displacement"])]
    return _described(data, Status(int(data["status"])), rig, behind, notes)


def _described(
    data: xr.Dataset,
    status: Status,
    rig: Rig,
    tail: float,
    notes: list[str],
) -> xr.Dataset:
    if status is not Status.DONE:
        warn_of_result(f"seismic_response: {status.advice}")
    data.attrs["message"] = status.advice
    parameters = {
        **system_parameters(rig.system),
        "record": record_parameters(rig.record),
        "tail": tail,
    }
    return describe(data, "vibroimpact.seismic_response", parameters, notes)
