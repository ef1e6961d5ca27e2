"""The motion of an assembly, as `simulate` returns it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, excitation_parameters
from vibroimpact.engine import batch, record_forcing
from vibroimpact.engine.assembly import layout
from vibroimpact.engine.assembly import record as writing
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.observers.record import CONTACT_BEGINS, DETACHMENT
from vibroimpact.engine.status import Status
from vibroimpact.errors import warn_of_result
from vibroimpact.model import Assembly, Record, Repeated, equilibrium
from vibroimpact.model.argument_types import check_samples
from vibroimpact.model.assembly import numbers
from vibroimpact.model.rig import Rig
from vibroimpact.response.assembly_rig import assembly_numbers, check_laws
from vibroimpact.response.assembly_state import (
    as_assembly_state,
    assembly_vector,
    component_names,
    state_components,
)
from vibroimpact.response.history_variables import EVENTS_AT_ONCE
from vibroimpact.response.record_dataset import record_parameters
from vibroimpact.response.record_history import base_acceleration, straight
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]


class _Event(NamedTuple):
    section: int
    time: float
    """Since the section began (s)."""
    stop: int
    kind: float
    displacement: _Array
    velocity: _Array


class _Run:
    """A motion that is followed, and what was written down of it.

    Parameters
    ----------
    rig, shaking
        What vibrates, and what shakes it.
    length, phase
        As `compute_assembly_history`; where the forcing begins (rad).
    state : ndarray
        Where the motion begins; carried on.
    samples, max_events
        As in `simulate`.
    """

    def __init__(
        self,
        rig: Rig,
        shaking: Repeated | Record,
        length: float,
        phase: float,
        state: _Array,
        samples: int,
        max_events: int,
    ) -> None:
        system = rig.system
        assert isinstance(system, Assembly)
        self.n, self.stops = len(system.names), len(system.stops)
        self.shaking, self.state, self.samples = shaking, state, samples
        self.max_events = max_events
        self.rigid = [one.stop.rigid for one in system.stops.values()]
        if isinstance(shaking, Record):
            self.interval = shaking.step
            self.lines = straight(shaking, length)
            self.total = float(len(self.lines))
            ends = (shaking.duration + length) / shaking.step
        else:
            self.interval, self.total, ends = shaking.period, length, length
        self.phase = phase
        count = math.ceil(ends * samples - 1e-6) + 1 if samples else 0
        self.out = np.empty((writing.samples_of(self.n, self.stops), count))
        self.rows = np.empty((0, writing.event_width(self.n)))
        self.undecided = False
        self.vector = assembly_numbers(system, shaking)
        self.status = Status.DONE

    def follow(self, progress: Progress | None) -> int:
        """Follow the motion; returns the number of sections that were finished."""
        entry = record_forcing.follow if isinstance(self.shaking, Record) else batch.trajectory
        plan = plan_of(self.vector, entry.groups)
        # Impacts that were ordered by a rule are counted, so that events are always listed.
        buffer = np.empty((self.max_events + 1 + EVENTS_AT_ONCE, self.rows.shape[1]))
        found = [self.rows]
        at, outcome = 0, int(Status.DONE)
        calls = Calls(self.total, progress)
        while at < self.total and outcome == Status.DONE:
            arguments = self._arguments(at, calls.end(at))
            at, events, outcome = entry.on(plan, *arguments, self.out, buffer)
            found.append(buffer[:events].copy())
            self.undecided |= bool(plan[layout.UNDECIDED] > 0.0)
        self.rows, self.status = np.concatenate(found), Status(outcome)
        if self.status is Status.DONE:
            return at
        # The section that was given up is left out; its events until then are kept.
        finished = max(at - 1, 0)
        self.out = self.out[:, : finished * self.samples]
        return finished

    def _arguments(self, at: int, end: float) -> tuple[Any, ...]:
        """Return what an entry gets, from a section to another."""
        shaking = self.shaking
        if isinstance(shaking, Record):
            lines = self.lines[: int(end)]
            steepest = float(np.abs(self.lines[:, record_forcing.SLOPE]).max())
            forced = (shaking.peak, steepest, lines, self.state, at)
            return (self.vector, *forced, self.samples, self.interval, self.max_events)
        forcing = (shaking.amplitude, shaking.frequency, self.phase, self.state, float(at), end)
        return (self.vector, *forcing, self.samples, self.max_events)

    def channel(self, first: int, count: int) -> _Array:
        """Return samples of a channel, shape (mass or stop, time)."""
        return self.out[first : first + count] + 0.0

    def events(self) -> Iterator[_Event]:
        """Yield what happens at the stops, with the states just before it."""
        n = self.n
        for row in self.rows:
            section, stop = int(row[writing.E_CYCLE]), int(row[writing.E_STOP])
            time, kind = float(row[writing.E_TIME]), row[writing.E_KIND]
            u, v, behind = np.split(row[writing.E_MASSES :], [n, 2 * n])
            before, after = int(row[writing.E_BEFORE]), int(row[writing.E_BEHIND])
            rests = self.rigid[stop] and after >> stop & 1 > 0
            if kind != DETACHMENT:
                # Other rests of bodies that are hit end.
                for g in range(self.stops):
                    if g != stop and self.rigid[g] and before & ~after & 1 << g:
                        yield _Event(section, time, g, DETACHMENT, u, v)
            if not (rests and kind == CONTACT_BEGINS):
                yield _Event(section, time, stop, kind, u, v)
            if rests:
                # The impact after which the bodies rest is followed by the rest.
                yield _Event(section, time, stop, CONTACT_BEGINS, u, behind)


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
    first = state_components(assembly, vector, phase)
    run = _Run(rig, shaking, length, phase, vector, samples, max_events)
    if isinstance(shaking, Record):
        check_samples(len(run.lines), samples, "samples", "time steps")
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
        "simultaneous_impacts": int(run.rows[:, writing.E_ORDERED].sum()),
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
    n, stops, count = run.n, run.stops, run.out.shape[1]
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
        one: (("mass", "time"), run.channel(i * n, n)) for i, one in enumerate(_OF_MASSES)
    }
    for i, one in enumerate(_OF_STOPS):
        found[one] = (("stop", "time"), run.channel(3 * n + i * stops, stops))
    found[name] = ("time", values)
    # The force that would balance the masses if the base moved them as a rigid body.
    of = numbers(assembly)
    _, acceleration = found["acceleration"]
    carried = -(of.mass @ of.influence) @ acceleration + of.influence @ of.force
    if name == "applied_force":
        assert not isinstance(shaking, Record)
        carried += of.influence[assembly.names.index(shaking.on or assembly.names[0])] * values
    found["transmitted_force"] = ("time", carried + 0.0)
    return found


_OF_MASSES = ("displacement", "velocity", "acceleration")
_OF_STOPS = ("clearance", "contact_force", "deformation")


def _listed(assembly: Assembly, run: _Run, record: bool) -> dict[str, Any]:
    """Return the contacts and detachments."""
    events = list(run.events())
    interval = run.interval
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
    by_rule = run.rows[run.rows[:, writing.E_ORDERED] > 0.0]
    if ordered := len(by_rule):
        first = int(by_rule[0, writing.E_CYCLE])
        where = f" (the first in {section} {first})"
        notes.append(
            f"{ordered} impact{'s' if ordered > 1 else ''} at the same instant as another impact "
            f"or rest of the same mass{where}; their order is that of the stops in the assembly, "
            "because restitution alone does not determine the result"
        )
    if run.undecided:
        notes.append(
            "the search for an event was given up and counted as no event; check the orders of "
            "magnitude of the input"
        )
    return notes
