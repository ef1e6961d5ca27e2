"""Contacts and totals of the motion of an assembly, by mass, link and stop."""

from __future__ import annotations

import json
import math
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, excitation_from, motion_parameters, noted
from vibroimpact.engine.assembly import layout
from vibroimpact.engine.observers import phases
from vibroimpact.errors import InputError
from vibroimpact.model import Assembly, Record, Repeated, validate
from vibroimpact.response.assembly_phases import AssemblyParts, AssemblyPhases, phases_layout
from vibroimpact.response.assembly_rig import assembly_numbers
from vibroimpact.response.assembly_rows import range_variables
from vibroimpact.response.assembly_state import as_assembly_state, assembly_vector
from vibroimpact.response.motion_phases import (
    doubts,
    record_course,
    repeated_course,
    shaken_by,
)

_Array = NDArray[np.float64]


class Origin(NamedTuple):
    """What a dataset's motion is of."""

    assembly: Assembly
    shaking: Repeated | Record
    periodic: bool
    """Whether it is one period of a periodic motion."""


def has_assembly(motion: xr.Dataset) -> bool:
    """Return whether a motion is that of an assembly."""
    held = isinstance(motion, xr.Dataset) and "parameters" in motion.attrs
    return held and "assembly" in json.loads(motion.attrs["parameters"])


def assembly_origin(motion: xr.Dataset) -> Origin:
    """Return what the motion of an assembly is of.

    Raises
    ------
    InputError
        If the dataset has no samples.
    """
    if not {"event_time", "velocity"} <= set(motion.variables) or not motion.sizes["time"]:
        raise InputError(
            "motion: this is not a recorded motion; pass the result of steady, or the result of "
            "simulate with samples greater than 0"
        )
    given = motion_parameters(motion)
    assembly = validate(Assembly, given["assembly"], "motion.assembly")
    assert isinstance(assembly, Assembly)
    if "record" in given:
        return Origin(assembly, shaken_by(motion, given["record"]), False)
    first, last = (float(motion["cycle"].values[end]) for end in (0, -1))
    periodic = "period" in motion and first == 0.0 and last == int(motion["period"])
    return Origin(assembly, excitation_from(given), periodic)


def fourier_integrals_by_mass(motion: xr.Dataset, rates: _Array) -> NDArray[np.complex128]:
    """Return the integrals of an assembly's periodic motion over one period times exp(−iνt).

    Parameters
    ----------
    motion
        A periodic motion.
    rates
        ν (1/s).

    Returns
    -------
    ndarray, shape (3, rate, mass)
        Of displacement, velocity and absolute acceleration, impulses left out.
    """
    assembly, shaking, _ = assembly_origin(motion)
    assert not isinstance(shaking, Record)
    begin = assembly_vector(assembly, as_assembly_state(motion["initial_state"], assembly))
    cycles, rig = float(motion["cycle"].values[-1]), assembly_numbers(assembly, shaking)
    course = repeated_course(shaking, cycles, rig, begin, phases_layout(assembly))
    found = course.integrated(rates).reshape(3, 2, len(assembly.names), len(rates))
    integrals: NDArray[np.complex128] = found[:, 0] + 1j * found[:, 1]
    return integrals.swapaxes(1, 2)


def _measured(motion: xr.Dataset, origin: Origin) -> tuple[AssemblyPhases, list[str]]:
    """Follow a recorded motion again, and measure its phases; with notes of doubt."""
    assembly, shaking = origin.assembly, origin.shaking
    begin = assembly_vector(assembly, as_assembly_state(motion["initial_state"], assembly))
    final, of = begin.copy(), phases_layout(assembly)
    rig = assembly_numbers(assembly, shaking)
    if isinstance(shaking, Record):
        course = record_course(motion, shaking, rig, final, of)
    else:
        course = repeated_course(shaking, float(motion["cycle"].values[-1]), rig, final, of)
    found = AssemblyPhases(assembly, course.again(motion), begin, final)
    held = motion["displacement"].transpose("mass", "time").values
    end = final[layout.PARTS : layout.PARTS + len(held)]
    return found, doubts(motion, found.status, float(np.abs(end - held[:, -1]).max()))


def assembly_totals(motion: xr.Dataset) -> xr.Dataset:
    """Do what `totals` does, of the motion of an assembly."""
    origin = assembly_origin(motion)
    found, doubted = _measured(motion, origin)
    values = {**extremes(found), **energies(found)}
    data = xr.Dataset(values, coordinates(origin.assembly))
    notes = [*noted(motion), *doubted, *energy_notes(origin.assembly)]
    return describe(data, "vibroimpact.totals", motion_parameters(motion), notes)


def coordinates(assembly: Assembly) -> dict[str, _Array]:
    """Return the names of masses, links and stops as coordinates of a dataset."""
    names = {"mass": assembly.names, "link": assembly.links, "stop": assembly.stops}
    return {dim: np.array(list(found), dtype=np.str_) for dim, found in names.items()}


