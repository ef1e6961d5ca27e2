"""States labelled by the motion that they lead to, motions being found as states lead to them.

1. All states are followed until a trap of a known motion catches them, for so many cycles.
2. The first that none has caught is followed to its end. Where that is a new motion, traps are made
   for it; where it is a known one, its trap is small or the way long.
3. The rest goes on from where it is, for twice as many cycles, until none is left.

So a motion is known as soon as one of the states leads to it, whatever its period, and no
state is given a motion that it does not lead to. A wandering motion without a closed set of cells
is identified by the distribution of its displacements, state by state, as `coexisting_motions`
does.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.attraction.absorbing_cells import Cells, cells_around, closed
from vibroimpact.attraction.attractors import Attractor, attractor
from vibroimpact.attraction.label_states import NO_TRAPS, Points, SectionSetup, Traps, follow
from vibroimpact.attraction.section_coordinates import has_no_memory
from vibroimpact.engine.absorption import GRID, LOW_U, LOW_V, STEP_U, STEP_V
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.engine.status import MORE_CYCLES, Status
from vibroimpact.errors import InputError
from vibroimpact.stability.equivalence import ALIKE, distance, same
from vibroimpact.stability.settled_motion import Settled, approach
from vibroimpact.tasks.threads import Progress, Workers

_Array = NDArray[np.float64]
_Whole = NDArray[np.integer[Any]]
_Tiny = NDArray[np.int8]

MOST = 64
"""The largest number of different motions that are searched for."""
_PILOT = 500
"""Number of states that are simulated first."""
_FIRST = 100
"""Cycles in which most states are caught."""
_SETTLED = 200
"""Cycles after which a motion that is not caught within a set of cells counts as wandering."""
_WATCHED = 1000
"""Cycles by which a motion that no trap has caught is identified."""
_LOOKS = 20
"""Cycles over which it is then watched."""


class Labelled(NamedTuple):
    """Where states lead."""

    owner: _Tiny
    """Number of the motion; -1 where none is known."""
    cycles: NDArray[np.int32]
    """Until they were caught, or in all."""
    outcome: _Tiny
    """`Status`."""


class Search:
    """The motions that are known so far, and their traps."""

    def __init__(
        self, stage: SectionSetup, max_cycles: int = 2000, threads: Workers = None
    ) -> None:
        self.stage = stage
        self.max_cycles = max_cycles
        self.threads = threads
        self.known: list[Attractor] = []
        self.traps = NO_TRAPS

    def label(self, points: Points, progress: Progress | None = None) -> Labelled:
        """Find where states lead; what they lead to is known afterwards.

        Points are u, u̇, u_R, u_L, z, the deformations away from the mass.

        Raises
        ------
        InputError
            If nothing dies out, or there are too many motions.
        """
        total = len(points)
        if not self.known and total > 2 * _PILOT:
            # Few states find nearly all motions, and the many then meet their traps.
            self.label(points[np.random.default_rng(0).choice(total, _PILOT, replace=False)])
        # Most are caught at once: what is found of all is kept, and the others are counted.
        states, owner, cycles, outcome = follow(
            self.stage, points, None, self.traps, _FIRST, self.threads, progress
        )
        left = np.flatnonzero(outcome == Status.NOT_SETTLED)
        ahead = _FIRST
        while len(left):
            if cycles[left[0]] >= self.max_cycles:
                self._rest(left, states, owner, outcome)
                break
            new = len(self.known)
            owner[left[0]], outcome[left[0]] = self._end_of(states[0])
            left, states = left[1:], states[1:]
            ahead = _FIRST if len(self.known) > new else 2 * ahead
            done = total - len(left)
            report = None if progress is None else lambda n, _, done=done: progress(done + n, total)
            followed = follow(
                self.stage,
                None,
                states,
                self.traps,
                ahead,
                self.threads,
                report if ahead == _FIRST else None,
            )
            states = followed.states
            owner[left], outcome[left] = followed.owner, followed.outcome
            cycles[left] += followed.cycles
            left = left[followed.outcome == Status.NOT_SETTLED]
        if progress is not None:
            progress(total, total)
        return Labelled(owner, cycles, outcome)

    def _end_of(self, state: _Array) -> tuple[int, int]:
        """The motion that a state leads to, entered if it is new; -1 and why if there is none."""
        rig, max_events = self.stage
        motion = approach(rig, state, max_cycles=self.max_cycles, max_events=max_events)
        if motion.status not in (Status.DONE, Status.NOT_SETTLED):
            return -1, int(motion.status)
        # A motion is described once: what repeats and is known already needs no more.
        number = self._known_as(motion) if motion.period else -1
        if number >= 0:
            return number, int(Status.DONE)
        met = attractor(self.stage, state, motion, len(self.known))
        if isinstance(met, Status):
            return -1, int(met)
        number = self._known_as(met.settled_motion)
        if number >= 0:
            return number, int(Status.DONE)
        if len(self.known) == MOST:
            raise InputError(
                f"oscillator: more than {MOST} motions were found, so perhaps every state has "
                "its own motion; add damping, narrow the range of initial states, or raise "
                f"{MORE_CYCLES}"
            )
        self.known.append(met)
        self._set_traps()
        return len(self.known) - 1, int(Status.DONE)

    def _known_as(self, motion: Settled) -> int:
        """Number of the motion that this is; -1 if it is new."""
        for number, one in enumerate(self.known):
            if one.settled_motion.period == motion.period and same(
                one.settled_motion, motion, self.stage.max_events
            ):
                return number
        return -1

    def _rest(self, left: _Whole, states: _Array, owner: _Tiny, outcome: _Tiny) -> None:
        """Classify what no trap has caught by what it visits, or by following it to its end."""
        if any(not one.settled_motion.period for one in self.known):
            seen = np.full((_WATCHED, len(left)), np.nan)
            going, now = np.arange(len(left)), states
            for row in seen:
                went = follow(self.stage, None, now, NO_TRAPS, 1, self.threads)
                going, now = going[went.outcome == Status.NOT_SETTLED], went.states
                row[going] = now[:, ONE_MASS.displacement()]
            states = states.copy()
            states[going] = now
            seen.sort(axis=0)
            for column, i in zip(going, left[going], strict=True):
                apart = [
                    1.0 if one.settled_motion.period else distance(one.visited, seen[:, column])
                    for one in self.known
                ]
                if min(apart) <= ALIKE:
                    owner[i], outcome[i] = int(np.argmin(apart)), int(Status.DONE)
        for state, i in zip(states, left, strict=True):
            if owner[i] < 0:
                owner[i], outcome[i] = self._end_of(state)

    def _set_traps(self) -> None:
        rows = np.vstack([one.traps for one in self.known])
        self.traps = NO_TRAPS._replace(rows=rows)
        wandering = [i for i, one in enumerate(self.known) if not one.settled_motion.period]
        if not wandering or not has_no_memory(self.stage):
            return
        cells = cells_around(np.vstack([self.known[i].points[:, :2] for i in wandering]))
        whose: NDArray[np.int64] | None = None
        for i in wandering:
            mask = closed(self.stage, cells, self.known[i].points[:, :2], self.threads)
            if mask is None or not self._one_motion(cells, mask, i):
                continue
            if whose is None:
                whose = np.full(mask.shape, -1, dtype=np.int64)
            if (whose[mask] >= 0).any():
                whose[mask & (whose >= 0)] = -1
                continue
            whose[mask] = i
        if whose is None:
            return
        grid = np.empty(GRID)
        grid[[LOW_U, LOW_V]], grid[[STEP_U, STEP_V]] = cells.corner, cells.side
        self.traps = Traps(rows, whose, grid)

    def _one_motion(self, cells: Cells, mask: NDArray[np.bool_], number: int) -> bool:
        """Whether all that begins in closed cells ends as one motion, as far as samples show."""
        rows, columns = np.nonzero(mask)
        centres = np.zeros((len(rows), ONE_MASS.total))
        centres[:, :2] = cells.corner + cells.side * (np.column_stack([columns, rows]) + 0.5)
        went = follow(self.stage, centres, None, self.traps, _SETTLED, self.threads)
        if not (went.outcome == Status.NOT_SETTLED).all():
            return False
        states, seen = went.states, []
        for _ in range(_LOOKS):
            went = follow(self.stage, None, states, NO_TRAPS, 1, self.threads)
            states = went.states
            if len(states) < len(centres):
                return False
            seen.append(states[:, ONE_MASS.displacement()])
        theirs = np.sort(np.concatenate(seen))
        return distance(self.known[number].visited, theirs) <= ALIKE
