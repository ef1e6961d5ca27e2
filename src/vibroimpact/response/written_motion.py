"""A motion that the engine writes down: samples at equal times, and what happens at the stops."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch, record_forcing
from vibroimpact.engine.assembly import layout
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.status import Status
from vibroimpact.model import Record, Repeated
from vibroimpact.model.argument_types import check_samples
from vibroimpact.response.engine_system import EngineSystem
from vibroimpact.response.record_history import straight
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]

EVENTS_AT_ONCE = 20_000
"""Room for events between two calls of the engine."""


class WrittenMotion:
    """A motion that is followed, and what was written down of it.

    Parameters
    ----------
    length
        Forcing cycles; for a record, the duration of the free vibration after it (s).
    phase
        Where a repeated forcing begins (rad).
    state : ndarray
        Where the motion begins; carried on.
    """

    def __init__(
        self,
        system: EngineSystem,
        shaking: Repeated | Record,
        length: float,
        phase: float,
        state: _Array,
        samples: int,
        max_events: int,
    ) -> None:
        self.shaking, self.state, self.samples = shaking, state, samples
        self.phase, self.max_events = phase, max_events
        if isinstance(shaking, Record):
            self.lines = straight(shaking, length)
            check_samples(len(self.lines), samples, "samples", "time steps")
            self.interval, self.total = shaking.step, float(len(self.lines))
            count = math.ceil((shaking.duration + length) / shaking.step * samples - 1e-6)
        else:
            self.interval, self.total = shaking.period, length
            count = math.ceil(length * samples - 1e-9)
        rows, self.columns = system.record_widths
        self.vector = system.numbers(shaking)
        self.by_mass = system.system.by_mass
        # Impacts that were ordered by a rule are counted, so that events are always listed.
        self.lists_events = samples > 0 or self.by_mass
        self.out = np.empty((rows, count + 1 if samples else 0))
        self.events: list[_Array] = []
        """Rows of events, in parts."""
        self.undecided = False
        """Whether the search for an event of several masses was given up."""
        self.status = Status.DONE

    @property
    def section(self) -> str:
        """What a section is, in words."""
        return "step" if isinstance(self.shaking, Record) else "cycle"

    def follow(self, progress: Progress | None) -> int:
        """Follow the motion; returns the number of sections that were finished."""
        entry = record_forcing.follow if isinstance(self.shaking, Record) else batch.trajectory
        plan = plan_of(self.vector, entry.groups)
        capacity = self.max_events + 1 + (EVENTS_AT_ONCE if self.lists_events else 0)
        buffer = np.empty((capacity, self.columns))
        at, outcome = 0, int(Status.DONE)
        calls = Calls(self.total, progress)
        while at < self.total and outcome == Status.DONE:
            arguments = self._arguments(at, calls.end(at))
            at, count, outcome = entry.on(plan, self.vector, *arguments, self.out, buffer)
            if self.lists_events:
                self.events.append(buffer[:count].copy())
            if self.by_mass:
                self.undecided |= bool(plan[layout.UNDECIDED] > 0.0)
        self.status = Status(outcome)
        # The section that was given up is left out; its events until then are kept.
        return at if self.status is Status.DONE else max(at - 1, 0)

    def _arguments(self, at: int, end: float) -> tuple[object, ...]:
        """Return what an entry gets, from a section to another."""
        shaking = self.shaking
        if isinstance(shaking, Record):
            lines = self.lines[: int(end)]
            steepest = float(np.abs(self.lines[:, record_forcing.SLOPE]).max())
            forced = (shaking.peak, steepest, lines, self.state, at)
            return (*forced, self.samples, self.interval, self.max_events)
        forcing = (shaking.amplitude, shaking.frequency, self.phase, self.state, float(at), end)
        return (*forcing, self.samples, self.max_events)

    def truncate(self, finished: int) -> None:
        """Leave out the samples after so many sections."""
        self.out = self.out[:, : finished * self.samples]