def energy_notes(assembly: Assembly) -> list[str]:
    """Say which energies are not known, if so."""
    lossy = AssemblyParts(assembly).lossy
    if lossy.sum() < 2:
        return []
    names = [name for name, loses in zip(assembly.links, lossy, strict=True) if loses]
    return [
        f"links: total_links of {', '.join(names)} is NaN; only the sum of their losses is known, "
        "from the balance of the other energies"
    ]


def extremes(found: AssemblyPhases) -> dict[str, Any]:
    """Return the extremes of a motion, and forces, impulses and impacts by stop."""

    def spread(name: str, low: _Array, high: _Array, *dims: str) -> dict[str, Any]:
        return range_variables(name, low.min(axis=0), high.max(axis=0), dims)

    rows, at, stops = found.rows, found.impacts, found.layout.stops
    stop, pressed = rows[at, phases.AT_STOP].astype(np.int64), found.pressed
    hit = np.bincount(stop, minlength=stops)
    struck = np.bincount(stop, rows[at, phases.STRUCK], stops)
    begun = (pressed[1:] & ~pressed[:-1]).sum(axis=0)
    low, high = found.of_mass(phases.U_LEAST), found.of_mass(phases.U_MOST)
    felt = found.of_mass(phases.A_LEAST), found.of_mass(phases.A_MOST)
    drift = found.of_drift(phases.D_LEAST), found.of_drift(phases.D_MOST)
    carried = rows[:, phases.CARRIED_LEAST], rows[:, phases.CARRIED_MOST]
    force = found.of_stop(phases.FORCE).max(axis=0)
    return {
        **spread("displacement", low, high, "mass"),
        **spread("acceleration", *felt, "mass"),
        **spread("drift", *drift, "link"),
        **spread("transmitted_force", *carried),
        "eccentricity": ("mass", 0.5 * (low.min(axis=0) + high.max(axis=0))),
        "peak_force": ("stop", np.where(struck > 0.0, np.inf, force)),
        "impact_count": ("stop", np.where(found.parts.rigid, hit, begun)),
        "impulse": ("stop", found.of_stop(phases.IMPULSE).sum(axis=0) + struck),
    }


def energies(found: AssemblyPhases) -> dict[str, Any]:
    """Return the energies (J) of a motion by link and stop, whose balance is closed.

    The loss of one link beyond that of its dashpot follows from the balance; those of several do
    not (NaN).
    """
    links, lossy = found.of_drift(phases.D_LOST).sum(axis=0), found.parts.lossy
    stops = (found.of_stop(phases.LOSES) + found.of_stop(phases.HIT)).sum(axis=0)
    stops = stops - found.held_by_stops()
    supplied, damped = (float(found.rows[:, one].sum()) for one in (phases.WORK, phases.LOST))
    stored, damping = found.stored(), damped - links.sum()
    rest = supplied - damped - stops.sum() - stored
    links[lossy] += rest if lossy.sum() == 1 else np.nan
    return {
        "total_supplied": supplied,
        "total_links": ("link", links),
        "total_damping": damping,
        "total_stops": ("stop", stops),
        "total_stored": stored,
    }


class _Contact(NamedTuple):
    """A contact: a number for each, and the velocities of all masses."""

    order: float
    """Number of the phase in which it begins; of an impact, between two."""
    stop: int
    begin: float
    angle: float
    length: float
    arrival: _Array
    """Velocities at the start, shape (mass,)."""
    parting: _Array
    closing: float
    force: float
    impulse: float
    penetration: float
    dissipated: float
    relaxing: float


def assembly_contacts(motion: xr.Dataset, share: float) -> xr.Dataset:
    """Do what `contacts` does, of the motion of an assembly; ``share`` as ``grazing`` there."""
    origin = assembly_origin(motion)
    found, doubted = _measured(motion, origin)
    every = [*_impacts(found), *_lasting(found, origin)]
    every.sort(key=lambda one: one.order)
    masses = len(origin.assembly.names)
    arrival, parting = (
        np.array([getattr(one, name) for one in every]).reshape(-1, masses)
        for name in ("arrival", "parting")
    )
    stop = np.array([one.stop for one in every], dtype=np.int64)

    def column(name: str) -> _Array:
        return np.array([getattr(one, name) for one in every], dtype=float)

    begin, length, closing = column("begin"), column("length"), column("closing")
    ahead, behind = ((found.parts.closing[stop] * v).sum(axis=1) for v in (arrival, parting))
    fastest = max(
        float(np.abs(motion[name].values).max(initial=0.0))
        for name in ("velocity", "event_velocity")
    )
    names = np.array(list(origin.assembly.stops), dtype=np.str_)
    values: dict[str, Any] = {
        "stop": names[stop],
        "start": begin,
        "end": begin + length,
        "duration": length,
        "peak_force": column("force"),
        "impulse": column("impulse"),
        "penetration": column("penetration"),
        "dissipated": column("dissipated"),
        "dissipated_relaxing": column("relaxing"),
        "closing_speed": closing,
        # Of bodies that recede as the bumper catches up with them there is none.
        "restitution": np.divide(
            -behind, ahead, out=np.full(len(ahead), np.nan), where=ahead > 0.0
        ),
        "grazing": closing < share * fastest,
    }
    if not isinstance(origin.shaking, Record):
        turns = 2.0 * math.pi / origin.shaking.period
        values |= {
            "start_phase": column("angle") % (2.0 * math.pi),
            "end_phase": (column("angle") + turns * length) % (2.0 * math.pi),
            "duration_share": length / origin.shaking.period,
        }
    data = xr.Dataset(
        {f"contact_{name}": ("contact_number", value) for name, value in values.items()},
        {"mass": coordinates(origin.assembly)["mass"]},
    )
    for name, value in (("start", arrival), ("end", parting)):
        data[f"contact_{name}_velocity"] = (("contact_number", "mass"), value)
    notes = [*noted(motion), *doubted]
    return describe(data, "vibroimpact.contacts", motion_parameters(motion), notes)


