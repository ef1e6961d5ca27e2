"""The contacts of a motion: their times, durations, forces and energies."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.datasets.stops import part_names
from vibroimpact.engine.observers import phases as layout
from vibroimpact.engine.state import FIRST
from vibroimpact.model import Record, Repeated
from vibroimpact.model.argument_types import NonNegative
from vibroimpact.model.public import public
from vibroimpact.model.rig import several_masses_only
from vibroimpact.response.assembly_state import free_rate
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.motion_phases import Origin, Phases, phases, recorded

_Array = NDArray[np.float64]
_Numbers = NDArray[np.int64]

GRAZING = 1e-3
"""A contact counts as grazing if its closing speed is below this share of the motion's largest
speed."""


@public
def contacts(motion: xr.Dataset, grazing: NonNegative = GRAZING) -> xr.Dataset:
    """List the contacts of a motion, with times, forces, impulses and energy losses.

    Times, forces and integrals are exact up to rounding errors. They do not depend on the samples.
    If a contact starts before the simulated motion or continues after its end, it is left out. In a
    periodic motion such a contact is complete, because the start of the period continues the end. A
    contact that starts at the first instant of the motion is listed.

    Parameters
    ----------
    motion
        Dataset of `steady`, or of `simulate` with samples, including a motion through a `Record`.
        The motion is simulated again from its initial state. It may be cut at its end, and under a
        periodic excitation at its start, too.
    grazing
        A contact is flagged as grazing if its closing speed is below this share of the largest
        speed of the motion.

    Returns
    -------
    xarray.Dataset
        The dim ``contact_number`` counts the contacts in the order in which they start. Velocities
        are relative to the base. Contact forces and impulses are positive for both stops. Energy
        losses are the energies dissipated in the dashpot of the bumper.

        An impact on a rigid stop lasts 0 s. It has an impulse and an energy loss, but its force has
        no finite peak (NaN). If the mass rests on a rigid stop, the rest is a separate contact. A
        motion through a `Record` has no period. Therefore its contacts have no phases and no shares
        of the period.

        Of an assembly, ``contact_stop`` is the name of the stop, and the velocities have the dim
        ``mass``. A closing speed is that of the two bodies of the stop, and the coefficient of
        restitution is the ratio of their relative velocities. There are no accelerations.

    Raises
    ------
    InputError
        If the dataset does not hold a motion with samples, or if ``grazing`` is negative.
    """
    origin = recorded(motion, masses=True, records=True)
    all_phases = phases(motion, origin)
    data = contact_log(motion, origin, all_phases, grazing)
    notes = [*noted(motion), *all_phases.notes]
    return describe(data, "vibroimpact.contacts", motion_parameters(motion), notes)


def contact_log(
    motion: xr.Dataset, origin: Origin, all_phases: Phases, share: float = GRAZING
) -> xr.Dataset:
    """List the contacts of a motion whose phases were measured.

    `share` is ``grazing`` of `contacts`.
    """
    stops = range(len(all_phases.stops))
    every_kind = [_impacts(all_phases), *(_lasting(all_phases, origin, stop) for stop in stops)]
    chosen = _Contacts(*map(np.concatenate, zip(*every_kind, strict=True)))
    chosen = chosen.take(np.argsort(chosen.order, kind="stable"))
    chosen = _with_memories(chosen, motion, origin, all_phases)
    ahead, behind = (
        (all_phases.closing[chosen.stop] * v).sum(axis=1) for v in (chosen.arrival, chosen.parting)
    )
    fastest = max(
        float(np.abs(motion[name].values).max(initial=0.0))
        for name in ("velocity", "event_velocity")
    )
    of_masses = engine_system(origin.system).of_masses
    _, arrival = of_masses((), chosen.arrival)
    _, parting = of_masses((), chosen.parting)
    values = {
        "stop": np.array(all_phases.stops, dtype=np.str_)[chosen.stop],
        "start": chosen.begin,
        "end": chosen.begin + chosen.length,
        **_in_the_cycle(chosen, origin.shaking),
        "duration": chosen.length,
        "start_velocity": arrival,
        "end_velocity": parting,
        "peak_force": chosen.force,
        "impulse": chosen.impulse,
        "penetration": chosen.penetration,
        "dissipated": chosen.dissipated,
        "dissipated_relaxing": chosen.relaxing,
        "closing_speed": chosen.closing,
        # Of bodies that recede as the bumper catches up with them there is none.
        "restitution": np.divide(
            -behind, ahead, out=np.full(len(ahead), np.nan), where=ahead > 0.0
        ),
        "grazing": chosen.closing < share * fastest,
    }
    if not origin.system.by_mass:
        values |= {"peak_acceleration": chosen.peak, "peak_time": chosen.begin + chosen.peak_time}
    return xr.Dataset(
        {
            f"contact_{name}": (("contact_number", "mass")[: value.ndim], value)
            for name, value in values.items()
        },
        part_names(origin.system, "mass"),
    )


def _in_the_cycle(chosen: _Contacts, shaken: Repeated | Record) -> dict[str, _Array]:
    """Return the phases of the forcing at which contacts begin and end; empty for a record."""
    if isinstance(shaken, Record):
        return {}
    share = chosen.length / shaken.period
    return {
        "start_phase": chosen.angle % (2.0 * np.pi),
        "end_phase": (chosen.angle + 2.0 * np.pi * share) % (2.0 * np.pi),
        "duration_share": share,
    }


class _Contacts(NamedTuple):
    """Arrays with one value per contact."""

    order: _Array
    """Index of the phase in which the contact begins; of an impact, between two."""
    stop: _Numbers
    begin: _Array
    angle: _Array
    length: _Array
    arrival: _Array
    """Velocities at the start, shape (contact, mass)."""
    parting: _Array
    """Velocities at the end."""
    closing: _Array
    force: _Array
    impulse: _Array
    penetration: _Array
    dissipated: _Array
    relaxing: _Array
    peak: _Array
    """Largest absolute acceleration, of one mass."""
    peak_time: _Array
    """Time since the start of the contact."""

    def take(self, chosen: _Numbers) -> _Contacts:
        """Return the chosen contacts."""
        parts = {name: values[chosen] for name, values in self._asdict().items()}
        return _Contacts(**parts)


def _lasting(all_phases: Phases, origin: Origin, stop: int) -> _Contacts:
    """Find the complete contacts with a bumper, or rests on a rigid stop."""
    runs = _runs(all_phases, origin, stop)
    count = len(runs)
    part = np.array([i for run in runs for i in run], dtype=np.int64)
    owner = np.repeat(np.arange(count), [len(run) for run in runs])
    first, last = (np.array([run[i] for run in runs], dtype=np.int64) for i in (0, -1))

    def most(values: _Array) -> _Array:
        out = np.full(count, -np.inf)
        np.maximum.at(out, owner, values[part])
        return out

    def total(values: _Array) -> _Array:
        return np.bincount(owner, values[part], count).astype(np.float64)

    length = all_phases.rows[:, layout.LENGTH]
    low, high = all_phases.of_mass(layout.A_LEAST)[:, 0], all_phases.of_mass(layout.A_MOST)[:, 0]
    peaks = np.maximum(-low, high)
    peak = most(peaks)
    # The first phase of each contact that reaches its peak.
    reaches = np.flatnonzero(~(peaks[part] < peak[owner]))
    at = np.full(count, len(part))
    np.minimum.at(at, owner[reaches], reaches)
    earlier = np.arange(len(part)) < at[owner]
    before = np.bincount(owner, np.where(earlier, length[part], 0.0), count)
    # The event with which it begins ends the phase before it; a rest begins behind it.
    ahead, closing = (
        all_phases.of_mass(layout.PARTING)[first - 1],
        all_phases.of_stop(layout.CLOSING),
    )
    system = all_phases.system
    rests = system.by_mass and system.stop_laws[system.counted_stops[stop]].rigid
    return _Contacts(
        first.astype(np.float64),
        np.full(count, stop),
        all_phases.bounds[first],
        all_phases.angle[first],
        total(length),
        ahead,
        all_phases.of_mass(layout.ARRIVAL)[last],
        ahead @ all_phases.closing[stop] if rests else closing[first - 1, stop],
        most(all_phases.of_stop(layout.FORCE)[:, stop]),
        total(all_phases.of_stop(layout.IMPULSE)[:, stop]),
        most(all_phases.of_stop(layout.DEPTH)[:, stop]),
        total(all_phases.of_stop(layout.LOSES)[:, stop]),
        _relaxing(all_phases, origin, stop, runs),
        peak,
        before + all_phases.of_mass(layout.A_TIME)[part[at], 0],
    )


def _with_memories(
    chosen: _Contacts, motion: xr.Dataset, origin: Origin, all_phases: Phases
) -> _Contacts:
    """Correct what the engine does not know of stops with a memory: energies, and their faces.

    At a contact's ends the bodies are at the face, which is the memory. The engine counts what a
    stop takes up while it is pressed, stored or lost.
    """
    if not origin.system.by_mass:
        return chosen
    system = several_masses_only(origin.system)
    closing, lost, relaxing = (
        one.copy() for one in (chosen.closing, chosen.dissipated, chosen.relaxing)
    )
    whole = float(motion["time"].values[-1] - motion["time"].values[0])
    for stop, link in enumerate(system.stops.values()):
        law, mine = link.stop, np.flatnonzero(chosen.stop == stop)
        if not law.remembers or not len(mine):
            continue
        events = motion["event_stop"].values == all_phases.stops[stop]
        times = motion["event_time"].values[events]
        memory = motion["event_displacement"].values[events] @ all_phases.closing[stop] - law.gap
        last = all_phases.final[FIRST + 2 * len(system.names) + stop]
        energy = np.array([law.stored_energy(one, one) for one in [*memory, float(last)]])
        for k in mine:
            begin, end = chosen.begin[k], chosen.begin[k] + chosen.length[k]
            if origin.periodic and end > whole:  # cut in two by the section
                end -= whole
            at, left = (int(np.argmin(abs(times - when))) for when in (begin, end))
            met = left + 1 if left + 1 < len(times) or not origin.periodic else 0
            lost[k] -= energy[left] - energy[at]
            relaxing[k] = energy[left] - energy[met]
            closing[k] -= free_rate(law, memory[at])
    return chosen._replace(closing=closing, dissipated=lost, relaxing=relaxing)


def _runs(all_phases: Phases, origin: Origin, stop: int) -> list[_Numbers]:
    """Find the phases of each complete contact with a stop."""
    touched = all_phases.pressed[:, stop]
    begins = np.flatnonzero(touched & ~np.append(False, touched[:-1]))
    ends = np.flatnonzero(touched & ~np.append(touched[1:], False))
    runs = [np.arange(i, j + 1) for i, j in zip(begins, ends, strict=True)]
    if not origin.periodic:
        # The end of the motion may lie exactly at an event.
        cut = len(touched) > 0 and all_phases.rows[-1, layout.KIND] == layout.NOTHING
        return [run for run in runs if run[0] > 0 and not (cut and run[-1] == len(touched) - 1)]
    if len(touched) and touched[0] and touched[-1]:
        # One contact, cut in two by the section: the end of the motion is its beginning.
        joined = [np.append(runs[-1], runs[0])] if len(runs) > 1 else []
        runs = [*runs[1:-1], *joined]
    # Else, between a contact and a flight the section lies exactly at the event.
    return runs


def _impacts(all_phases: Phases) -> _Contacts:
    """Find the impacts on rigid stops: contacts of no duration, whose force has no finite peak."""
    at = all_phases.impacts
    stop = all_phases.rows[at, layout.AT_STOP].astype(np.int64)
    none = np.zeros(len(at))
    return _Contacts(
        at.astype(np.float64) + 0.5,
        stop,
        all_phases.bounds[at + 1],
        all_phases.angle[at + 1],
        none,
        all_phases.of_mass(layout.ARRIVAL)[at],
        all_phases.of_mass(layout.PARTING)[at],
        all_phases.of_stop(layout.CLOSING)[at, stop],
        np.full(len(at), np.nan),
        all_phases.rows[at, layout.STRUCK],
        none,
        all_phases.of_stop(layout.HIT)[at, stop],
        none,
        all_phases.of_mass(layout.A_EVENT)[at, 0],
        none,
    )


def _relaxing(all_phases: Phases, origin: Origin, stop: int, runs: list[_Numbers]) -> _Array:
    """Compute the energy that the free bumper loses after each contact, until the next one."""
    lost = np.zeros(len(runs))
    touched = all_phases.pressed[:, stop]
    owners = np.full(len(touched), -1)
    for n, run in enumerate(runs):
        owners[run] = n
    before = np.maximum.accumulate(np.where(touched, np.arange(len(touched)), -1))
    if origin.periodic and touched.any():
        before[before < 0] = np.flatnonzero(touched)[-1]
    owner = np.where(before < 0, -1, owners[before])
    known = (owner >= 0) & ~touched  # others are of a contact before the motion
    np.add.at(lost, owner[known], all_phases.of_stop(layout.LOSES)[known, stop])
    return lost
