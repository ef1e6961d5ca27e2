"""Exact extremes and energies of a whole motion."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.datasets.stops import part_names
from vibroimpact.engine.observers import phases as layout
from vibroimpact.model.public import public
from vibroimpact.model.rig import several_masses_only
from vibroimpact.model.system import System
from vibroimpact.response.assembly_rows import range_variables
from vibroimpact.response.motion_phases import Phases, phases, recorded
from vibroimpact.response.stored_energy import StoredEnergy

_Array = NDArray[np.float64]


@public
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
    origin = recorded(motion, masses=True, records=True)
    all_phases = phases(motion, origin)
    parts = part_names(origin.system, "mass", "link", "stop") if origin.system.by_mass else {}
    data = xr.Dataset({**extremes(all_phases), **energies(all_phases)}, parts)
    begins = [] if "mass" in motion.dims else _begins_with_an_impact(motion)
    notes = [*noted(motion), *begins, *all_phases.notes, *energy_notes(origin.system)]
    return describe(data, "vibroimpact.totals", motion_parameters(motion), notes)


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


def energy_notes(system: System) -> list[str]:
    """Say which energies are not known, if so."""
    if not system.by_mass:
        return []
    assembly = several_masses_only(system)
    lossy = StoredEnergy(assembly).lossy
    if lossy.sum() < 2:
        return []
    names = [name for name, loses in zip(assembly.links, lossy, strict=True) if loses]
    return [
        f"links: total_links of {', '.join(names)} is NaN; only the sum of their losses is known, "
        "from the balance of the other energies"
    ]


def extremes(all_phases: Phases) -> dict[str, Any]:
    """Return the extremes of a motion, of an assembly also forces, impulses and impacts by stop."""

    def spread(name: str, low: _Array, high: _Array, *dims: str) -> dict[str, Any]:
        return range_variables(name, low.min(axis=0), high.max(axis=0), dims)

    rows = all_phases.rows
    low, high = all_phases.of_mass(layout.U_LEAST), all_phases.of_mass(layout.U_MOST)
    values = {
        **spread("displacement", low, high, "mass"),
        **spread(
            "acceleration",
            all_phases.of_mass(layout.A_LEAST),
            all_phases.of_mass(layout.A_MOST),
            "mass",
        ),
        **spread("transmitted_force", rows[:, layout.CARRIED_LEAST], rows[:, layout.CARRIED_MOST]),
        "eccentricity": ("mass", 0.5 * (low.min(axis=0) + high.max(axis=0))),
    }
    system = all_phases.system
    if not system.by_mass:
        return {
            name: float(np.squeeze(value))
            for name, (_, value) in values.items()
            if not name.startswith("peak_")
        }
    at, count = all_phases.impacts, len(all_phases.stops)
    stop = rows[at, layout.AT_STOP].astype(np.int64)
    struck = np.bincount(stop, rows[at, layout.STRUCK], count)
    pressed = all_phases.pressed
    begun = (pressed[1:] & ~pressed[:-1]).sum(axis=0)
    rigid = np.array([one.rigid for one in system.stop_laws.values()], dtype=bool)
    hit, force = np.bincount(stop, minlength=count), all_phases.of_stop(layout.FORCE).max(axis=0)
    drift = all_phases.of_drift(layout.D_LEAST), all_phases.of_drift(layout.D_MOST)
    return {
        **values,
        **spread("drift", *drift, "link"),
        "peak_force": ("stop", np.where(struck > 0.0, np.inf, force)),
        "impact_count": ("stop", np.where(rigid, hit, begun)),
        "impulse": ("stop", all_phases.of_stop(layout.IMPULSE).sum(axis=0) + struck),
    }


def energies(all_phases: Phases) -> dict[str, Any]:
    """Return the energies (J) of a motion; of an assembly by link and stop, and in balance.

    The loss of one link beyond that of its dashpot follows from the balance; those of several do
    not (NaN).
    """
    system, supplied = all_phases.system, float(all_phases.rows[:, layout.WORK].sum())
    lost = float(all_phases.rows[:, layout.LOST].sum())
    stops = (all_phases.of_stop(layout.LOSES) + all_phases.of_stop(layout.HIT)).sum(axis=0)
    if not system.by_mass:
        return {
            "total_supplied": supplied,
            "total_isolator": lost,
            "total_bumpers": float(stops.sum()),
        }
    energy = StoredEnergy(several_masses_only(system))
    links = all_phases.of_drift(layout.D_LOST).sum(axis=0)
    # The engine counts what a stop without memory takes up while it is touched, lost or not.
    stops = stops - (energy.of_curved(all_phases.final) - energy.of_curved(all_phases.begin))
    stored, damping = energy.of(all_phases.final) - energy.of(all_phases.begin), lost - links.sum()
    rest = supplied - lost - stops.sum() - stored
    links[energy.lossy] += rest if energy.lossy.sum() == 1 else np.nan
    return {
        "total_supplied": supplied,
        "total_links": ("link", links),
        "total_damping": float(damping),
        "total_stops": ("stop", stops),
        "total_stored": stored,
    }
