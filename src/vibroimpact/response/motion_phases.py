"""The phases of a recorded motion: flights and contacts, measured while the engine follows it.

It is followed once more from its initial state, with an observer. Where the engine is the same, so
is the motion, to the last bit.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import excitation_from
from vibroimpact.engine import sections
from vibroimpact.engine.observers import fourier
from vibroimpact.engine.observers import phases as layout
from vibroimpact.engine.observers.phases import ONE_MASS, Layout
from vibroimpact.engine.observers.record import CONTACT_BEGINS, DETACHMENT, IMPACT
from vibroimpact.engine.phases import measure_motion
from vibroimpact.engine.state import FIRST
from vibroimpact.engine.status import Status
from vibroimpact.engine.stops.rebound import restitutions
from vibroimpact.errors import InputError, warn_of_result
from vibroimpact.model import Assembly, Oscillator, Record, Repeated, validate
from vibroimpact.model.argument_types import MOST_EVENTS
from vibroimpact.model.rig import one_mass_only
from vibroimpact.model.system import System
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.record_history import straight
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]

_NONE = np.empty(0)

INSTANT = 1e-300
"""Cycles of a motion of a single sample."""
_DEPARTED = 1e-6
"""Share of the largest displacement by which the end of a motion may differ from its record."""
_ON_GRID = 1e-6
"""Share of a record's step by which a sample may lie off its grid."""


class Origin(NamedTuple):
    """Origin of the motion of a dataset."""

    system: System
    shaking: Repeated | Record
    """Its phase is that at the beginning of the motion."""
    cycles: float
    """Length of the motion; NaN through a `Record`, which has no cycles."""
    periodic: bool
    """Whether the motion is one period of a periodic one: its end is its beginning."""

    @property
    def oscillator(self) -> Oscillator:
        """The system, of a motion of one mass."""
        return one_mass_only(self.system, "motion")

    @property
    def repeated(self) -> Repeated:
        """The shaking, which must not be a record."""
        if isinstance(self.shaking, Record):
            raise InputError(
                "motion: this is the response to a Record, which has no cycles; pass a motion "
                "under a Harmonic or a Periodic, or use contacts, totals, record_history, "
                "phase_portrait or hysteresis_cycle"
            )
        return self.shaking


class PartColumns:
    """Rows of phases, or of whole motions, by what vibrates."""

    rows: _Array
    layout: Layout

    def of_mass(self, column: int) -> _Array:
        """Return a column of each mass, shape (row, mass)."""
        of = self.layout
        return self.rows[:, of.mass(column) : of.mass(0, of.masses) : layout.MASS]

    def of_stop(self, column: int) -> _Array:
        """Return a column of each stop, shape (row, stop)."""
        of = self.layout
        return self.rows[:, of.stop(column, 0) : of.stop(0, of.stops) : layout.STOP]

    def of_drift(self, column: int) -> _Array:
        """Return a column of each drift, shape (row, drift)."""
        of = self.layout
        return self.rows[:, of.drift(column, 0) : of.drift(0, of.drifts) : layout.DRIFT]


class Phases(PartColumns):
    """Phases of a motion, in the order of time.

    `begin` and `final` are the engine's states at the ends of the motion. `notes` doubt that it is
    the recorded one.
    """

    def __init__(
        self,
        system: System,
        followed: PhaseRecord,
        begin: _Array,
        final: _Array,
        notes: Sequence[str] = (),
    ) -> None:
        self.system = system
        self.status, self.rows, self.bounds, self.angle = followed
        self.begin, self.final, self.notes = begin, final, list(notes)
        states = engine_system(system)
        self.rows = states.phase_rows(self.rows)
        self.layout, self.closing = states.layout, states.closing
        self.stops = system.counted_stops

    @property
    def pressed(self) -> NDArray[np.bool_]:
        """Which stops are touched, shape (phase, stop)."""
        bits = self.rows[:, layout.TOUCHED].astype(np.int64)[:, np.newaxis]
        touched: NDArray[np.bool_] = bits >> np.arange(self.layout.stops) & 1 > 0
        if not self.system.by_mass:
            return touched
        # At a single instant a stop is touched if it pushes.
        lasts = self.rows[:, layout.LENGTH] > 0.0
        is_pressed: NDArray[np.bool_] = touched & (
            lasts[:, np.newaxis] | (self.of_stop(layout.FORCE) != 0.0)
        )
        return is_pressed

    @property
    def impacts(self) -> NDArray[np.int64]:
        """Phases that end in an impact on a rigid stop."""
        return np.flatnonzero(self.rows[:, layout.KIND] == IMPACT)


def recorded(motion: xr.Dataset, *, masses: bool = False, records: bool = False) -> Origin:
    """Return whose motion a dataset holds.

    Parameters
    ----------
    masses, records
        Whether the motion of several masses, and a motion through a `Record`, are accepted.

    Raises
    ------
    InputError
        If it is not the dataset of such a motion with samples and events.
    """
    held = isinstance(motion, xr.Dataset) and {"event_time", "velocity"} <= set(motion.variables)
    if not held or motion.sizes["time"] < ("cycle" not in motion) + 1:
        raise InputError(
            "motion: this is not a recorded motion; pass the result of steady, or the result of "
            "simulate with samples greater than 0"
        )
    parameters = json.loads(motion.attrs["parameters"])
    kind: type[System] = Assembly if "assembly" in parameters else Oscillator
    if kind.by_mass and not masses:
        raise InputError(
            "motion: it is of an Assembly of several masses, which this function does not accept; "
            "draw it with figures.mass_histories, contact_forces or pair_portrait"
        )
    system = validate(kind, parameters[kind.table_name], f"motion.{kind.table_name}")
    if "record" in parameters:
        origin = Origin(system, shaken_by(motion, parameters["record"]), math.nan, False)
        if not records:
            _ = origin.repeated  # which says what is wrong
        return origin
    first, cycles = (float(motion["cycle"].values[end]) for end in (0, -1))
    # What was cut out of one period is no period.
    periodic = "period" in motion and first == 0.0 and cycles == int(motion["period"])
    return Origin(system, excitation_from(parameters), cycles, periodic)