def _impacts(found: AssemblyPhases) -> list[_Contact]:
    """Return the impacts on rigid stops: contacts of no duration."""
    rows, at = found.rows, found.impacts
    ahead, behind = found.of_mass(phases.ARRIVAL)[at], found.of_mass(phases.PARTING)[at]
    stops = rows[at, phases.AT_STOP].astype(np.int64)
    lost = found.of_stop(phases.HIT)[at, stops]
    closing = found.of_stop(phases.CLOSING)[at, stops]
    return [
        _Contact(
            *(i + 0.5, int(stops[k]), found.bounds[i + 1], found.angle[i + 1], 0.0),
            *(ahead[k], behind[k], float(closing[k]), math.nan, rows[i, phases.STRUCK]),
            *(0.0, lost[k], 0.0),
        )
        for k, i in enumerate(at)
    ]


def _lasting(found: AssemblyPhases, origin: Origin) -> list[_Contact]:
    """Return the contacts with bumpers, and rests on rigid stops, that are complete."""
    contacts, rows, pressed = [], found.rows, found.pressed
    count = len(rows)
    cut = count > 0 and rows[-1, phases.KIND] == phases.NOTHING
    arrival, parting = found.of_mass(phases.ARRIVAL), found.of_mass(phases.PARTING)
    closing, force = found.of_stop(phases.CLOSING), found.of_stop(phases.FORCE)
    impulse, depth = found.of_stop(phases.IMPULSE), found.of_stop(phases.DEPTH)
    lost, length = found.of_stop(phases.LOSES), rows[:, phases.LENGTH]
    for stop, w in enumerate(found.parts.closing):
        touched = pressed[:, stop]
        for run in _runs(touched, origin.periodic, bool(cut)):
            first, last = int(run[0]), int(run[-1])
            free = np.arange(last + 1, _next(touched, last, origin.periodic)) % count
            # The event with which it begins ends the phase before it; a rest begins behind it.
            ahead = parting[first - 1]
            rigid = found.parts.rigid[stop]
            contacts.append(
                _Contact(
                    order=float(first),
                    stop=stop,
                    begin=found.bounds[first],
                    angle=found.angle[first],
                    length=float(length[run].sum()),
                    arrival=ahead,
                    parting=arrival[last],
                    closing=float(w @ ahead) if rigid else float(closing[first - 1, stop]),
                    force=force[run, stop].max(),
                    impulse=impulse[run, stop].sum(),
                    penetration=depth[run, stop].max(),
                    dissipated=lost[run, stop].sum(),
                    relaxing=lost[free, stop].sum(),
                )
            )
    return contacts


def _next(touched: NDArray[np.bool_], last: int, periodic: bool) -> int:
    """Return the phase at which a stop is touched again, counted on where the motion repeats."""
    later = np.flatnonzero(touched[last + 1 :])
    if len(later):
        return int(last + 1 + later[0])
    return len(touched) + (int(np.flatnonzero(touched)[0]) if periodic else 0)


def _runs(touched: NDArray[np.bool_], periodic: bool, goes_on: bool) -> list[NDArray[np.int64]]:
    """Return the phases of each complete contact, by the order in which they begin."""
    begins = np.flatnonzero(touched & ~np.append(False, touched[:-1]))
    ends = np.flatnonzero(touched & ~np.append(touched[1:], False))
    runs = [np.arange(i, j + 1) for i, j in zip(begins, ends, strict=True)]
    last = len(touched) - 1
    if not periodic:
        return [run for run in runs if run[0] > 0 and not (goes_on and run[-1] == last)]
    if touched[0] and touched[-1]:
        # One contact, cut in two by the section: the end of the motion is its beginning.
        joined = [np.append(runs[-1], runs[0])] if len(runs) > 1 else []
        runs = [*runs[1:-1], *joined]
    return runs
