"""Contacts one by one: when, how long, how hard, and what they cost."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import measure
from vibroimpact.model import to_si
from vibroimpact.model.units import DIMENSIONLESS
from vibroimpact.response.phases import Phases, Recorded, measured, phases, recorded
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
    every = phases(motion)
    chosen = _whole_contacts(every, origin)
    found = measured(origin, chosen)
    mass, period = origin.oscillator.mass, origin.excitation.period
    side, begin = chosen.contact, chosen.begin
    closing, parting = chosen.first[:, 1], chosen.last[:, 1]
    fastest = np.abs(
        np.concatenate([motion["velocity"].values, motion["event_velocity"].values])
    ).max()
    damping = _of_side(origin, side, "damping")
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
        "dissipated_relaxing": _relaxing(chosen, origin),
        "peak_acceleration": np.maximum(
            np.abs(found[:, measure.A_LEAST]), np.abs(found[:, measure.A_MOST])
        ),
        "peak_time": begin + found[:, measure.A_TIME],
        "restitution": np.divide(
            -parting, closing, out=np.full(len(closing), np.nan), where=closing != 0.0
        ),
        "grazing": np.abs(closing) < share * fastest,
    }
    data = xr.Dataset(
        {f"contact_{name}": ("contact_number", value) for name, value in values.items()}
    )
    return describe(data, "vibroimpact.contacts", motion_parameters(motion))


def _whole_contacts(every: Phases, origin: Recorded) -> Phases:
    """The contacts that the record holds from beginning to end."""
    inner = np.flatnonzero(every.contact)
    last = len(every.contact) - 1
    cut = [i for i in (0, last) if i in inner]
    if not cut:
        return every.take(inner)
    kept = every.take(np.array([i for i in inner if i not in cut], dtype=np.int64))
    if not (origin.periodic and len(cut) == 2 and every.contact[0] == every.contact[last]):
        return kept
    # One contact, cut in two by the section: the end of the record is its beginning.
    whole = every.take(np.array([last]))
    whole.length[0] += every.length[0]
    whole.last[0] = every.last[0]
    return Phases(*(np.concatenate(pair) for pair in zip(kept, whole, strict=True)))


def _of_side(origin: Recorded, side: NDArray[np.int64], name: str) -> NDArray[np.float64]:
    """A bumper's number for each contact."""
    right, left = (
        getattr(bumper, name) if bumper else np.nan
        for bumper in (origin.oscillator.right, origin.oscillator.left)
    )
    return np.where(side == 1, right, left)


def _relaxing(chosen: Phases, origin: Recorded) -> NDArray[np.float64]:
    """Energy that the free bumper loses until it is pressed again, or until the record ends."""
    lost = np.zeros(len(chosen.contact))
    length = origin.cycles * origin.excitation.period
    for side, component, bumper in (
        (1, 2, origin.oscillator.right),
        (-1, 3, origin.oscillator.left),
    ):
        mine = np.flatnonzero(chosen.contact == side)
        if bumper is None or bumper.damping == 0.0 or not len(mine):
            continue
        begun = chosen.begin[mine]
        until = np.append(begun[1:], begun[0] + length if origin.periodic else length)
        rest = until - (begun + chosen.length[mine])
        stored = 0.5 * bumper.stiffness * chosen.last[mine, component] ** 2
        lost[mine] = -stored * np.expm1(-2.0 * bumper.stiffness / bumper.damping * rest)
    return lost