def shaken_by(motion: xr.Dataset, parameters: dict[str, Any]) -> Record:
    """Return the record as far as the motion shows it: its last line may go on behind the motion.

    Raises
    ------
    InputError
        If samples are missing from which the record is known.
    """
    time, values = motion["time"].values, motion["base_acceleration"].values
    step = float(parameters["step"])
    each = max(1, round(step / time[1])) if time[1] > 0.0 else 1
    if abs(time[0]) > _ON_GRID * step or (
        len(time) > each and abs(time[each] - step) > _ON_GRID * step
    ):
        raise InputError(
            f"motion: its samples from {time[0]:g} s on do not contain the whole record of its "
            "base; pass the result of simulate, which may be cut at its end only"
        )
    known = values[::each]
    if (len(time) - 1) % each and len(known) < parameters["samples"]:
        rest = time[-1] - time[(len(known) - 1) * each]
        known = np.append(known, known[-1] + (values[-1] - known[-1]) * (step / rest))
    return Record(known[: parameters["samples"]], step)


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

    def again(self, motion: xr.Dataset) -> PhaseRecord:
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
        return PhaseRecord(outcome, rows, bounds, course.phase + turns * since)


class PhaseRecord(NamedTuple):
    """The phases of a motion that was followed again."""

    status: Status
    rows: _Array
    bounds: _Array
    """When they begin, and when the last one ends (s), shape (phase + 1,)."""
    angle: _Array
    """The forcing's phase there (rad), counted in each cycle anew; NaN through a `Record`."""


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


def _course(motion: xr.Dataset, origin: Origin) -> Course:
    """Return how the engine follows the motion of a dataset, as `simulate` has done."""
    states, shaken = engine_system(origin.system), origin.shaking
    rig = states.numbers(shaken)
    state = states.motion_vector(states.read(motion["initial_state"]))
    of = states.layout
    if isinstance(shaken, Record):
        return record_course(motion, shaken, rig, state, of)
    return repeated_course(shaken, origin.cycles, rig, state, of)


def phases(motion: xr.Dataset, origin: Origin) -> Phases:
    """Follow a recorded motion, and measure its phases.

    Of a motion whose first samples were cut off, the phases begin with what is left of the first.
    """
    course = _course(motion, origin)
    begin = course.state.copy()
    followed = course.again(motion)
    held = motion["displacement"].transpose(..., "time").values[..., -1]
    at = slice(FIRST, FIRST + held.size) if held.ndim else FIRST
    apart = float(np.abs(course.state[at] - held).max())
    notes = doubts(motion, followed.status, apart)
    return Phases(origin.system, followed, begin, course.state, notes)


def fourier_integrals(motion: xr.Dataset, origin: Origin, rates: _Array) -> NDArray[np.complex128]:
    """Return the integrals of a periodic motion over its length times exp(−iνt).

    `rates` are ν in 1/s.

    Returns
    -------
    ndarray, shape (3, rate, mass)
        Of displacement, velocity and absolute acceleration, impulses left out.
    """
    parts = _course(motion, origin).integrated(rates).reshape(3, 2, -1, len(rates))
    integrals: NDArray[np.complex128] = parts[:, 0] + 1j * parts[:, 1]
    return integrals.swapaxes(1, 2)


def doubts(motion: xr.Dataset, outcome: Status, apart: float) -> list[str]:
    """Describe in words that the motion followed is not the recorded one, if so, and warn.

    It ends ``apart`` (m) from it.
    """
    size = float(np.abs(motion["displacement"].values).max())
    if outcome is Status.DONE and apart <= _DEPARTED * size:
        return []
    message = (
        f"followed again from its initial state, the motion ends {apart:.3g} m away from the "
        "recorded one, because it is sensitive to rounding and was computed by another version or "
        "on another processor: the result is that of the motion followed now"
    )
    warn_of_result(message)
    return [message]


def parting_velocity(motion: xr.Dataset, oscillator: Oscillator) -> _Array:
    """Return the velocity just after each event of a motion, which an impact changes."""
    kinds, stops = motion["event_contact"].values, motion["event_stop"].values
    velocity: _Array = motion["event_velocity"].values.copy()
    for name in motion["stop"].values:
        stop = getattr(oscillator, name)
        if stop.rigid:
            hit = (kinds == IMPACT) & (stops == name)
            velocity[hit] *= -restitutions(stop.engine_numbers(), abs(velocity[hit]))
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
        touched = bool(motion["initial_state"].sel(component=f"touching.{stop}"))
    begins = np.append(np.zeros(int(touched)), begins)
    ends = np.append(ends, np.full(len(begins) - len(ends), end))
    return np.column_stack([begins, ends])
