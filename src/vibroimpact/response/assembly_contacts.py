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
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, warn_of_result
from vibroimpact.model import Assembly, Record, Repeated, validate
from vibroimpact.response.assembly_motion import Sections, sections_of
from vibroimpact.response.assembly_phases import AssemblyParts, Measured, Measurer
from vibroimpact.response.assembly_pieces import final_mode
from vibroimpact.response.assembly_rows import range_variables
from vibroimpact.response.assembly_state import as_assembly_state, assembly_vector
from vibroimpact.response.motion_phases import shaken_by

_Array = NDArray[np.float64]

_DEPARTED = 1e-6
"""Share of the largest displacement by which the end of a motion may differ from its record."""


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


def _measured(motion: xr.Dataset, origin: Origin) -> tuple[Measured, list[str]]:
    """Follow a recorded motion again, and measure its pieces; with notes of doubt."""
    assembly, shaking = origin.assembly, origin.shaking
    state = as_assembly_state(motion["initial_state"], assembly)
    vector = assembly_vector(assembly, state)
    measurer = Measurer(assembly, shaking)
    if isinstance(shaking, Record):
        tail = float(motion_parameters(motion)["tail"])
        sections = _sections_until_end(sections_of(shaking, tail, 0.0), motion)
    else:
        first, last = (float(motion["cycle"].values[end]) for end in (0, -1))
        phase = shaking.phase
        if first > 0.0:  # its first samples were cut off
            measurer.follow(vector, sections_of(shaking, first, phase))
            phase += 2.0 * math.pi * (first % 1.0)
        sections = sections_of(shaking, last - first, phase)
    found = measurer.follow(vector, sections)
    begins = float(motion["time"].values[0])
    return found._replace(begin=found.begin + begins), _doubts(motion, found)


def _sections_until_end(sections: Sections, motion: xr.Dataset) -> Sections:
    """Return the sections until the end of a motion through a record."""
    left, lines = float(motion["time"].values[-1]), sections.lines.copy()
    begins = np.append(0.0, np.cumsum(lines[:, 2]))[:-1]
    slack = 1e-9 * sections.interval
    lines[:, 2] = np.minimum(lines[:, 2], np.maximum(left - begins, 0.0))
    whole = np.abs(lines[:, 2] - sections.lines[:, 2]) <= slack
    lines[whole] = sections.lines[whole]
    return sections._replace(lines=lines[lines[:, 2] > slack])


def _doubts(motion: xr.Dataset, found: Measured) -> list[str]:
    """Describe in words that the motion followed is not the recorded one, if so, and warn."""
    held = motion["displacement"].transpose("mass", "time").values
    end = found.final[layout.PARTS : layout.PARTS + len(held)]
    apart, size = float(np.abs(end - held[:, -1]).max()), float(np.abs(held).max())
    if found.status is Status.DONE and apart <= _DEPARTED * size:
        return []
    told = (
        f"followed again from its initial state, the motion ends {apart:.3g} m away from the "
        "recorded one, because it is sensitive to rounding and was computed by another version or "
        "on another processor: the result is that of the motion followed now"
    )
    warn_of_result(told)
    return [told]


def assembly_totals(motion: xr.Dataset) -> xr.Dataset:
    """Do what `totals` does, of the motion of an assembly."""
    origin = assembly_origin(motion)
    found, doubts = _measured(motion, origin)
    parts = AssemblyParts(origin.assembly)
    values = {**extremes(found, parts), **energies(found, parts)}
    data = xr.Dataset(values, coordinates(origin.assembly))
    notes = [*noted(motion), *doubts, *energy_notes(origin.assembly)]
    return describe(data, "vibroimpact.totals", motion_parameters(motion), notes)


def coordinates(assembly: Assembly) -> dict[str, _Array]:
    """Return the names of masses, links and stops as coordinates of a dataset."""
    names = {"mass": assembly.names, "link": assembly.links, "stop": assembly.stops}
    return {dim: np.array(list(found), dtype=np.str_) for dim, found in names.items()}


def energy_notes(assembly: Assembly) -> list[str]:
    """Say which energies are not known, if so."""
    curved = [name for name, link in assembly.links.items() if not link.law.linear]
    if not curved:
        return []
    return [
        f"links: the energies of curved links are not computed ({', '.join(curved)}): total_links "
        "of these and total_stored are NaN"
    ]


