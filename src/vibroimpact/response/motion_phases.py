"""The phases of a recorded motion: flights and contacts, each from its exact beginning."""

from __future__ import annotations

import json
import math
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import excitation_from
from vibroimpact.engine.motion import LEFT, RELEASED, RIGHT
from vibroimpact.engine.observers.record import CONTACT_BEGINS, DETACHMENT, IMPACT
from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Oscillator, Record, Repeated, RigidStop, State, validate
from vibroimpact.response.engine_input import as_state

_Shaking = TypeVar("_Shaking", bound=Repeated | Record, covariant=True)

_Array = NDArray[np.float64]

SIDES = (1, -1)

_COMPONENTS = ("displacement", "velocity", "right_bumper", "left_bumper", "isolator_memory")
MEMORY = 4


class Recorded(NamedTuple, Generic[_Shaking]):
    """Origin of the motion of a dataset."""

    oscillator: Oscillator
    excitation: _Shaking
    """Its phase is that at the beginning of the record."""
    cycles: float
    """Length of the record; NaN of a motion through a `Record`, which has none."""
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


def touches(contact: NDArray[np.int64], side: int | NDArray[np.int64]) -> NDArray[np.bool_]:
    """Whether the stop of a side, or of each phase's own side, is touched."""
    touched: NDArray[np.bool_] = (contact == side) | (contact == 2)
    return touched


class Phases(NamedTuple):
    """Phases of a motion, in the order of time: one value each, or one row of a state each."""

    contact: NDArray[np.int64]
    """Stop touched: -1 left, 0 none, 1 right, 2 both."""
    struck: NDArray[np.int64]
    """Side of the impact on a rigid stop with which the phase begins, or 0."""
    event: NDArray[np.int64]
    """Number of the event with which it begins, or -1."""
    begin: _Array
    """s, from the beginning of the record."""
    angle: _Array
    """The forcing's phase at the beginning, rad; not reduced over the cycles of one record. NaN
    through a `Record`."""
    clock: _Array
    """The two numbers of the forcing's clock at the beginning, shape (phase, 2)."""
    length: _Array
    """s."""
    first: _Array
    """State at the beginning: u, u̇, u_R, u_L, z, shape (phase, 5)."""
    last: _Array
    """State at the end, shape (phase, 5); an impact there is still to come."""
    fresh: NDArray[np.int64]
    """What has happened at its beginning, as the engine says it (`motion.Motion`)."""
    met: _Array
    """Speeds at which the right and left stop that is touched was met, shape (phase, 2)."""

    def take(self, chosen: NDArray[np.int64]) -> Phases:
        """The chosen phases."""
        parts = {name: values[chosen] for name, values in self._asdict().items()}
        return Phases(**parts)


def any_recorded(motion: xr.Dataset) -> Recorded[Repeated | Record]:
    """Whose motion a dataset holds.

    Raises
    ------
    InputError
        If it is not the dataset of a motion with samples and events.
    """
    held = isinstance(motion, xr.Dataset) and {"event_time", "velocity"} <= set(motion.variables)
    if not held or motion.sizes["time"] < ("cycle" not in motion) + 1:
        raise InputError(
            "motion: this is not a recorded motion; pass the result of steady, or the result of "
            "simulate with samples greater than 0"
        )
    parameters = json.loads(motion.attrs["parameters"])
    if "assembly" in parameters:
        raise InputError(
            "motion: the motion of an Assembly of several masses is not accepted by this function; "
            "pass that of an Oscillator"
        )
    oscillator = validate(Oscillator, parameters["oscillator"], "motion.oscillator")
    assert isinstance(oscillator, Oscillator)
    if "record" in parameters:
        given = parameters["record"]
        known = motion["base_acceleration"].values[_lines(motion, given["step"])]
        return Recorded(
            oscillator, Record(known[: given["samples"]], given["step"]), math.nan, False
        )
    return Recorded(
        oscillator,
        excitation_from(parameters),
        float(motion["cycle"].values[-1]),
        "period" in motion and int(motion["period"]) > 0,
    )


def recorded(motion: xr.Dataset) -> Recorded[Repeated]:
    """Whose motion under a repeated forcing a dataset holds.

    Raises
    ------
    InputError
        If it is not the dataset of such a motion with samples and events.
    """
    origin = any_recorded(motion)
    shaken = origin.excitation
    if isinstance(shaken, Record):
        raise InputError(
            "motion: this is the response to a Record, which has no cycles; pass a motion under a "
            "Harmonic or a Periodic, or use contacts, totals, record_history, phase_portrait or "
            "hysteresis_cycle"
        )
    return Recorded(origin.oscillator, shaken, origin.cycles, origin.periodic)


def _lines(motion: xr.Dataset, step: float) -> NDArray[np.int64]:
    """The samples at which a straight line of the record begins, and the last one."""
    time = motion["time"].values
    each = max(1, round(step / time[1]))
    return np.unique(np.append(np.arange(0, len(time), each), len(time) - 1))


