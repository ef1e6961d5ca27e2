"""Exact extremes and energies of a whole motion."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.engine.observers import phases as layout
from vibroimpact.response.assembly_contacts import assembly_totals, has_assembly
from vibroimpact.response.motion_phases import SIDES, Phases, Recorded, any_recorded, phases


def totals(motion: xr.Dataset) -> xr.Dataset:
    """Compute the exact extremes of a motion, even between its samples, and its energies.

    Parameters
    ----------
    motion
        Dataset of `steady`, or of `simulate` with samples, including a motion through a `Record`.
        The motion is simulated again, as by `contacts`.

    Returns
    -------
    xarray.Dataset
        The extremes and the excursions of the displacement, of the absolute acceleration and of the
        force transmitted to the base have the same names as in `sweep`. ``total_supplied`` is the
        energy that the excitation supplies over the whole motion. ``total_isolator`` is the energy
        lost in the isolator, and ``total_bumpers`` the energy lost in the stops.

        The energies are counted from ``initial_state``. If the mass starts on a rigid stop and
        moves into it, the energies include this impact, although the first sample lies after it. In
        that case a note reports the impact.

        Of an assembly, the extremes have the dim ``mass``, and the drift u_right − u_left the dim
        ``link``. ``peak_force`` (infinite if a rigid stop is hit), ``impact_count`` and ``impulse``
        have the dim ``stop``. ``total_links`` and ``total_stops`` are the energies lost in each
        link and stop, ``total_damping`` those lost in damping that is not of a link, and
        ``total_stored`` is the growth of the kinetic and potential energy. ``total_supplied`` is
        the sum of these four.

    Raises
    ------
    InputError
        If the dataset does not hold a motion with samples.
    """
    if has_assembly(motion):
        return assembly_totals(motion)
    origin = any_recorded(motion)
    every = phases(motion, origin)
    supplied, isolator, bumpers = energies(origin, every)
    values = {
        **extremes(origin, every),
        "total_supplied": supplied,
        "total_isolator": isolator,
        "total_bumpers": bumpers,
    }
    notes = [*noted(motion), *_begins_with_an_impact(motion), *every.notes]
    return describe(xr.Dataset(values), "vibroimpact.totals", motion_parameters(motion), notes)


def _begins_with_an_impact(motion: xr.Dataset) -> list[str]:
    """Describe in words that the mass starts on a rigid stop and moves into it, if so."""
    if "initial_state" not in motion or not motion.sizes.get("time"):
        return []
    before = float(motion["initial_state"].sel(component="velocity"))
    behind = float(motion["velocity"][0])
    if before == behind:
        return []
    return [
        f"the motion starts with an impact, from {before:.6g} to {behind:.6g} m/s: the energies "
        "include this impact, and the first sample is the state after it"
    ]


def extremes(origin: Recorded[Any], every: Phases) -> dict[str, float]:
    """Return extremes and excursions of a motion.

    The force on the base is F_0 − M (ü + A_t), F_0 the constant force and A_t the acceleration of
    the base, or what stands for a force on the mass.
    """
    low, high, bottom, top = (
        float(end(every.of_mass(column)))
        for column, end in (
            (layout.U_LEAST, np.min),
            (layout.U_MOST, np.max),
            (layout.A_LEAST, np.min),
            (layout.A_MOST, np.max),
        )
    )
    mass, load = origin.oscillator.mass, origin.oscillator.force
    least_force = load - mass * float(every.rows[:, layout.CARRIED_MOST].max())
    most_force = load - mass * float(every.rows[:, layout.CARRIED_LEAST].min())
    return {
        "displacement_max": high,
        "displacement_min": low,
        "displacement_excursion": high - low,
        "acceleration_max": top,
        "acceleration_min": bottom,
        "acceleration_excursion": top - bottom,
        "transmitted_force_max": most_force,
        "transmitted_force_min": least_force,
        "transmitted_force_excursion": most_force - least_force,
        "eccentricity": 0.5 * (high + low),
    }


def energies(origin: Recorded[Any], every: Phases) -> tuple[float, float, float]:
    """Return the energy (J) supplied, lost in the isolator and lost in the stops."""
    mass = origin.oscillator.mass
    stops = sum(
        float(every.of_stop(column, number).sum())
        for number in range(len(SIDES))
        for column in (layout.LOSES, layout.HIT)
    )
    return (
        -mass * float(every.rows[:, layout.WORK].sum()),
        mass * float(every.rows[:, layout.LOST].sum()),
        mass * stops,
    )
