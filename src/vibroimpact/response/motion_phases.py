"""The phases of a recorded motion: flights and contacts, measured while the engine follows it.

It is followed once more from its initial state, with an observer. Where the engine is the same, so
is the motion, to the last bit.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import excitation_from
from vibroimpact.engine import sections
from vibroimpact.engine.motion import U
from vibroimpact.engine.observers import fourier
from vibroimpact.engine.observers import phases as layout
from vibroimpact.engine.observers.phases import ONE_MASS, Layout
from vibroimpact.engine.observers.record import CONTACT_BEGINS, DETACHMENT, IMPACT
from vibroimpact.engine.phases import measure_motion
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, warn_of_result
from vibroimpact.model import Oscillator, Record, Repeated, State, validate
from vibroimpact.model.argument_types import MOST_EVENTS
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import as_state, engine_rig, engine_state
from vibroimpact.response.record_history import straight
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import Progress

_Shaking = TypeVar("_Shaking", bound=Repeated | Record, covariant=True)

_Array = NDArray[np.float64]

_NONE = np.empty(0)

SIDES = (1, -1)
"""Of the stops, in the order of their numbers: right, left."""

INSTANT = 1e-300
"""Cycles of a motion of a single sample."""
_DEPARTED = 1e-6
"""Share of the largest displacement by which the end of a motion may differ from its record."""
_ON_GRID = 1e-6
"""Share of a record's step by which a sample may lie off its grid."""


class Recorded(NamedTuple, Generic[_Shaking]):
    """Origin of the motion of a dataset."""

    oscillator: Oscillator
    excitation: _Shaking
    """Its phase is that at the beginning of the motion."""
    cycles: float
    """Length of the motion; NaN through a `Record`, which has no cycles."""
    periodic: bool
    """Whether the motion is one period of a periodic one: its end is its beginning."""


class Phases(NamedTuple):
    """Phases of a motion, in the order of time."""

    rows: _Array
    """What the engine measured of them (`observers.phases`), per unit mass."""
    bounds: _Array
    """When they begin, and when the last one ends (s), shape (phase + 1,)."""
    angle: _Array
    """The forcing's phase there (rad), counted in each cycle anew; NaN through a `Record`."""
    notes: list[str]
    """Doubt about whether they are those of the recorded motion."""

    def of_mass(self, column: int) -> _Array:
        """Return a column of the mass."""
        return self.rows[:, ONE_MASS.mass(column)]

    def of_stop(self, column: int, number: int) -> _Array:
        """Return a column of a stop."""
        return self.rows[:, ONE_MASS.stop(column, number)]

    def touched(self, number: int) -> NDArray[np.bool_]:
        """Return whether a stop is touched."""
        touched: NDArray[np.bool_] = self.rows[:, layout.TOUCHED].astype(np.int64) >> number & 1 > 0
        return touched


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
            "motion: it is of an Assembly of several masses, which this function does not accept; "
            "draw it with figures.mass_histories, contact_forces or pair_portrait"
        )
    oscillator = validate(Oscillator, parameters["oscillator"], "motion.oscillator")
    assert isinstance(oscillator, Oscillator)
    if "record" in parameters:
        return Recorded(oscillator, shaken_by(motion, parameters["record"]), math.nan, False)
    first, cycles = (float(motion["cycle"].values[end]) for end in (0, -1))
    # What was cut out of one period is no period.
    periodic = "period" in motion and first == 0.0 and cycles == int(motion["period"])
    return Recorded(oscillator, excitation_from(parameters), cycles, periodic)


def recorded(motion: xr.Dataset) -> Recorded[Repeated]:
    """Whose motion under a repeated forcing a dataset holds.

    Raises
    ------
    InputError
        If it is not the dataset of such a motion with samples and events.
    """
    origin = any_recorded(motion)
    shaken = check_repeated(origin.excitation)
    return Recorded(origin.oscillator, shaken, origin.cycles, origin.periodic)


def check_repeated(shaking: Repeated | Record) -> Repeated:
    """Return what shakes a motion, if it is repeated.

    Raises
    ------
    InputError
        If it is a record.
    """
    if isinstance(shaking, Record):
        raise InputError(
            "motion: this is the response to a Record, which has no cycles; pass a motion under a "
            "Harmonic or a Periodic, or use contacts, totals, record_history, phase_portrait or "
            "hysteresis_cycle"
        )
    return shaking


