"""The motion of an assembly, as `simulate` returns it.

The flow of several masses goes from section to section: a forcing cycle, or a line of a record.
Samples come from a second run through the same section, from the same state, so that they do not
change the motion. Neither run uses tables, so that both are the same wherever they begin.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, excitation_parameters
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.engine.assembly import layout
from vibroimpact.engine.assembly.entries import follow_sections
from vibroimpact.engine.assembly.plan import plan_of
from vibroimpact.engine.status import Status
from vibroimpact.errors import warn_of_result
from vibroimpact.model import Assembly, Periodic, Record, Repeated, equilibrium
from vibroimpact.model.argument_types import check_samples
from vibroimpact.model.assembly import numbers
from vibroimpact.model.rig import Rig
from vibroimpact.response.assembly_pieces import forcing_size, why_given_up
from vibroimpact.response.assembly_rig import assembly_numbers, check_laws, link_parts
from vibroimpact.response.assembly_state import (
    as_assembly_state,
    assembly_vector,
    component_names,
    state_components,
)
from vibroimpact.response.record_dataset import record_parameters
from vibroimpact.response.record_history import base_acceleration, straight
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]

_WORK_LIMIT = 1e7
"""Steps that one section may take."""
_START, _END, _CONTACT, _IMPACT = 1, 0, layout.CONTACT, layout.IMPACT
_HIT = 2
"""Kinds of events in a dataset, `event_contact`, and in the engine's log."""
_SAME = 1e-15
"""Share of a section within which a stretch ends where the log has its event."""
_AT_REST = 1e-12
"""A closing speed below this share of the largest speed is none: rest begins without an impact."""


class Sections(NamedTuple):
    """The sections of a motion: when each begins, and the forcing there."""

    lines: _Array
    """Clock s, c and length (s) of each; see `follow_sections`."""
    interval: float
    """Length of a whole one (s): a forcing period, or the step of a record."""
    turn: float
    """Phase at which each forcing cycle begins (rad); NaN for a record."""

    def parts(self, k: int, samples: int) -> _Array:
        """Return a section cut at its samples."""
        s, c, length = self.lines[k]
        count = max(math.ceil(length / self.interval * samples - 1e-6), 1)
        share = np.arange(count + 1) / samples
        times = share * self.interval
        times[-1] = length
        if math.isnan(self.turn):
            return np.column_stack([s + c * times[:-1], np.full(count, c), np.diff(times)])
        angle = self.turn + 2.0 * math.pi * share[:-1]
        return np.column_stack([np.sin(angle), np.cos(angle), np.diff(times)])

    def following(self, samples: int) -> _Array:
        """Return a section of the length of a sample that begins where the last one ends."""
        s, c, length = self.lines[-1]
        last = self.interval / samples
        if math.isnan(self.turn):
            return np.array([[s + c * length, c, last]])
        angle = self.turn + 2.0 * math.pi * length / self.interval
        return np.array([[math.sin(angle), math.cos(angle), last]])


def sections_of(shaking: Repeated | Record, length: float, phase: float) -> Sections:
    """Return the sections of a motion of so many forcing cycles, or of a record with its tail."""
    if isinstance(shaking, Record):
        return Sections(straight(shaking, length), shaking.step, math.nan)
    whole, rest = math.floor(length), length % 1.0
    lasts = [shaking.period] * whole + ([rest * shaking.period] if rest > 0.0 else [])
    clock = [math.sin(phase), math.cos(phase)]
    lines = np.column_stack([np.tile(clock, (len(lasts), 1)), lasts])
    return Sections(lines, shaking.period, phase)


class _Seen(NamedTuple):
    """What the channels show at one instant: a row for each, a number for each mass or stop."""

    displacement: _Array
    velocity: _Array
    acceleration: _Array
    clearance: _Array
    contact_force: _Array
    deformation: _Array

    @classmethod
    def of(cls, rows: _Array, n: int, stops: int) -> _Seen:
        u, v, _, absolute = (rows[:, 2 + i * n : 2 + (i + 1) * n] for i in range(4))
        parts = rows[:, 2 + 4 * n :]
        count = parts.shape[1] // 3  # behind the stops stand the curved parts of links
        return cls(u, v, absolute, *(parts[:, i * count :][:, :stops] for i in range(3)))


class _Event(NamedTuple):
    section: int
    time: float
    """Since the section began (s)."""
    stop: int
    kind: int
    displacement: _Array
    velocity: _Array