def beginning(motion: xr.Dataset) -> State:
    """The state at the beginning of a record, with the forcing's phase."""
    return as_state(motion["initial_state"])


def phases(motion: xr.Dataset) -> Phases:
    """Cut a recorded motion at its contacts and detachments.

    Raises
    ------
    InputError
        If it is not the dataset of a motion with samples and events.
    """
    return cut(motion, any_recorded(motion))


def cut(motion: xr.Dataset, origin: Recorded[Repeated | Record]) -> Phases:
    """As `phases`, of a motion whose origin is known."""
    shaken = origin.excitation
    # A motion that was given up has events behind its last sample.
    if isinstance(shaken, Record):
        kept = motion["event_time"].values <= motion["time"].values[-1]
    else:
        at = motion["event_cycle"].values + motion["event_cycle_time"].values / shaken.period
        kept = at <= origin.cycles * (1.0 + 1e-12)
    motion = motion.isel(event=kept)
    at_events = _states(motion, "event_")
    kinds, sides = motion["event_contact"].values, motion["event_side"].values
    struck = np.where(kinds == IMPACT, sides, 0)
    behind = at_events.copy()
    stops = origin.oscillator.right, origin.oscillator.left
    for side, stop in zip(SIDES, stops, strict=True):
        if isinstance(stop, RigidStop):
            behind[struck == side, 1] *= -stop.restitution
            behind[(kinds == CONTACT_BEGINS) & (sides == side), 1] = 0.0
    right, left = (_touched(side, kinds, sides, int(motion["contact"].values[0])) for side in SIDES)
    contact = np.where(right & left, 2, right.astype(np.int64) - left)
    begun = np.append(0, np.where(kinds == CONTACT_BEGINS, sides, 0))
    met = np.column_stack(
        [_met(motion, origin.oscillator, side, begun, at_events[:, 1]) for side in SIDES]
    )
    walls = [side for side, stop in zip(SIDES, stops, strict=True) if isinstance(stop, RigidStop)]
    # What rests for no time at all is pulled off, not let go of where the force has fallen to zero.
    rested = np.diff(motion["event_time"].values, prepend=motion["time"].values[0]) > 0.0
    released = (kinds == DETACHMENT) & np.isin(sides, walls) & rested
    fresh = np.where(sides == 1, RIGHT, LEFT) | np.where(released, RELEASED, 0)
    events = _Events(
        at_events,
        behind,
        np.append(0, struck).astype(np.int64),
        contact,
        np.append(0, fresh).astype(np.int64),
        met,
    )
    if isinstance(shaken, Record):
        return _along_lines(motion, shaken, events)
    found = _along_cycles(motion, shaken, origin.cycles, events)
    if origin.oscillator.isolator.linear:
        return found
    return _flights_by_cycles(found, motion, shaken)


class _Events(NamedTuple):
    """Contacts, detachments and impacts, a row each."""

    before: _Array
    behind: _Array
    struck: NDArray[np.int64]
    """Of what begins with each of them, and first of what begins with none."""
    contact: NDArray[np.int64]
    """The same."""
    fresh: NDArray[np.int64]
    """The same."""
    met: _Array
    """The same."""


def _states(motion: xr.Dataset, of: str) -> _Array:
    """The states at the samples, or at the events, a row each."""
    still = np.zeros(motion.sizes["event" if of else "time"])
    return np.stack(
        [motion[of + name].values if of + name in motion else still for name in _COMPONENTS],
        axis=-1,
    )


def _met(
    motion: xr.Dataset,
    oscillator: Oscillator,
    side: int,
    begun: NDArray[np.int64],
    velocity: _Array,
) -> _Array:
    """The speed at which a stop without memory was met last, before the first event and behind."""
    stop, name = (
        (oscillator.right, "right_bumper") if side == 1 else (oscillator.left, "left_bumper")
    )
    if stop is None or isinstance(stop, Bumper | RigidStop):
        return np.zeros(len(begun))
    speeds = np.append(abs(float(motion["initial_state"].sel(component=name))), np.abs(velocity))
    known = (begun == side) | (np.arange(len(begun)) == 0)
    last = np.maximum.accumulate(np.where(known, np.arange(len(begun)), 0))
    return np.asarray(speeds[last])


def _along_cycles(motion: xr.Dataset, shaken: Repeated, cycles: float, events: _Events) -> Phases:
    """The phases from event to event."""
    period = shaken.period
    ends = list(_states(motion, "")[[0, -1]])
    if len(events.before) and not motion["event_cycle"][0] and not motion["event_cycle_time"][0]:
        ends[0] = events.before[0]  # the first sample lies behind an event at once
    # Differences within cycles keep digits that absolute times lose.
    cycle = np.concatenate([[0], motion["event_cycle"].values, [np.floor(cycles)]])
    within = np.concatenate([[0.0], motion["event_cycle_time"].values, [(cycles % 1.0) * period]])
    angle = shaken.phase + 2.0 * np.pi * within[:-1] / period
    return Phases(
        events.contact,
        events.struck,
        np.arange(len(angle)) - 1,
        cycle[:-1] * period + within[:-1],
        angle,
        np.column_stack([np.sin(angle), np.cos(angle)]),
        np.maximum(np.diff(cycle) * period + np.diff(within), 0.0),
        np.vstack([ends[0], events.behind]),
        np.vstack([events.before, ends[1]]),
        events.fresh,
        events.met,
    )