def shaken_by(motion: xr.Dataset, given: dict[str, Any]) -> Record:
    """Return the record as far as the motion shows it: its last line may go on behind the motion.

    Raises
    ------
    InputError
        If samples are missing from which the record is known.
    """
    time, values = motion["time"].values, motion["base_acceleration"].values
    step = float(given["step"])
    each = max(1, round(step / time[1])) if time[1] > 0.0 else 1
    if abs(time[0]) > _ON_GRID * step or (
        len(time) > each and abs(time[each] - step) > _ON_GRID * step
    ):
        raise InputError(
            f"motion: its samples from {time[0]:g} s on do not contain the whole record of its "
            "base; pass the result of simulate, which may be cut at its end only"
        )
    known = values[::each]
    if (len(time) - 1) % each and len(known) < given["samples"]:
        rest = time[-1] - time[(len(known) - 1) * each]
        known = np.append(known, known[-1] + (values[-1] - known[-1]) * (step / rest))
    return Record(known[: given["samples"]], step)


def beginning(motion: xr.Dataset) -> State:
    """The state at the beginning of a motion, with the forcing's phase."""
    return as_state(motion["initial_state"])


class Course(NamedTuple):
    """A motion as the engine follows it (`engine.phases`)."""

    rig: _Array
    size: float
    omega: float
    phase: float
    sections: _Array
    changes: bool
    state: _Array
    last: float
    """Where it ends, in sections."""
    layout: Layout = ONE_MASS
    """Of the rows of its phases."""

    def follow(
        self, call: Callable[[int, float], tuple[int, int]], progress: Progress | None = None
    ) -> Status:
        """Follow it by calls of the engine, each from a section to another."""
        at, outcome = 0, int(Status.DONE)
        calls = Calls(self.last, progress)
        while at < self.last and outcome == Status.DONE:
            at, outcome = call(at, calls.end(at))
        return Status(outcome)

    def measured(
        self, max_events: int = MOST_EVENTS, progress: Progress | None = None
    ) -> tuple[Status, _Array]:
        """Return the rows of its phases; the state is carried on."""
        of = self.layout
        notes, rows = np.zeros(layout.NOTES), np.full((1024, of.width), np.nan)
        notes[layout.WIDTH], notes[layout.MASSES] = of.width, of.masses
        notes[layout.DRIFTS] = of.drifts

        def call(at: int, end: float) -> tuple[int, int]:
            nonlocal rows
            notes[layout.CAPACITY] = len(rows)
            next_one, outcome = measure_motion(
                *self[:5],
                int(self.changes),
                self.state,
                at,
                end,
                max_events,
                notes,
                _NONE,
                rows,
            )
            if next_one < end:
                rows = np.concatenate([rows, np.empty_like(rows)])
            return next_one, outcome

        outcome = self.follow(call, progress)
        count = int(notes[layout.WRITTEN])
        # Behind an event at the very end there is nothing.
        seen = np.isfinite(rows[count, of.mass(layout.U_LEAST)])
        return outcome, rows[: count + int(seen)]

    def integrated(self, lines: _Array) -> _Array:
        """Return its integrals times exp(−iνt), as `observers.fourier` writes them, ν in 1/s."""
        rows = fourier.QUANTITIES * self.layout.masses
        notes, out = np.zeros(fourier.NOTES), np.zeros((rows, len(lines)))
        notes[fourier.COUNT], notes[fourier.INTERVAL] = len(lines), self.sections[0, sections.LASTS]

        def call(at: int, end: float) -> tuple[int, int]:
            reached: tuple[int, int] = measure_motion(
                *self[:5], int(self.changes), self.state, at, end, MOST_EVENTS, notes, lines, out
            )
            return reached

        self.follow(call)
        return out

    def again(self, motion: xr.Dataset) -> Followed:
        """Follow the motion of a dataset again, which may have lost its first samples."""
        course, begins = self, float(motion["time"].values[0])
        if begins > 0.0:  # under a repeated forcing
            first = float(motion["cycle"].values[0])
            self._replace(last=first).measured()
            phase = self.phase + 2.0 * math.pi * (first % 1.0)
            course = self._replace(phase=phase, last=max(self.last - first, INSTANT))
        outcome, rows = course.measured()
        interval = float(self.sections[0, sections.LASTS])
        turns = math.nan if self.changes else 2.0 * math.pi / interval
        since = np.append(0.0, rows[:, layout.SINCE])
        bounds = begins + np.append(0.0, rows[:, layout.SECTION]) * interval + since
        if len(rows) and rows[-1, layout.KIND] == layout.NOTHING:
            bounds[-1] = bounds[-2] + rows[-1, layout.LENGTH]
            since[-1] = since[-2] + rows[-1, layout.LENGTH]
        return Followed(outcome, rows, bounds, course.phase + turns * since)


class Followed(NamedTuple):
    """The phases of a motion that was followed again."""

    status: Status
    rows: _Array
    bounds: _Array
    """As of `Phases`."""
    angle: _Array


