"""The response of a rig to a record with its motion, and spectra of the ground and the masses."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.datasets.description import describe, motion_parameters, noted, remove_units
from vibroimpact.earthquakes.floor_record import floor_record
from vibroimpact.earthquakes.free_vibration import free_tail
from vibroimpact.earthquakes.seismic_response import seismic_response
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model.quantities import TIME
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import to_si
from vibroimpact.model.written_units import has_no_units
from vibroimpact.response.response_spectrum import response_spectrum
from vibroimpact.response.simulate import compute_history
from vibroimpact.tasks.threads import Progress

_PERIODS = np.geomspace(0.02, 5.0, 200)
"""Natural periods of the spectra (s)."""
_DAMPING = 0.05


def earthquake_response(
    rig: Rig, *, tail: float | str | None = None, samples: int = 1, progress: Progress | None = None
) -> dict[str, xr.Dataset]:
    """Compute the response of a rig to its record, the motion, and two response spectra.

    Parameters
    ----------
    tail
        Duration of free vibration after the record (s, or a string). None for two natural periods,
        the longest ones of an assembly.
    samples
        Samples of the motion in each step of the record.

    Returns
    -------
    dict of xarray.Dataset
        ``response``: that of `seismic_response`; ``motion``: that of `simulate`; ``ground`` and
        ``floor``: spectra of the record and of the acceleration of the mass, or of each mass.

    Raises
    ------
    InputError
        If a value cannot be used, or the motion was given up.
    """
    after, motion = _motion(rig, tail, samples, progress)
    spectra = {
        "ground": response_spectrum(rig.record, _PERIODS, _DAMPING),
        "floor": _floor(motion),
    }
    if has_no_units(rig):
        spectra = {name: remove_units(one) for name, one in spectra.items()}
    return {
        "response": seismic_response(rig, tail=after, progress=progress),
        "motion": motion,
        **spectra,
    }


def response_without_stops(
    rig: Rig, *, tail: float | str | None = None, progress: Progress | None = None
) -> xr.Dataset | None:
    """Compute `seismic_response` without stops; None without any, or if nothing else holds."""
    if not rig.oscillator.stops:
        return None
    free = Rig(rig.oscillator.without_bumpers(), rig.record)
    try:
        return seismic_response(free, tail=tail, progress=progress)
    except InputError:
        return None


def _floor(motion: xr.Dataset) -> xr.Dataset:
    """Return the spectrum of the acceleration of the mass, or of each mass of an assembly."""
    if "mass" not in motion.dims:
        return response_spectrum(floor_record(motion), _PERIODS, _DAMPING)
    names = motion["mass"]
    every = [
        response_spectrum(floor_record(motion, name), _PERIODS, _DAMPING)
        for name in names.values.tolist()
    ]
    data = xr.concat(every, names, combine_attrs="drop")
    parameters = motion_parameters(motion)
    return describe(data, "vibroimpact.response_spectrum", parameters, noted(motion))


def _motion(
    rig: Rig, tail: float | str | None, samples: int, progress: Progress | None
) -> tuple[float, xr.Dataset]:
    """Return the duration of free vibration (s), and the motion through record and vibration."""
    after = free_tail(rig) if tail is None else to_si(tail, TIME, "tail", minimum=0.0)
    motion = compute_history(rig, None, None, samples, after, progress=progress)
    if int(motion["status"]) != Status.DONE:
        raise InputError(f"the motion could not be computed: {motion.attrs['message']}")
    return after, motion
