"""Contacts one by one: when, how long, how hard, and what they cost."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import measure
from vibroimpact.model import to_si
from vibroimpact.model.units import DIMENSIONLESS
from vibroimpact.response.phases import (
    Phases,
    Recorded,
    cut,
    measured,
    recorded,
    relaxation_loss,
)
from vibroimpact.response.variables import describe, motion_parameters

GRAZING = 1e-3
"""A contact grazes if it closes slower than this share of the motion's largest speed."""


def contacts(motion: xr.Dataset, grazing: float = GRAZING) -> xr.Dataset:
    """List the contacts of a motion, one row a contact.

    Times, forces and integrals are exact to rounding; nothing depends on the samples. A contact
    that had begun before the record, or goes on behind it, is left out; that of a periodic
    motion is taken round its end.

    Parameters
    ----------
    motion
        Dataset of `steady`, or of `simulate` with samples.
    grazing
        Share of the motion's largest speed below which a closing velocity is flagged as grazing.

    Returns
    -------
    xarray.Dataset
        Dim ``contact_number``, in the order of their beginning. Velocities are relative to the
        base; forces press on the mass, positive; energies are lost in the bumper's dashpot.

    Raises
    ------
    InputError
        If the dataset is not that of a motion with samples, or `grazing` is negative.
    """
    share = to_si(grazing, DIMENSIONLESS, "grazing", minimum=0.0)
    origin = recorded(motion)
    data = contact_log(motion, origin, cut(motion, origin), None, share)
    return describe(data, "vibroimpact.contacts", motion_parameters(motion))


def contact_log(
    motion: xr.Dataset,
    origin: Recorded,
    every: Phases,
    rows: NDArray[np.float64] | None,
    share: float = GRAZING,
) -> xr.Dataset:
    """As `contacts`, of a motion that has been cut into phases, and perhaps measured.

    Parameters
    ----------
    motion, origin, every
        The motion, where it comes from, and its phases.
    rows
        What `phases.measured` found of each phase; None if nobody has looked.
    share
        As `grazing` of `contacts`.
    """
    chosen, first = _whole_contacts(every, origin)
    if rows is None:
        found = measured(origin, chosen)
    else:
        found = rows[first]
        if len(first) and chosen.length[-1] != every.length[first[-1]]:
            # A contact that the section had cut in two.
            found[-1] = measured(origin, chosen.take(np.array([len(first) - 1])))[0]
    mass, period = origin.oscillator.mass, origin.excitation.period
    side, begin = chosen.contact, chosen.begin
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
        "start_phase": chosen.angle % (2.0 * np.pi),
        "end_phase": (chosen.angle + 2.0 * np.pi * chosen.length / period) % (2.0 * np.pi),
        "duration": chosen.length,
        "duration_share": chosen.length / period,
        "start_velocity": closing,
        "end_velocity": parting,
        "peak_force": mass * found[:, measure.FORCE],
        "impulse": mass * found[:, measure.IMPULSE],
        "penetration": found[:, measure.X_MOST],
        "dissipated": damping * found[:, measure.SQUARES],
        "dissipated_relaxing": _relaxing(every, first, origin),
        "peak_acceleration": np.maximum(
            np.abs(found[:, measure.A_LEAST]), np.abs(found[:, measure.A_MOST])
        ),
        "peak_time": begin + found[:, measure.A_TIME],
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


def _whole_contacts(every: Phases, origin: Recorded) -> tuple[Phases, NDArray[np.int64]]:
    """The contacts that the record holds from beginning to end, and the phase each begins in."""
    inner = np.flatnonzero(every.contact)
    last = len(every.contact) - 1
    cut = [i for i in (0, last) if i in inner]
    if origin.periodic and len(cut) < 2:
        # Between a contact and a flight the section lies exactly at the event.
        return every.take(inner), inner
    kept = np.array([i for i in inner if i not in cut], dtype=np.int64)
    if not origin.periodic or last == 0 or every.contact[0] != every.contact[last]:
        return every.take(kept), kept
    # One contact, cut in two by the section: the end of the record is its beginning.
    first = np.append(kept, last)
    chosen = every.take(first)
    chosen.length[-1] += every.length[0]
    chosen.last[-1] = every.last[0]
    return chosen, first


def _relaxing(every: Phases, first: NDArray[np.int64], origin: Recorded) -> NDArray[np.float64]:
    """Energy that each free bumper loses between its contacts.

    It is counted to the contact before, which is given by the phase in which it begins.
    """
    lost = np.zeros(len(every.contact))
    last = len(every.contact) - 1
    losses = relaxation_loss(origin, every)
    for side, of_side in zip((1, -1), losses.T, strict=True):
        pressed = np.flatnonzero(every.contact == side)
        if not len(pressed):
            continue
        for i in np.flatnonzero(every.contact != side):
            earlier = pressed[pressed < i]
            if len(earlier):
                owner = earlier[-1]
            elif origin.periodic:
                owner = pressed[-1]
            else:
                continue  # of a contact before the record
            if owner == 0 and last in pressed and origin.periodic:
                owner = last  # the contact that the end of the period cuts begins there
            lost[owner] += of_side[i]
    return lost[first]