def _fastest(assembly: Assembly, shaking: Repeated | Record) -> float:
    """A bound on the rates with all bumpers pressed (1/s), in the norm max(ρ |u|, |v|)."""
    of = numbers(assembly)
    k, c = of.stiffness.copy(), of.damping.copy()
    for stop in assembly.stops.values():
        if (pair := stop.stop.spring_and_dashpot) is not None:
            w = assembly.closing(stop)
            k += pair[0] * np.outer(w, w)
            c += pair[1] * np.outer(w, w)
    stiff, damped = (np.abs(np.linalg.solve(of.mass, one)).sum(1) for one in (k, c))
    most = float((0.5 * (damped + np.sqrt(damped * damped + 4.0 * stiff))).max())
    if isinstance(shaking, Record):
        return most
    harmonics = len(shaking.amplitudes) if isinstance(shaking, Periodic) else 1
    return max(most, harmonics * shaking.angular_frequency)


def too_much_work(assembly: Assembly, shaking: Repeated | Record, interval: float) -> bool:
    """Return whether a section of such a length (s) may take too many steps."""
    return not _fastest(assembly, shaking) * interval < layout.STEP * _WORK_LIMIT


class _Run:
    """A motion that is followed, and what was written down of it."""

    def __init__(
        self,
        rig: Rig,
        shaking: Repeated | Record,
        sections: Sections,
        vector: _Array,
        samples: int,
        max_events: int,
    ) -> None:
        system = rig.system
        assert isinstance(system, Assembly)
        self.n, self.stops = len(system.names), len(system.stops)
        self.parts = self.stops + len(link_parts(system))
        self.sections, self.state, self.samples = sections, vector, samples
        self.closing = [system.closing(stop) for stop in system.stops.values()]
        self.forcing = forcing_size(shaking)
        self.plan = plan_of(assembly_numbers(system, shaking))
        self.sampling = self.plan.copy()
        self.max_events = max_events
        self.log = np.empty((max_events + 1, 4))
        self.rows = np.empty((256, 2 + 4 * self.n + 3 * self.parts))
        self.seen: list[_Array] = []
        self.events: list[_Event] = []
        self.status = Status.DONE
        self.ordered_in: int | None = None
        if too_much_work(system, shaking, sections.interval):
            self.status = Status.TOO_MUCH_WORK

    def follow(self, progress: Progress | None) -> int:
        """Follow the motion; returns the number of sections that were finished."""
        total, done = len(self.sections.lines), 0
        calls = Calls(total, progress)
        while done < total and self.status is Status.DONE:
            end = int(calls.end(done))
            ways = [(done, end)] if not self.samples else [(k, k + 1) for k in range(done, end)]
            for first, last in ways:
                done = self._over(first, last)
                if self.status is not Status.DONE:
                    break
        if self.samples and total and self.status is Status.DONE:
            # What is at the very end is the beginning of what would follow.
            following = self.sections.following(self.samples)
            self.seen.append(self._sampled(following, self.state))
        return done

    def _over(self, first: int, last: int) -> int:
        lines = self.sections.lines[first:last]
        before = self.state.copy()
        ordered = self.plan[layout.ORDERED]
        count, rows = self._logged(lines)
        if count < 0:
            first += -1 - count
            # Of the section that was given up, alone.
            before, lines = self.state.copy(), self.sections.lines[first : first + 1]
            count, rows = self._logged(lines)
            self.status = why_given_up(self.plan)
            count, last = int((self.log[:, 0] >= 0.0).sum()), first
        if self.ordered_in is None and self.plan[layout.ORDERED] > ordered:
            self.ordered_in = first
        if self.samples:
            self.events += self._named(first, self.log[:count], rows, before)
            if self.status is Status.DONE:
                self.seen.append(self._sampled(self.sections.parts(first, self.samples), before))
        return last

    def _logged(self, lines: _Array) -> tuple[int, _Array]:
        """Go over sections; the number of events, and all channels where a stretch ends."""
        self.log[:, 0] = -1.0
        start = self.state.copy()
        ordered, undecided = self.plan[layout.ORDERED], self.plan[layout.UNDECIDED]
        while True:
            self.rows[:, 0] = -1.0
            count = follow_sections(
                self.plan,
                *self.forcing,
                self.state,
                lines,
                max_events=self.max_events,
                log=self.log,
                samples=self.rows if self.samples else None,
                tau=1.0,
            )
            if not self.samples or self.rows[-1, 0] < 0.0:
                return count, self.rows[self.rows[:, 0] >= 0.0].copy()
            self._more_rows()
            self.state[:] = start
            self.plan[layout.ORDERED], self.plan[layout.UNDECIDED] = ordered, undecided
            self.log[:, 0] = -1.0

    def _rows_at_begin(self, lines: _Array, start: _Array) -> _Array:
        """Go over sections; all channels where a stretch begins."""
        while True:
            self.rows[:, 0] = -1.0
            follow_sections(
                self.sampling,
                *self.forcing,
                start.copy(),
                lines,
                max_events=self.max_events,
                samples=self.rows,
                tau=0.0,
            )
            if self.rows[-1, 0] < 0.0:
                return self.rows[self.rows[:, 0] >= 0.0].copy()
            self._more_rows()

    def _sampled(self, parts: _Array, start: _Array) -> _Array:
        """Return all channels where each part begins, just after what happens there."""
        rows = self._rows_at_begin(parts, start)
        rows = rows[rows[:, 1] == 0.0]
        # A stretch without length, which ends in an event at once, has no series: take the last.
        found: _Array = rows[np.searchsorted(rows[:, 0], np.arange(len(parts)), side="right") - 1]
        return found

    def _more_rows(self) -> None:
        self.rows = np.empty((2 * len(self.rows), self.rows.shape[1]))

    def _named(self, section: int, log: _Array, rows: _Array, before: _Array) -> Iterator[_Event]:
        """Yield the events of a section, with the states just before them.

        The engine's log does not say which impact is the last one before a rest, and which rest is
        ended by the impact of another stop. The force in the stretch after it does.
        """
        seen = _Seen.of(rows, self.n, self.stops)
        rigid = self.plan[int(self.plan[layout.STOP]) :][layout.KIND :: layout.STOP_WIDTH]
        rigid = rigid[: self.stops] == layout.RIGID
        mode = int(before[layout.STATE_MODE])
        resting = {f for f in range(self.stops) if rigid[f] and mode >> f & 1}
        slack = _SAME * self.sections.interval
        row = 0
        for i, (_, time, stop, what) in enumerate(log):
            while row < len(rows) - 1 and rows[row, 1] < time - slack:
                row += 1
            f, after = int(stop), row + 1
            u, v = seen.displacement[row], seen.velocity[row]
            if after < len(rows):
                held = {g for g in range(self.stops) if seen.contact_force[after, g] != 0.0}
            else:
                held = {g for g in range(self.stops) if int(self.state[0]) >> g & 1}
            if i + 1 < len(log) and log[i + 1, 3] == layout.RISE:
                held.add(int(log[i + 1, 2]))
            if what == _IMPACT:
                for g in sorted(resting - {f} - held):
                    yield _Event(section, time, g, _END, u, v)
                    resting.discard(g)
                closing = abs(float(self.closing[f] @ v))
                again = i > 0 and log[i - 1, 2] == f and log[i - 1, 1] == time
                moving = closing > _AT_REST * float(np.abs(v).max())
                if f not in held or (moving and not again):
                    yield _Event(section, time, f, _HIT, u, v)
                if f in held:
                    # The impact after which the bodies rest is followed by the rest.
                    yield _Event(
                        section, time, f, _START, u, self._velocity_after(after, section, before)
                    )
                    resting.add(f)
            else:
                yield _Event(section, time, f, _START if what == _CONTACT else _END, u, v)
                resting.discard(f)
            row = after

    def _velocity_after(self, row: int, section: int, before: _Array) -> _Array:
        """Return the velocities at the beginning of a stretch of a section."""
        rows = self._rows_at_begin(self.sections.lines[section : section + 1], before)
        if row < len(rows):
            found: _Array = _Seen.of(rows, self.n, self.stops).velocity[row]
            return found
        now: _Array = self.state[layout.PARTS + self.n : layout.PARTS + 2 * self.n].copy()
        return now


