"""The motion of the mass as a record that shakes equipment on it."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.errors import InputError
from vibroimpact.model import Record
from vibroimpact.response.motion_phases import any_recorded

_GRID = 1e-6
"""Share of a step by which a sample may lie off the grid."""


def floor_record(motion: xr.Dataset) -> Record:
    """Compute the absolute acceleration of the mass as a record, for its floor spectrum.

    Its `response_spectrum` holds for equipment that stands on the mass and is too light to affect
    it. A sample is not the acceleration at its time, but its mean over the steps before and after,
    weighted by a triangle: the second difference of the absolute displacement. The record thus
    contains the whole impulse of contacts, and of impacts on rigid stops, whose acceleration is
    infinite, whenever they occur. The motion of the equipment is right to the second order of the
    step. The step is that of the motion's samples; more ``samples`` in `simulate` make it more
    accurate.

    Parameters
    ----------
    motion
        Dataset of `simulate` through a `Record`, with samples.

    Raises
    ------
    InputError
        If it is not such a motion, or has fewer than four samples.
    """
    origin = any_recorded(motion)
    if not isinstance(origin.excitation, Record):
        raise InputError(
            "motion: it is periodically forced; a motion through a Record is accepted, and "
            "fourier_spectrum shows the harmonics of this one"
        )
    time = motion["time"].values
    if len(time) < 4:
        raise InputError(f"motion: {len(time)} samples; at least 4 are accepted")
    step = float(time[1])
    if time[-1] - time[-2] < (1.0 - _GRID) * step:  # what is left of the tail
        time = time[:-1]
    u = motion["displacement"].values[: len(time)]
    pull = origin.excitation.at(time)
    # The base may stop at once, at the record's end.
    still = time > origin.excitation.duration - _GRID * step
    begins, ends = np.where(still, 0.0, pull)[:-1], pull[1:]
    before = u[0] - float(motion["velocity"].values[0]) * step
    bend = np.diff(u, 2, prepend=before) / step**2
    shaken = (begins[:-1] + 2.0 * ends[:-1]) / 6.0 + (2.0 * begins[1:] + ends[1:]) / 6.0
    first = (2.0 * begins[0] + ends[0]) / 6.0
    return Record(bend + np.append(first, shaken), step)