def _flights_by_cycles(found: Phases, motion: xr.Dataset, shaken: Repeated) -> Phases:
    """The same, long flights cut at whole cycles, where the motion was recorded.

    A flight that is not in closed form is followed again to be measured, and a chaotic one would
    go another way.
    """
    cycle = motion["cycle"].values
    whole = np.flatnonzero(cycle == np.floor(cycle))
    period = shaken.period
    end = found.begin + found.length
    first = np.floor(found.begin / period).astype(np.int64)
    count = np.ceil(end / period - 1e-9).astype(np.int64) - first
    count = np.where((found.contact == 0) & (found.length > period), count, 1)
    if count.max() == 1:
        return found
    owner = np.repeat(np.arange(len(count)), count)
    part = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    parts = found.take(owner)
    later = part > 0
    states = _states(motion, "")[whole]
    at = (first[owner] + part)[later]
    parts.first[later], parts.last[:-1][later[1:]] = states[at], states[at]
    parts.begin[later] = at * period
    parts.angle[later] = shaken.phase
    parts.clock[later] = [np.sin(shaken.phase), np.cos(shaken.phase)]
    parts.struck[later], parts.event[later], parts.fresh[later] = 0, -1, 0
    ends = np.where(np.append(later[1:], False), np.append(parts.begin[1:], 0.0), end[owner])
    # A piece of several; a flight that is whole keeps the digits of its length.
    parts.length[:] = np.where(count[owner] > 1, ends - parts.begin, parts.length)
    return parts


def _along_lines(motion: xr.Dataset, record: Record, events: _Events) -> Phases:
    """The phases from event to event, and cut where a straight line of the record ends."""
    nodes = _lines(motion, record.step)
    time = motion["time"].values[nodes]
    pull = motion["base_acceleration"].values[nodes]
    slope = np.append(np.diff(pull) / np.diff(time), 0.0)
    # The base stands still behind the record, at whose end it may stop at once.
    pull, slope = (
        np.where(np.arange(len(time)) < len(record.time) - 1, x, 0.0) for x in (pull, slope)
    )
    states = _states(motion, "")[nodes]
    count = len(events.before)
    moments = np.concatenate([time[:-1], motion["event_time"].values, time[-1:]])
    order = np.argsort(moments, kind="stable")
    event = np.concatenate([np.full(len(time) - 1, -1), np.arange(count), [-1]])[order]
    behind = np.vstack([states[:-1], events.behind, states[-1:]])[order]
    before = np.vstack([states[:-1], events.before, states[-1:]])[order]
    begin = moments[order]
    line = np.clip(np.cumsum(event < 0) - 1, 0, len(time) - 1)
    passed = np.cumsum(event >= 0)
    clock = np.column_stack([pull[line] + slope[line] * (begin - time[line]), slope[line]])
    return Phases(
        events.contact[passed][:-1],
        np.where(event >= 0, events.struck[passed], 0)[:-1],
        event[:-1],
        begin[:-1],
        np.full(len(begin) - 1, np.nan),
        clock[:-1],
        np.diff(begin),
        behind[:-1],
        before[1:],
        np.where(event >= 0, events.fresh[passed], 0)[:-1],
        events.met[passed][:-1],
    )


def _touched(
    side: int, kinds: NDArray[np.int64], sides: NDArray[np.int64], sampled: int
) -> NDArray[np.bool_]:
    """Whether a side is touched before the first event and after each.

    Its first contact or detachment shows the earlier state; the first sample may lie after it.
    """
    change = np.where(sides == side, (kinds == CONTACT_BEGINS) * 1 - (kinds == DETACHMENT), 0)
    events = change[change != 0]
    first = events[0] < 0 if len(events) else sampled in (side, 2)
    return np.append(0, np.cumsum(change)) + first > 0


def relaxation_loss(origin: Recorded[Any], parts: Phases) -> _Array:
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


def chattered(parts: Phases) -> NDArray[np.bool_]:
    """Which phases are the rest of a chatter: from an impact to rest on the same wall.

    The engine completes it at once, so that the phase is not a flight.
    """
    rests = (parts.struck[1:] == 0) & touches(parts.contact[1:], parts.struck[:-1])
    ends = rests & (parts.struck[:-1] != 0) & (parts.last[:-1, 1] == 0.0)
    return np.append(ends, False)


def impact_loss(origin: Recorded[Any], parts: Phases) -> _Array:
    """Energy (J) lost in the impact, or the rest of a chatter, with which each phase begins."""
    arrival = np.where(chattered(parts), parts.first[:, 1], parts.last[:, 1])
    arrival = np.append(parts.first[0, 1], arrival[:-1])
    return 0.5 * origin.oscillator.mass * (arrival**2 - parts.first[:, 1] ** 2)
