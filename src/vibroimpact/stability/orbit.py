"""One stable or unstable periodic orbit, computed by Newton's method."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.datasets.description import describe
from vibroimpact.engine import section_map
from vibroimpact.model import State
from vibroimpact.model.argument_types import Period, PositiveInt
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig_of_any_masses
from vibroimpact.stability.fixed_points import MAX_EVENTS
from vibroimpact.stability.initial_orbit import first_orbit
from vibroimpact.stability.parameter_family import family
from vibroimpact.stability.settled_motion import settled_on
from vibroimpact.stability.steady import describe_motion


@public
def orbit(
    rig: AnyRig,
    start: State | xr.DataArray | xr.Dataset | None = None,
    period: Period | None = None,
    *,
    frequency: float | str | None = None,
    samples: PositiveInt = 256,
) -> xr.Dataset:
    """Compute the periodic orbit near a state, whether it is stable or unstable.

    Newton's method is applied to the stroboscopic map over one period, with its exact derivative.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    start
        A state near the orbit, at the initial phase of the excitation. Default: the steady motion
        that is reached from rest.
    period
        Period of the orbit, in forcing cycles. Default: the period of the motion that is reached
        from rest, or 1 if there is a ``start``. If there is no ``start`` and the orbit differs from
        the motion that is reached from rest, a warning is issued.
    frequency
        Forcing frequency (Hz). Default: the frequency of the rig.
    samples
        Number of samples per forcing cycle, at least 1.

    Returns
    -------
    xarray.Dataset
        The dataset contains the variables of `steady` for the orbit, and:

        - ``monodromy``, the derivative of u, u̇, u_right and u_left (positive when compressed) after
          one period with respect to their initial values;
        - ``multiplier_real`` and ``multiplier_imag``, the Floquet multipliers;
        - ``residual``, the residual of the map, divided by the size of the motion.

        The attribute ``contacts`` is the sequence of contacts, with R for right and L for left, or
        with the names of the stops of an assembly. The rows and columns of ``monodromy`` are then
        the displacements, the velocities and the deformations of the stops, in the order of the
        assembly.

    Raises
    ------
    InputError
        If a value is invalid, or if Newton's method finds no orbit near the start.
    """
    rig = as_rig_of_any_masses(rig, frequency=frequency)
    rig.check_frequency()
    fam = family(rig, "frequency")
    periodic_orbit = first_orbit(fam, (0.0, 1.0), start, period, symmetric=False)
    data = describe_motion(settled_on(periodic_orbit), samples, 1, 1, MAX_EVENTS)
    multipliers = periodic_orbit.multipliers
    signs = fam.layout.signs[: fam.states, np.newaxis]
    data = data.assign(
        monodromy=(
            ("component_after", "component_before"),
            signs * periodic_orbit.monodromy * signs.T,
        ),
        multiplier_real=("multiplier", multipliers.real),
        multiplier_imag=("multiplier", multipliers.imag),
        residual=float(periodic_orbit.facts[section_map.RESIDUAL]),
    )
    data.attrs["contacts"] = _sequence(data)
    data.attrs["created_by"] = "vibroimpact.orbit"
    data = describe(data, "vibroimpact.orbit")
    if rig.system.by_mass:
        data["monodromy"].attrs["comment"] = (
            "of the displacements and velocities of the masses and the deformations of the stops"
        )
    return data


def _sequence(data: xr.Dataset) -> str:
    """Return the sequence of contacts: R and L, or the names of the stops of an assembly."""
    if "contact_stop" in data:
        return "".join(str(name)[0].upper() for name in data["contact_stop"].values)
    begins = data["event_contact"].values > 0
    return " ".join(data["event_stop"].values[begins].tolist())
