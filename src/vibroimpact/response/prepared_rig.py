"""The prepared rig: what the engine needs of a rig, made once, with its computations."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch, lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.model import AssemblyState, Repeated, Rig, State
from vibroimpact.response.engine_system import EngineSystem, engine_rig, engine_system
from vibroimpact.response.hold_rows import MAX_EVENTS, HoldRows, Settling, sweep_holds
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import CYCLES, Progress, Tally, watched

_Array = NDArray[np.float64]

_ROWS = 16_384
"""Cycles of one call of the engine, at most: their rows take 1 MB."""


class PreparedRig(NamedTuple):
    """A rig under a periodic shaking, as the engine follows it.

    States are vectors of the engine at the phase of the shaking.
    """

    rig: Rig
    vector: _Array
    """The rig as the engine reads it."""

    @property
    def shaking(self) -> Repeated:
        """What shakes it; the phase is that of the section."""
        return self.rig.periodic

    @property
    def states(self) -> EngineSystem:
        """How states stand in vectors."""
        return engine_system(self.rig.system)

    def state(self, start: State | AssemblyState | None = None) -> _Array:
        """Return the engine's vector of a state. Default: at rest at the static equilibrium."""
        return self.states.vector_of(start or self.states.read(None))

    def at_phase(self, phase: float) -> PreparedRig:
        """Return the same rig with its section at another forcing phase."""
        turned = self.shaking.replace(phase=phase)
        return self._replace(rig=self.rig.with_parts(self.rig.system, turned))

    def propagate(
        self, state: _Array, cycles: float, max_events: int = MAX_EVENTS
    ) -> tuple[Status, _Array]:
        """Return the state some forcing cycles later; of use only if `Status.DONE`."""
        later, shaking = state.copy(), self.shaking
        outcome = batch.propagate(
            self.vector,
            shaking.amplitude,
            shaking.frequency,
            shaking.phase,
            later,
            cycles,
            max_events,
        )
        return Status(outcome), later

    def dwell(
        self, state: _Array, settling: Settling, progress: Progress | None = None
    ) -> tuple[HoldRows, _Array]:
        """Hold the frequency until the motion has settled; Ctrl-C ends it.

        Return what was measured and the state at the end. Progress counts up to the largest number
        of cycles of `settling`.
        """
        pairs: list[tuple[HoldRows, _Array]] = []
        shaking = self.shaking

        def hold_frequency(tally: Tally) -> None:
            sizes, places = np.array([shaking.amplitude]), np.array([shaking.frequency])
            pairs.append(
                sweep_holds(self.vector, sizes, places, shaking.phase, state, settling, tally)
            )

        watched(hold_frequency, settling.max_cycles, progress, CYCLES)
        ((rows, reached),) = pairs
        return rows[0], reached[0]

    def sections(
        self,
        state: _Array,
        cycles: int,
        max_events: int = MAX_EVENTS,
        *,
        transient: int = 0,
        discard: int = 0,
        progress: Progress | None = None,
    ) -> tuple[Status, _Array]:
        """Return sections of a motion, and the growth of perturbations, cycle by cycle.

        Parameters
        ----------
        state
            Where the motion begins; it becomes the state at the end.
        max_events
            Events in one forcing cycle at which the motion is given up.
        transient, discard
            Cycles before the first row, without and with perturbations.

        Returns
        -------
        status, rows
            Rows of `engine.lyapunov.growth`: fewer than requested unless `Status.DONE`.
        """
        rows = np.empty((cycles, lyapunov.SECTION + self.states.parts))
        done = 0

        def add_rows(some: _Array) -> None:
            nonlocal done
            rows[done : done + len(some)] = some
            done += len(some)

        status = self.grow(
            state,
            cycles,
            add_rows,
            max_events,
            transient=transient,
            discard=discard,
            progress=progress,
        )
        return status, rows[:done]

    def grow(
        self,
        state: _Array,
        cycles: int,
        add_rows: Callable[[_Array], None],
        max_events: int = MAX_EVENTS,
        *,
        transient: int = 0,
        discard: int = 0,
        count: int = 2,
        progress: Progress | None = None,
    ) -> Status:
        """As `sections`, in parts, so that no more rows are in memory than are kept.

        Parameters
        ----------
        add_rows
            Called with the next rows, which are overwritten afterwards.
        count
            Perturbations whose growth is seen.
        """
        parts, shaking = self.states.parts, self.shaking
        rows = np.empty((min(cycles, _ROWS), count + 1 + parts))
        perturbations = np.zeros((parts, parts))
        first = -transient - discard
        calls = Calls(cycles - first, progress, _ROWS)
        at, outcome = first, int(Status.DONE)
        while at < cycles and outcome == Status.DONE:
            outcome, after = lyapunov.growth(
                self.vector,
                shaking.amplitude,
                shaking.frequency,
                shaking.phase,
                state,
                perturbations,
                at == first,
                at,
                first + int(calls.end(at - first)),
                discard,
                max_events,
                rows,
            )
            if after > 0:
                add_rows(rows[: after - max(at, 0)])
            at = after
        if progress and at == cycles:
            progress(cycles - first, cycles - first)
        return Status(outcome)


def prepare(rig: Rig) -> PreparedRig:
    """Prepare a rig that a periodic shaking moves."""
    return PreparedRig(rig, engine_rig(rig))
