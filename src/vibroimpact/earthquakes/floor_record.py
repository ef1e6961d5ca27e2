"""The absolute acceleration of the mass, as a record that shakes equipment on the mass."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.errors import InputError, shown
from vibroimpact.model import Record, Repeated
from vibroimpact.model.assembly.names import check_known
from vibroimpact.model.public import public
from vibroimpact.model.rig import several_masses_only
from vibroimpact.response.motion_phases import recorded

_GRID = 1e-6
"""Share of a step by which a sample may lie off the grid."""


@public
def floor_record(motion: xr.Dataset, mass: str | None = None) -> Record:
    """Compute the absolute acceleration of the mass as a record, for a floor spectrum.

    The `response_spectrum` of this record is the floor spectrum. It applies to equipment that
    stands on the mass and is too light to affect the motion of the mass.

    A sample of the record is not the acceleration at one instant. It is the mean of the
    acceleration over the steps before and after this instant, weighted by a triangle. This mean is
    the second difference of the absolute displacement, divided by the square of the step. Therefore
    the record contains the whole impulse of each contact, whenever it occurs. It also contains the
    impulses of impacts on rigid stops, where the acceleration is infinite.

    The motion of the equipment is accurate to the second order of the step. The step is the time
    between the samples of the motion. To increase the accuracy, pass more ``samples`` to
    `simulate`.

    Parameters
    ----------
    motion
        Dataset of `simulate` through a `Record`, with samples.
    mass
        Name of the mass of an assembly on which the equipment stands.

    Raises
    ------
    InputError
        If ``motion`` is not a motion through a record, or has fewer than four samples. Also if the
        assembly has no such mass, or if a mass is passed for an oscillator.
    """
    excitation, influence = _shaking(motion, mass)
    if not isinstance(excitation, Record):
        raise InputError(
            "motion: its excitation is periodic, not a record; pass the result of simulate for a "
            "Record, or use fourier_spectrum for the harmonics of this motion"
        )
    time = motion["time"].values
    if len(time) < 4:
        raise InputError(
            f"motion: {len(time)} samples, but at least 4 are required; call simulate with a "
            "larger value of samples"
        )
    step = float(time[1])
    if time[-1] - time[-2] < (1.0 - _GRID) * step:  # what is left of the tail
        time = time[:-1]
    of_mass = motion if mass is None else motion.sel(mass=mass)
    u = of_mass["displacement"].values[: len(time)]
    pull = influence * excitation.at(time)
    # The base may stop at once, at the record's end.
    still = time > excitation.duration - _GRID * step
    begins, ends = np.where(still, 0.0, pull)[:-1], pull[1:]
    before = u[0] - float(of_mass["velocity"].values[0]) * step
    bend = np.diff(u, 2, prepend=before) / step**2
    shaken = (begins[:-1] + 2.0 * ends[:-1]) / 6.0 + (2.0 * begins[1:] + ends[1:]) / 6.0
    first = (2.0 * begins[0] + ends[0]) / 6.0
    return Record(bend + np.append(first, shaken), step)


def _shaking(motion: xr.Dataset, mass: str | None) -> tuple[Repeated | Record, float]:
    """Return what shakes a motion, and by how much the mass moves with the base."""
    origin = recorded(motion, masses=True, records=True)
    system = origin.system
    if not system.by_mass:
        if mass is not None:
            raise InputError(f"mass: {shown(mass)}, but an Oscillator has only one; remove mass")
        return origin.shaking, 1.0
    names = system.names
    if mass is None:
        raise InputError(f"mass: missing; pass one of {', '.join(names)}")
    check_known(mass, names, "mass", "mass")
    return origin.shaking, float(several_masses_only(system).influence[names.index(mass)])
