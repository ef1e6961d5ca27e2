"""The phases of a recorded motion: flights and contacts, each from its exact beginning."""

from __future__ import annotations

import json
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import measure
from vibroimpact.engine.motion import BOTH, FLIGHT, LEFT, RIGHT, SEEN_LEFT
from vibroimpact.engine.observers.record import CONTACT_BEGINS, DETACHMENT, IMPACT
from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Oscillator, Repeated, RigidStop, State, validate
from vibroimpact.response.start import engine_rig
from vibroimpact.response.variables import excitation_from

_Array = NDArray[np.float64]

SIDES = (1, -1)

_COMPONENTS = ("displacement", "velocity", "right_bumper", "left_bumper")


class Recorded(NamedTuple):
    """What a dataset of a motion says of its origin."""

    oscillator: Oscillator
    excitation: Repeated
    """Its phase is that at the beginning of the record."""
    cycles: float
    """Length of the record."""
    periodic: bool
    """Whether the record is one period of a periodic motion: its end is its beginning."""

    def of_side(self, side: NDArray[np.int64], name: str) -> _Array:
        """A stop's number for each phase by the stop touched, 0 where it has none.

        Of both stops it is the sum, the gap that of the right one.
        """
        right, left = (
            getattr(stop, name, 0.0) for stop in (self.oscillator.right, self.oscillator.left)
        )
        both = right if name == "gap" else right + left
        return np.select([side == 1, side == -1, side == 2], [right, left, both], 0.0)

    def resting(self, contact: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Whether the mass rests on a rigid stop in each phase."""
        rests = np.zeros(len(contact), dtype=bool)
        for side, stop in zip(SIDES, (self.oscillator.right, self.oscillator.left), strict=True):
            if isinstance(stop, RigidStop):
                rests |= touches(contact, side)
        return rests


def touches(contact: NDArray[np.int64], side: int) -> NDArray[np.bool_]:
    """Whether the stop of a side is touched."""
    touched: NDArray[np.bool_] = (contact == side) | (contact == 2)
    return touched


class Phases(NamedTuple):
    """Phases of a motion, in the order of time: one value each, or one row of a state each."""

    contact: NDArray[np.int64]
    """Stop touched: -1 left, 0 none, 1 right, 2 both."""
    struck: NDArray[np.int64]
    """Side of the impact on a rigid stop with which the phase begins, or 0."""
    begin: _Array
    """s, from the beginning of the record."""
    angle: _Array
    """The forcing's phase at the beginning, rad; not reduced over the cycles of one record."""
    length: _Array
    """s."""
    first: _Array
    """State at the beginning: u, u̇, u_R, u_L, shape (phase, 4)."""
    last: _Array
    """State at the end, shape (phase, 4); an impact there is still to come."""

    def take(self, chosen: NDArray[np.int64]) -> Phases:
        """The chosen phases."""
        parts = {name: values[chosen] for name, values in self._asdict().items()}
        return Phases(**parts)


def recorded(motion: xr.Dataset) -> Recorded:
    """Whose motion a dataset holds.

    Raises
    ------
    InputError
        If it is not the dataset of a motion with samples and events.
    """
    held = isinstance(motion, xr.Dataset) and {"event_time", "cycle", "velocity"} <= set(
        motion.variables
    )
    if not held or not motion.sizes["time"]:
        raise InputError(
            "motion: this is no recorded motion; a dataset of steady, or of simulate with samples, "
            "is accepted"
        )
    parameters = json.loads(motion.attrs["parameters"])
    oscillator = validate(Oscillator, parameters["oscillator"], "motion.oscillator")
    assert isinstance(oscillator, Oscillator)
    return Recorded(
        oscillator,
        excitation_from(parameters),
        float(motion["cycle"].values[-1]),
        "period" in motion and int(motion["period"]) > 0,
    )


def beginning(motion: xr.Dataset) -> State:
    """The state at the beginning of a record, with the forcing's phase."""
    values = {name: float(motion[name].values[0]) for name in _COMPONENTS}
    return State(
        **values,
        contact=int(motion["contact"].values[0]),
        phase=json.loads(motion.attrs["parameters"])["phase"],
    )


def phases(motion: xr.Dataset) -> Phases:
    """Cut a recorded motion at its contacts and detachments.

    Raises
    ------
    InputError
        If it is not the dataset of a motion with samples and events.
    """
    return cut(motion, recorded(motion))


def cut(motion: xr.Dataset, origin: Recorded) -> Phases:
    """As `phases`, of a motion whose origin is known."""
    period = origin.excitation.period
    # A motion that was given up has events behind its last sample.
    at = motion["event_cycle"].values + motion["event_cycle_time"].values / period
    motion = motion.isel(event=at <= origin.cycles * (1.0 + 1e-12))
    at_events = np.stack([motion[f"event_{name}"].values for name in _COMPONENTS], axis=-1)
    ends = [np.array([motion[name].values[i] for name in _COMPONENTS]) for i in (0, -1)]
    kinds, sides = motion["event_contact"].values, motion["event_side"].values
    if len(at_events) and not motion["event_cycle"][0] and not motion["event_cycle_time"][0]:
        ends[0] = at_events[0]  # the first sample lies behind an event at once
    struck = np.where(kinds == IMPACT, sides, 0)
    behind = at_events.copy()
    for side, stop in zip(SIDES, (origin.oscillator.right, origin.oscillator.left), strict=True):
        if isinstance(stop, RigidStop):
            behind[struck == side, 1] *= -stop.restitution
            behind[(kinds == CONTACT_BEGINS) & (sides == side), 1] = 0.0
    right, left = (_touched(side, kinds, sides, int(motion["contact"].values[0])) for side in SIDES)
    contact = np.where(right & left, 2, right.astype(np.int64) - left)
    # Differences within cycles keep digits that absolute times lose.
    cycle = np.concatenate([[0], motion["event_cycle"].values, [np.floor(origin.cycles)]])
    within = np.concatenate(
        [[0.0], motion["event_cycle_time"].values, [(origin.cycles % 1.0) * period]]
    )
    return Phases(
        contact,
        np.append(0, struck).astype(np.int64),
        cycle[:-1] * period + within[:-1],
        origin.excitation.phase + 2.0 * np.pi * within[:-1] / period,
        np.maximum(np.diff(cycle) * period + np.diff(within), 0.0),
        np.vstack([ends[0], behind]),
        np.vstack([at_events, ends[1]]),
    )


def _touched(
    side: int, kinds: NDArray[np.int64], sides: NDArray[np.int64], sampled: int
) -> NDArray[np.bool_]:
    """Whether a side is touched before the first event and behind each.

    Its first contact or detachment tells what was before; the first sample may lie behind it.
    """
    change = np.where(sides == side, (kinds == CONTACT_BEGINS) * 1 - (kinds == DETACHMENT), 0)
    events = change[change != 0]
    first = events[0] < 0 if len(events) else sampled in (side, 2)
    return np.append(0, np.cumsum(change)) + first > 0


def view(parts: Phases) -> NDArray[np.int64]:
    """The side from which each phase is measured by itself: of both that of the right stop."""
    return np.where(parts.contact == 2, 1, parts.contact)


def measured(origin: Recorded, parts: Phases, side: NDArray[np.int64] | None = None) -> _Array:
    """Measure phases: rows of `engine.measure`, per unit mass, as the stop on a side sees them."""
    side = view(parts) if side is None else side
    both = parts.contact == 2
    mode = np.select(
        [both & (side == 1), both, side == 1, side == -1], [BOTH, SEEN_LEFT, RIGHT, LEFT], FLIGHT
    )
    x = np.where(side == 0, parts.first[:, 0], np.where(side == 1, parts.first[:, 2], 0.0))
    x = np.where(side == -1, -parts.first[:, 3], x)
    v = np.where(side == -1, -1.0, 1.0) * parts.first[:, 1]
    table = np.column_stack([mode, x, v, parts.angle, parts.length])
    found = np.zeros((len(side), measure.MEASURES))
    measure.measure_phases(
        engine_rig(origin.oscillator, origin.excitation),
        origin.excitation.amplitude,
        origin.excitation.frequency,
        np.ascontiguousarray(table, dtype=np.float64),
        found,
    )
    # A bumper that is pressed while the mass rests on the other stop is held as it is.
    for at, stop in zip(SIDES, (origin.oscillator.right, origin.oscillator.left), strict=True):
        if isinstance(stop, Bumper):
            held = (side == at) & both & origin.resting(parts.contact)
            force = stop.stiffness * np.abs(x[held]) / origin.oscillator.mass
            found[held, measure.FORCE] = force
            found[held, measure.IMPULSE] = force * parts.length[held]
    return found


def relaxation_loss(origin: Recorded, parts: Phases) -> _Array:
    """Energy (J) that each free bumper loses in each phase, shape (phase, 2): right, left.

    What its spring no longer holds at the end.
    """
    lost = np.zeros((len(parts.contact), 2))
    bumpers = (origin.oscillator.right, origin.oscillator.left)
    for i, (side, bumper) in enumerate(zip((1, -1), bumpers, strict=True)):
        if isinstance(bumper, Bumper):
            squares = parts.first[:, 2 + i] ** 2 - parts.last[:, 2 + i] ** 2
            lost[:, i] = np.where(
                touches(parts.contact, side), 0.0, 0.5 * bumper.stiffness * squares
            )
    return lost


def impact_loss(origin: Recorded, parts: Phases) -> _Array:
    """Energy (J) lost in the impact with which each phase begins; elsewhere nothing is."""
    arrival = np.append(parts.first[0, 1], parts.last[:-1, 1])
    return 0.5 * origin.oscillator.mass * (arrival**2 - parts.first[:, 1] ** 2)


def settling(origin: Recorded, parts: Phases) -> NDArray[np.bool_]:
    """Whether a phase is the end of a chatter, whose last impacts are not told one by one."""
    rests = np.append(origin.resting(parts.contact)[1:], False)
    last: NDArray[np.bool_] = rests & (parts.struck != 0) & (parts.last[:, 1] == 0.0)
    return last