def extremes(found: Measured, parts: AssemblyParts) -> dict[str, Any]:
    """Return the extremes of a motion, and forces, impulses and impacts by stop."""

    def spread(name: str, pieces: _Array, *dims: str) -> dict[str, Any]:
        least, most = pieces[..., 0].min(axis=0), pieces[..., 1].max(axis=0)
        return range_variables(name, least, most, dims)

    impacts, stops = found.impacts, len(parts.closing)
    hit = np.bincount(impacts.stop, minlength=stops)
    struck = np.bincount(impacts.stop, impacts.impulse, stops)
    begun = (found.pressed[1:] & ~found.pressed[:-1]).sum(axis=0)
    least, most = (
        end(found.displacement[..., i], axis=0) for i, end in enumerate((np.min, np.max))
    )
    return {
        **spread("displacement", found.displacement, "mass"),
        **spread("acceleration", found.acceleration, "mass"),
        **spread("drift", found.drift, "link"),
        **spread("transmitted_force", found.carried),
        "eccentricity": ("mass", 0.5 * (least + most)),
        "peak_force": ("stop", np.where(struck > 0.0, np.inf, found.force.max(axis=0))),
        "impact_count": ("stop", np.where(parts.rigid, hit, begun)),
        "impulse": ("stop", found.impulse.sum(axis=0) + struck),
    }


def energies(found: Measured, parts: AssemblyParts) -> dict[str, Any]:
    """Return the energies (J) of a motion by link and stop, whose balance is closed."""
    impacts = np.bincount(found.impacts.stop, found.impacts.lost, len(parts.closing))
    return {
        "total_supplied": float(found.work.sum()),
        "total_links": ("link", found.link_lost.sum(axis=0)),
        "total_damping": float(found.damping_lost.sum()),
        "total_stops": ("stop", found.stop_lost.sum(axis=0) + impacts),
        "total_stored": found.stored(parts),
    }


class _Contact(NamedTuple):
    """A contact: a number for each, and the velocities of all masses."""

    order: float
    """Number of the piece in which it begins; of an impact, between two."""
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
    found, doubts = _measured(motion, origin)
    parts = AssemblyParts(origin.assembly)
    every = [*_impacts(found, parts), *_lasting(found, parts, origin)]
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
    ahead, behind = ((parts.closing[stop] * v).sum(axis=1) for v in (arrival, parting))
    fastest = float(np.abs(found.v).max())
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
    notes = [*noted(motion), *doubts]
    return describe(data, "vibroimpact.contacts", motion_parameters(motion), notes)


def _impacts(found: Measured, parts: AssemblyParts) -> list[_Contact]:
    """Return the impacts on rigid stops: contacts of no duration."""
    rows = []
    for piece, stop, ahead, behind, impulse, lost in zip(*found.impacts, strict=True):
        at = found.begin[piece] + found.length[piece]
        closing = float(parts.closing[stop] @ ahead)
        angle = found.angle[piece, 1]
        rows.append(
            _Contact(
                *(piece + 0.5, int(stop), at, angle, 0.0, ahead, behind, closing),
                *(math.nan, impulse, 0.0, lost, 0.0),
            )
        )
    return rows


def _lasting(found: Measured, parts: AssemblyParts, origin: Origin) -> list[_Contact]:
    """Return the contacts with bumpers, and rests on rigid stops, that are complete."""
    rows = []
    mode, count = final_mode(found.final), len(found.begin)
    for stop in range(len(parts.closing)):
        touched = found.pressed[:, stop]
        for run in _runs(touched, origin.periodic, bool(mode >> stop & 1)):
            first, last = int(run[0]), int(run[-1])
            ahead, d = found.v[first, 0], found.d[first - 1, 1, stop]
            closing = float(parts.closing[stop] @ ahead)
            if parts.stop_dashpots[stop] > 0.0:  # a relaxing face recedes
                closing += parts.springs[stop] / parts.stop_dashpots[stop] * d
            free = np.arange(last + 1, _next(touched, last, origin.periodic)) % count
            rows.append(
                _Contact(
                    order=float(first),
                    stop=stop,
                    begin=found.begin[first],
                    angle=found.angle[first, 0],
                    length=float(found.length[run].sum()),
                    arrival=ahead,
                    parting=found.v[last, 1],
                    closing=closing,
                    force=found.force[run, stop].max(),
                    impulse=found.impulse[run, stop].sum(),
                    penetration=found.depth[run, stop].max(),
                    dissipated=found.stop_lost[run, stop].sum(),
                    relaxing=found.stop_lost[free, stop].sum(),
                )
            )
    return rows


def _next(touched: NDArray[np.bool_], last: int, periodic: bool) -> int:
    """Return the piece at which a stop is touched again, counted on where the motion repeats."""
    later = np.flatnonzero(touched[last + 1 :])
    if len(later):
        return int(last + 1 + later[0])
    return len(touched) + (int(np.flatnonzero(touched)[0]) if periodic else 0)


def _runs(touched: NDArray[np.bool_], periodic: bool, goes_on: bool) -> list[NDArray[np.int64]]:
    """Return the pieces of each complete contact, by the order in which they begin."""
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
