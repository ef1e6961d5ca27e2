"""The seismic response of a rig: what a record asks of it, in a few numbers."""

from __future__ import annotations

import warnings

import numpy as np
import xarray as xr

from vibroimpact.arguments import check_progress
from vibroimpact.datasets.description import describe, oscillator_parameters
from vibroimpact.earthquakes.free_vibration import free_tail
from vibroimpact.earthquakes.peak_demands import MAX_EVENTS, Shaken, peaks
from vibroimpact.engine.status import Status
from vibroimpact.model import to_si
from vibroimpact.model.count_checks import MOST_TAIL, check_max_events
from vibroimpact.model.quantities import TIME
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.model.rig import Rig
from vibroimpact.response.plausibility import doubt_gaps
from vibroimpact.response.record_dataset import record_parameters
from vibroimpact.tasks.threads import Progress

LARGEST = {
    "peak_displacement": ("peak_displacement_right", "peak_displacement_left"),
    "peak_force": ("peak_force_right", "peak_force_left"),
}
"""The larger of two sides."""
SUMS = {
    "impulse": ("impulse_right", "impulse_left"),
    "impact_count": ("impact_count_right", "impact_count_left"),
}
"""Of both sides."""


def seismic_response(
    rig: AnyRig,
    *,
    tail: float | str | None = None,
    max_events: int = MAX_EVENTS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Return what a record asks of a rig that was at rest: its peaks, and where the energy went.

    Peaks are those of the motion itself, between the record's samples and behind it, not of
    samples of it (docs/theory.md, section 4).

    Parameters
    ----------
    rig
        The rig: a `Rig`, a laboratory case, its code, or the path of a study file.
    tail
        Duration of free vibration after the record, in seconds or as text such as ``"10s"``. None
        for two natural periods of the softest spring.
    max_events
        Contacts and detachments in one step of the record at which the motion is given up.
    progress
        Called from the calling thread with the steps of the record done and all there are.

    Returns
    -------
    xarray.Dataset
        Numbers without dims. ``peak_displacement`` (m; ``_right`` and ``_left`` to either side),
        ``peak_acceleration`` (absolute, m/s²), ``peak_force`` (N) and ``impulse`` (N s) of the
        stops, ``impact_count``, energies over the motion as those of `totals`. At an impact on a
        rigid stop the force is infinite, and the acceleration is that before and behind it.

        ``residual_displacement`` (m) is where the mass comes to rest. Where the isolator remembers
        or sticks, the free motion is followed behind the tail until it swings by less than a
        billionth of the peak displacement, for 2,000 natural periods at most, and the middle of its
        last swing is taken: what nothing damps swings about where it would rest.
        ``residual_swing`` (m) is half the width of that swing. Once it has fallen below a billionth
        of the peak, it bounds the error. Elsewhere ``residual_displacement`` is the
        equilibrium, and the swing that is left is not computed.

        If the motion was given up all of them are NaN, and ``status`` says why.

    Raises
    ------
    InputError
        If it is no record, or a value cannot be used.
    """
    rig = as_rig(rig)
    oscillator, record = rig.oscillator, rig.record
    check_progress(progress)
    behind = (
        free_tail(Rig(oscillator, record))
        if tail is None
        else to_si(tail, TIME, "tail", minimum=0.0, maximum=MOST_TAIL)
    )
    found = peaks(
        [Shaken(oscillator, record, np.ones(1))],
        tail=behind,
        energies=True,
        residuals=True,
        max_events=check_max_events(max_events),
        threads=1,
        progress=progress,
        by_line=True,
    )
    data = with_both_sides(xr.Dataset({name: values[0, 0] for name, values in found.items()}))
    status = Status(int(data["status"]))
    if status is not Status.DONE:
        warnings.warn(f"seismic_response: {status.advice}", RuntimeWarning, stacklevel=3)
    data.attrs["message"] = status.advice
    parameters = {
        "oscillator": oscillator_parameters(oscillator),
        "record": record_parameters(record),
        "tail": behind,
    }
    notes = [*record.about.notes, *doubt_gaps(Rig(oscillator, record), data["peak_displacement"])]
    return describe(data, "vibroimpact.seismic_response", parameters, notes)


def with_both_sides(data: xr.Dataset) -> xr.Dataset:
    """Add what is the larger of two sides, or the sum of both, before them."""
    both = {name: np.maximum(data[r], data[l]) for name, (r, l) in LARGEST.items()}  # noqa: E741
    both |= {name: data[r] + data[l] for name, (r, l) in SUMS.items()}  # noqa: E741
    return xr.Dataset({**both, **data.data_vars}, data.coords)
