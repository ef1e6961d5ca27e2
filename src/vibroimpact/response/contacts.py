"""The contacts of a motion: their times, durations, forces and energies."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.datasets.stops import stop_names
from vibroimpact.engine.observers import phases as layout
from vibroimpact.engine.observers.record import IMPACT
from vibroimpact.model import Record, Repeated, to_si
from vibroimpact.model.quantities import DIMENSIONLESS
from vibroimpact.response.assembly_contacts import assembly_contacts, has_assembly
from vibroimpact.response.motion_phases import SIDES, Phases, Recorded, any_recorded, phases

_Array = NDArray[np.float64]
_Numbers = NDArray[np.int64]

GRAZING = 1e-3
"""A contact counts as grazing if its closing speed is below this share of the motion's largest
speed."""


def contacts(motion: xr.Dataset, grazing: float = GRAZING) -> xr.Dataset:
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
    share = to_si(grazing, DIMENSIONLESS, "grazing", minimum=0.0)
    if has_assembly(motion):
        return assembly_contacts(motion, share)
    origin = any_recorded(motion)
    every = phases(motion, origin)
    data = contact_log(motion, origin, every, share)
    notes = [*noted(motion), *every.notes]
    return describe(data, "vibroimpact.contacts", motion_parameters(motion), notes)


def contact_log(
    motion: xr.Dataset, origin: Recorded[Any], every: Phases, share: float = GRAZING
) -> xr.Dataset:
    """List the contacts of a motion whose phases were measured.

    Parameters
    ----------
    motion, origin, every
        The motion, its origin, and its phases.
    share
        As ``grazing`` of `contacts`.
    """
    every_kind = [_lasting(every, origin, number) for number in range(len(SIDES))]
    chosen = _Contacts(*map(np.concatenate, zip(*every_kind, _impacts(every), strict=True)))
    chosen = chosen.take(np.argsort(chosen.order, kind="stable"))
    mass = origin.oscillator.mass
    begin, closing, parting = chosen.begin, chosen.arrival, chosen.parting
    fastest = np.abs(
        np.concatenate([motion["velocity"].values, motion["event_velocity"].values])
    ).max()
    values = {
        "stop": stop_names(chosen.side),
        "start": begin,
        "end": begin + chosen.length,
        **_in_the_cycle(chosen, origin.excitation),
        "duration": chosen.length,
        "start_velocity": closing,
        "end_velocity": parting,
        "peak_force": mass * chosen.force,
        "impulse": mass * chosen.impulse,
        "penetration": chosen.penetration,
        "dissipated": mass * chosen.dissipated,
        "dissipated_relaxing": mass * chosen.relaxing,
        "peak_acceleration": chosen.peak,
        "peak_time": begin + chosen.peak_time,
        "closing_speed": chosen.closing,
        # Of a mass that recedes as the bumper catches up with it there is none.
        "restitution": np.divide(
            -parting, closing, out=np.full(len(closing), np.nan), where=chosen.side * closing > 0.0
        ),
        "grazing": chosen.closing < share * fastest,
    }
    return xr.Dataset(
        {f"contact_{name}": ("contact_number", value) for name, value in values.items()}
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
    """Arrays with one value per contact; force, impulse and energies per unit mass."""

    order: _Numbers
    """Index of the phase in which the contact begins."""
    side: _Numbers
    begin: _Array
    angle: _Array
    length: _Array
    arrival: _Array
    """Velocity at the start."""
    parting: _Array
    """Velocity at the end."""
    closing: _Array
    force: _Array
    impulse: _Array
    penetration: _Array
    dissipated: _Array
    relaxing: _Array
    peak: _Array
    """Largest absolute acceleration."""
    peak_time: _Array
    """Time since the start of the contact."""

    def take(self, chosen: _Numbers) -> _Contacts:
        """Return the chosen contacts."""
        parts = {name: values[chosen] for name, values in self._asdict().items()}
        return _Contacts(**parts)


def _lasting(every: Phases, origin: Recorded[Any], number: int) -> _Contacts:
    """Find the contacts with a bumper, or rests on a rigid stop, of one side."""
    runs = _runs(every, origin, number)
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

    length = every.rows[:, layout.LENGTH]
    peaks = np.maximum(-every.of_mass(layout.A_LEAST), every.of_mass(layout.A_MOST))
    peak = most(peaks)
    # The first phase of each contact that reaches its peak.
    reaches = np.flatnonzero(~(peaks[part] < peak[owner]))
    at = np.full(count, len(part))
    np.minimum.at(at, owner[reaches], reaches)
    earlier = np.arange(len(part)) < at[owner]
    before = np.bincount(owner, np.where(earlier, length[part], 0.0), count)
    return _Contacts(
        first,
        np.full(count, SIDES[number]),
        every.bounds[first],
        every.angle[first],
        total(length),
        # The event with which it begins ends the phase before it.
        every.of_mass(layout.PARTING)[first - 1],
        every.of_mass(layout.ARRIVAL)[last],
        every.of_stop(layout.CLOSING, number)[first - 1],
        most(every.of_stop(layout.FORCE, number)),
        total(every.of_stop(layout.IMPULSE, number)),
        most(every.of_stop(layout.DEPTH, number)),
        total(every.of_stop(layout.LOSES, number)),
        _relaxing(every, origin, number, runs),
        peak,
        before + every.of_mass(layout.A_TIME)[part[at]],
    )


def _runs(every: Phases, origin: Recorded[Any], number: int) -> list[_Numbers]:
    """Find the phases of each complete contact with a stop."""
    touched = every.touched(number)
    begins = np.flatnonzero(touched & ~np.append(False, touched[:-1]))
    ends = np.flatnonzero(touched & ~np.append(touched[1:], False))
    runs = [np.arange(i, j + 1) for i, j in zip(begins, ends, strict=True)]
    if not origin.periodic:
        # The end of the motion may lie exactly at an event.
        cut = every.rows[-1, layout.KIND] == layout.NOTHING
        return [run for run in runs if run[0] > 0 and not (cut and run[-1] == len(touched) - 1)]
    if touched[0] and touched[-1]:
        # One contact, cut in two by the section: the end of the motion is its beginning.
        joined = [np.append(runs[-1], runs[0])] if len(runs) > 1 else []
        runs = [*runs[1:-1], *joined]
    # Else, between a contact and a flight the section lies exactly at the event.
    return runs


def _impacts(every: Phases) -> _Contacts:
    """Find the impacts on rigid stops: contacts of no duration, whose force has no finite peak."""
    at = np.flatnonzero(every.rows[:, layout.KIND] == IMPACT)
    number = every.rows[at, layout.AT_STOP].astype(np.int64)
    before, behind = every.of_mass(layout.ARRIVAL)[at], every.of_mass(layout.PARTING)[at]
    lost, closing = (
        np.choose(number, [every.of_stop(column, stop)[at] for stop in range(len(SIDES))])
        for column in (layout.HIT, layout.CLOSING)
    )
    none = np.zeros(len(at))
    return _Contacts(
        at + 1,
        np.take(SIDES, number),
        every.bounds[at + 1],
        every.angle[at + 1],
        none,
        before,
        behind,
        closing,
        np.full(len(at), np.nan),
        every.rows[at, layout.STRUCK],
        none,
        lost,
        none,
        every.of_mass(layout.A_EVENT)[at],
        none,
    )


def _relaxing(every: Phases, origin: Recorded[Any], number: int, runs: list[_Numbers]) -> _Array:
    """Compute the energy that the free bumper loses after each contact, until the next one."""
    lost = np.zeros(len(runs))
    touched = every.touched(number)
    owners = np.full(len(touched), -1)
    for n, run in enumerate(runs):
        owners[run] = n
    before = np.maximum.accumulate(np.where(touched, np.arange(len(touched)), -1))
    if origin.periodic and touched.any():
        before[before < 0] = np.flatnonzero(touched)[-1]
    owner = np.where(before < 0, -1, owners[before])
    known = (owner >= 0) & ~touched  # others are of a contact before the motion
    np.add.at(lost, owner[known], every.of_stop(layout.LOSES, number)[known])
    return lost