def record_course(
    motion: xr.Dataset, record: Record, rig: _Array, state: _Array, of: Layout = ONE_MASS
) -> Course:
    """Return how the engine follows a dataset's motion through a record, which may be cut."""
    tail = float(json.loads(motion.attrs["parameters"])["tail"])
    lines = straight(record, tail)
    peak, steepest = record.peak, float(np.abs(lines[:, sections.C]).max())
    ends = float(motion["time"].values[-1])
    last = float(len(lines))
    if ends < record.duration + tail:
        whole = min(int(ends / record.step + 1e-9), len(lines) - 1)
        rest = (ends - whole * record.step) / lines[whole, sections.LASTS]
        last = whole + (rest if rest > 1e-9 else 0.0)
    turns = steepest / peak if peak > 0.0 else 0.0
    return Course(rig, peak, turns, 0.0, lines, True, state, last, of)


def repeated_course(
    shaken: Repeated, cycles: float, rig: _Array, state: _Array, of: Layout = ONE_MASS
) -> Course:
    """Return how the engine follows a motion under a repeated forcing."""
    row = np.array([[math.nan, math.nan, shaken.period]])
    turns = 2.0 * math.pi * shaken.frequency
    cycles = max(cycles, INSTANT)
    return Course(rig, shaken.amplitude, turns, shaken.phase, row, False, state, cycles, of)


def _course(motion: xr.Dataset, origin: Recorded[Any]) -> Course:
    """How the engine follows the motion of a dataset, as `simulate` has done."""
    oscillator, shaken = origin.oscillator, origin.excitation
    rig = engine_rig(Rig(oscillator, shaken))
    state = engine_state(oscillator, beginning(motion))
    if isinstance(shaken, Record):
        return record_course(motion, shaken, rig, state)
    return repeated_course(shaken, origin.cycles, rig, state)


def phases(motion: xr.Dataset, origin: Recorded[Any]) -> Phases:
    """Follow a recorded motion, and measure its phases.

    Of a motion whose first samples were cut off, the phases begin with what is left of the first.
    """
    course = _course(motion, origin)
    status, rows, bounds, angle = course.again(motion)
    apart = abs(course.state[U] - float(motion["displacement"].values[-1]))
    return Phases(rows, bounds, angle, doubts(motion, status, apart))


def fourier_integrals(motion: xr.Dataset, origin: Recorded[Repeated], lines: _Array) -> _Array:
    """Return the integrals of a motion times exp(−iνt), as `observers.fourier` writes them."""
    return _course(motion, origin).integrated(lines)


def doubts(motion: xr.Dataset, outcome: Status, apart: float) -> list[str]:
    """Describe in words that the motion followed is not the recorded one, if so, and warn.

    It ends ``apart`` (m) from it.
    """
    size = float(np.abs(motion["displacement"].values).max())
    if outcome is Status.DONE and apart <= _DEPARTED * size:
        return []
    told = (
        f"followed again from its initial state, the motion ends {apart:.3g} m away from the "
        "recorded one, because it is sensitive to rounding and was computed by another version or "
        "on another processor: the result is that of the motion followed now"
    )
    warn_of_result(told)
    return [told]


def parting_velocity(motion: xr.Dataset, oscillator: Oscillator) -> _Array:
    """Return the velocity just after each event of a motion, which an impact changes."""
    kinds, stops = motion["event_contact"].values, motion["event_stop"].values
    velocity: _Array = motion["event_velocity"].values.copy()
    for name in motion["stop"].values:
        stop = getattr(oscillator, name)
        if stop.rigid:
            restitution, _ = stop.engine_numbers()
            velocity[(kinds == IMPACT) & (stops == name)] *= -restitution
            velocity[(kinds == CONTACT_BEGINS) & (stops == name)] = 0.0
    return velocity


def contact_intervals(motion: xr.Dataset, stop: str, at: _Array, end: float) -> _Array:
    """Return when a stop is touched, shape (contact, 2).

    Parameters
    ----------
    at
        When each event is.
    end
        When the motion ends; the first contact may last since 0, and the last one until then.
    """
    kinds = motion["event_contact"].values
    mine = (motion["event_stop"].values == stop) & (kinds != IMPACT) & (at <= end)
    begins, ends = at[mine & (kinds == CONTACT_BEGINS)], at[mine & (kinds == DETACHMENT)]
    # The first event shows the earlier state; the first sample may lie after it.
    if mine.any():
        touched = kinds[mine][0] == DETACHMENT
    else:
        touched = bool(motion["touching"].sel(stop=stop).values[0])
    begins = np.append(np.zeros(int(touched)), begins)
    ends = np.append(ends, np.full(len(begins) - len(ends), end))
    return np.column_stack([begins, ends])
