"""The contacts of a motion: their times, durations, forces and energies."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.engine import measure
from vibroimpact.model import Record, Repeated, to_si
from vibroimpact.model.quantities import DIMENSIONLESS
from vibroimpact.response.motion_phases import (
    SIDES,
    Phases,
    Recorded,
    any_recorded,
    cut,
    impact_loss,
    relaxation_loss,
    touches,
)
from vibroimpact.response.phase_measures import measured

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

    Raises
    ------
    InputError
        If the dataset does not hold a motion with samples, or if ``grazing`` is negative.
    """
    share = to_si(grazing, DIMENSIONLESS, "grazing", minimum=0.0)
    origin = any_recorded(motion)
    data = contact_log(motion, origin, cut(motion, origin), None, share)
    return describe(data, "vibroimpact.contacts", motion_parameters(motion), noted(motion))


def contact_log(
    motion: xr.Dataset,
    origin: Recorded[Any],
    every: Phases,
    rows: NDArray[np.float64] | None,
    share: float = GRAZING,
) -> xr.Dataset:
    """List the contacts of a motion that is already cut into phases, and perhaps measured.

    Parameters
    ----------
    motion, origin, every
        The motion, its origin, and its phases.
    rows
        Results of `phases.measured` for each phase; None if they were not computed.
    share
        As ``grazing`` of `contacts`.
    """
    lasting = [_lasting(every, origin, side, rows) for side in SIDES]
    every_kind = zip(*lasting, _impacts(motion, every, origin), strict=True)
    chosen = _Contacts(*map(np.concatenate, every_kind))
    chosen = chosen.take(np.argsort(chosen.order, kind="stable"))
    mass = origin.oscillator.mass
    side, begin = chosen.side, chosen.begin
    damping = origin.of_side(side, "damping")
    closing, parting = chosen.first[:, 1], chosen.last[:, 1]
    # The bumper may still be relaxing towards the mass: u̇_j = −u_j K_j / C_j.
    deformation = np.where(side == 1, chosen.first[:, 2], -chosen.first[:, 3])
    damped = damping > 0.0
    rate = np.divide(
        origin.of_side(side, "stiffness"), damping, out=np.zeros(len(side)), where=damped
    )
    approach = side * closing + rate * deformation
    fastest = np.abs(
        np.concatenate([motion["velocity"].values, motion["event_velocity"].values])
    ).max()
    values = {
        "side": side,
        "start": begin,
        "end": begin + chosen.length,
        **_in_the_cycle(chosen, origin.excitation),
        "duration": chosen.length,
        "start_velocity": closing,
        "end_velocity": parting,
        "peak_force": mass * chosen.force,
        "impulse": mass * chosen.impulse,
        "penetration": chosen.penetration,
        "dissipated": chosen.dissipated,
        "dissipated_relaxing": chosen.relaxing,
        "peak_acceleration": chosen.peak,
        "peak_time": begin + chosen.peak_time,
        "closing_speed": approach,
        # Of a mass that recedes as the bumper catches up with it there is none.
        "restitution": np.divide(
            -parting, closing, out=np.full(len(closing), np.nan), where=side * closing > 0.0
        ),
        "grazing": approach < share * fastest,
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
    """Arrays with one value per contact, or one row of a state; force and impulse per unit mass."""

    order: NDArray[np.int64]
    """Index of the phase in which the contact begins."""
    side: NDArray[np.int64]
    begin: _Array
    angle: _Array
    length: _Array
    first: _Array
    last: _Array
    force: _Array
    impulse: _Array
    penetration: _Array
    dissipated: _Array
    relaxing: _Array
    peak: _Array
    """Largest absolute acceleration."""
    peak_time: _Array
    """Time since the start of the contact."""

    def take(self, chosen: NDArray[np.int64]) -> _Contacts:
        """Return the chosen contacts."""
        parts = {name: values[chosen] for name, values in self._asdict().items()}
        return _Contacts(**parts)


def _lasting(
    every: Phases, origin: Recorded[Any], side: int, rows: NDArray[np.float64] | None
) -> _Contacts:
    """Find the contacts with a bumper, or rests on a rigid stop, of one side."""
    runs = _runs(every, origin, side)
    count = len(runs)
    part = np.array([i for run in runs for i in run], dtype=np.int64)
    owner = np.repeat(np.arange(count), [len(run) for run in runs])
    first, last = (np.array([run[i] for run in runs], dtype=np.int64) for i in (0, -1))
    chosen = every.take(part)
    seen = np.full(len(part), side)
    # Of phases in contact with both stops the rows tell what the right one sees.
    if rows is None or (side == -1 and (chosen.contact == 2).any()):
        found = measured(origin, chosen, seen)
    else:
        found = rows[part]

    def most(values: _Array) -> _Array:
        out = np.full(count, -np.inf)
        np.maximum.at(out, owner, values)
        return out

    def total(values: _Array) -> _Array:
        return np.bincount(owner, values, count).astype(np.float64)

    peaks = np.maximum(np.abs(found[:, measure.A_LEAST]), np.abs(found[:, measure.A_MOST]))
    peak = most(peaks)
    # The first phase of each contact that reaches its peak.
    reaches = np.flatnonzero(~(peaks < peak[owner]))
    at = np.full(count, len(part))
    np.minimum.at(at, owner[reaches], reaches)
    before = total(np.where(np.arange(len(part)) < at[owner], chosen.length, 0.0))
    peak_time = before + found[at, measure.A_TIME]
    lost = measure.LOST_RIGHT if side == 1 else measure.LOST_LEFT
    return _Contacts(
        first,
        np.full(count, side),
        every.begin[first],
        every.angle[first],
        total(chosen.length),
        every.first[first],
        every.last[last],
        most(found[:, measure.FORCE]),
        total(found[:, measure.IMPULSE]),
        most(found[:, measure.X_MOST]),
        origin.oscillator.mass * total(found[:, lost]),
        _relaxing(every, origin, side, runs),
        peak,
        peak_time,
    )


def _runs(every: Phases, origin: Recorded[Any], side: int) -> list[_Numbers]:
    """Find the phases of each complete contact of a side."""
    touched = touches(every.contact, side)
    end = len(touched) - 1
    begins = np.flatnonzero(touched & ~np.append(False, touched[:-1]))
    ends = np.flatnonzero(touched & ~np.append(touched[1:], False))
    runs = [np.arange(i, j + 1) for i, j in zip(begins, ends, strict=True)]
    if touched[0] and touched[end]:
        # One contact, cut in two by the section: the end of the record is its beginning.
        joined = [np.append(runs[-1], runs[0])] if origin.periodic and len(runs) > 1 else []
        runs = [*runs[1:-1], *joined]
    elif not origin.periodic:
        # Else, between a contact and a flight the section lies exactly at the event.
        runs = [run for run in runs if run[0] > 0 and run[-1] < end]
    return runs


def _impacts(motion: xr.Dataset, every: Phases, origin: Recorded[Any]) -> _Contacts:
    """Find the impacts on rigid stops: contacts of no duration, whose force has no finite peak."""
    at = np.flatnonzero(every.struck)
    before, behind, event = every.last[at - 1], every.first[at], every.event[at]
    sharp = np.maximum(
        np.abs(motion["event_acceleration_before"].values[event]),
        np.abs(motion["event_acceleration_after"].values[event]),
    )
    none = np.zeros(len(at))
    return _Contacts(
        at,
        every.struck[at],
        every.begin[at],
        every.angle[at],
        none,
        before,
        behind,
        np.full(len(at), np.nan),
        np.abs(before[:, 1] - behind[:, 1]),
        none,
        impact_loss(origin, every)[at],
        none,
        sharp,
        none,
    )


def _relaxing(every: Phases, origin: Recorded[Any], side: int, runs: list[_Numbers]) -> _Array:
    """Compute the energy that the free bumper loses after each contact, until the next one."""
    lost = np.zeros(len(runs))
    touched = touches(every.contact, side)
    number = np.full(len(touched), -1)
    for n, run in enumerate(runs):
        number[run] = n
    before = np.maximum.accumulate(np.where(touched, np.arange(len(touched)), -1))
    if origin.periodic and touched.any():
        before[before < 0] = np.flatnonzero(touched)[-1]
    owner = np.where(before < 0, -1, number[before])
    told = owner >= 0  # others are of a contact before the record
    np.add.at(lost, owner[told], relaxation_loss(origin, every)[told, SIDES.index(side)])
    return lost