def compute_assembly_history(
    rig: Rig,
    shaking: Repeated | Record,
    length: float,
    start: Any,
    samples: int,
    max_events: int,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Return what `simulate` returns of an assembly.

    Parameters
    ----------
    rig
        The rig, with an assembly.
    shaking
        What shakes it, with its frequency.
    length
        Forcing cycles; for a record, the duration of the free vibration after it (s).
    start, samples, max_events, progress
        As in `simulate`.
    """
    assembly = rig.system
    assert isinstance(assembly, Assembly)
    check_laws(assembly)
    state = equilibrium(assembly) if start is None else as_assembly_state(start, assembly)
    vector = assembly_vector(assembly, state)
    if isinstance(shaking, Record):
        phase, ends = 0.0, shaking.duration + length
    else:
        phase, ends = shaking.phase if state.phase is None else state.phase, length
    sections = sections_of(shaking, length, phase)
    if isinstance(shaking, Record):
        check_samples(len(sections.lines), samples, "samples", "time steps")
    first = state_components(assembly, vector, phase)
    run = _Run(rig, shaking, sections, vector, samples, max_events)
    finished = run.follow(progress)
    told = run.status
    record = shaking if isinstance(shaking, Record) else None
    if told is not Status.DONE:
        where = (
            f"{finished * record.step:g} s into the record" if record else f"in cycle {finished}"
        )
        warn_of_result(f"simulate stopped {where}: {told.advice}")
        ends = finished * (record.step if record else 1.0)
    last_phase = 0.0 if record else phase + 2.0 * math.pi * (ends % 1.0)
    variables: dict[str, Any] = {
        "final_state": ("component", state_components(assembly, run.state, last_phase)),
        "simultaneous_impacts": int(run.plan[layout.ORDERED]),
        "status": int(told),
    }
    coordinates: dict[str, Any] = {"component": component_names(assembly)}
    if samples:
        coordinates["mass"] = np.array(assembly.names, dtype=np.str_)
        coordinates["stop"] = np.array(list(assembly.stops), dtype=np.str_)
        variables["initial_state"] = ("component", first)
        variables |= _sampled(assembly, shaking, phase, run, ends, coordinates)
        variables |= _listed(assembly, run, record is not None)
    data = xr.Dataset(variables, coordinates)
    data.attrs["message"] = told.advice
    notes = _doubts(run, "step" if record else "cycle")
    for one in notes:
        warn_of_result(f"simulate: {one}")
    parameters: dict[str, Any] = {"assembly": assembly.model_dump()}
    if record:
        parameters |= {"record": record_parameters(record), "tail": length}
        notes = [*record.about.notes, *notes]
    elif not isinstance(shaking, Record):
        parameters |= {**excitation_parameters(shaking.replace(phase=phase)), "cycles": ends}
    return describe(data, "vibroimpact.simulate", parameters, notes)


def _sampled(
    assembly: Assembly,
    shaking: Repeated | Record,
    phase: float,
    run: _Run,
    ends: float,
    coordinates: dict[str, Any],
) -> dict[str, Any]:
    """Return the samples, and write their times into the coordinates."""
    width = run.rows.shape[1]
    rows = np.concatenate([np.empty((0, width)), *run.seen])
    seen = _Seen.of(rows, run.n, run.stops)
    count = len(rows)
    if isinstance(shaking, Record):
        time = np.minimum(np.arange(count) * (shaking.step / run.samples), ends)
        coordinates["time"] = time
        name, values = "base_acceleration", base_acceleration(shaking, time, run.samples)
    else:
        cycle = np.arange(count) / run.samples
        if count and run.status is Status.DONE:
            cycle[-1] = ends
        coordinates["time"] = cycle / shaking.frequency
        coordinates["cycle"] = ("time", cycle)
        name = "base_acceleration" if shaking.moves_base else "applied_force"
        values = shaking.at(2.0 * np.pi * (cycle % 1.0) + phase) + 0.0
    found: dict[str, Any] = {
        one: ((VARIABLES[one].part, "time"), column.T + 0.0)
        for one, column in seen._asdict().items()
    }
    found[name] = ("time", values)
    # The force that would balance the masses if the base moved them as a rigid body.
    of = numbers(assembly)
    carried = -seen.acceleration @ (of.mass @ of.influence) + of.influence @ of.force
    if name == "applied_force":
        assert not isinstance(shaking, Record)
        carried += of.influence[assembly.names.index(shaking.on or assembly.names[0])] * values
    found["transmitted_force"] = ("time", carried + 0.0)
    return found


def _listed(assembly: Assembly, run: _Run, record: bool) -> dict[str, Any]:
    """Return the contacts and detachments."""
    events = run.events
    interval = run.sections.interval
    section = np.array([one.section for one in events], dtype=np.int64)
    since = np.array([one.time for one in events], dtype=float)
    stops = list(assembly.stops)
    empty = np.empty((0, run.n))
    found: dict[str, Any] = {
        "event_time": ("event", section * interval + since),
        "event_contact": ("event", np.array([one.kind for one in events], dtype=np.int64)),
        "event_stop": ("event", np.array([stops[one.stop] for one in events], dtype=np.str_)),
    }
    for name in ("displacement", "velocity"):
        values = [getattr(one, name)[np.newaxis] for one in events]
        found[f"event_{name}"] = (("event", "mass"), np.concatenate([empty, *values]) + 0.0)
    if not record:  # a record has steps, not cycles
        found |= {"event_cycle": ("event", section), "event_cycle_time": ("event", since)}
    return found


def _doubts(run: _Run, section: str) -> list[str]:
    """What the engine decided by a rule, or could not decide."""
    notes = []
    ordered, undecided = int(run.plan[layout.ORDERED]), int(run.plan[layout.UNDECIDED])
    if ordered:
        where = (
            ""
            if run.ordered_in is None or not run.samples
            else (f" (the first in {section} {run.ordered_in})")
        )
        notes.append(
            f"{ordered} impact{'s' if ordered > 1 else ''} at the same instant as another impact "
            f"or rest of the same mass{where}; their order is that of the stops in the assembly, "
            "because restitution alone does not determine the result"
        )
    if undecided:
        notes.append(
            f"the search for an event was given up {undecided} time{'s' if undecided > 1 else ''} "
            "and counted as no event; check the orders of magnitude of the input"
        )
    return notes
