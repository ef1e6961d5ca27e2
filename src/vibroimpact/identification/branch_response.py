"""The branches of a rig at the frequencies of a test, up to their folds.

A stepped-sine test follows a branch until it jumps. A rig whose fold lies elsewhere is on another
branch at some of the test's frequencies, and what is compared there must not jump when its fold
passes one of them. So each measured jump is given the jump of the rig that it belongs to, and:

- where the rig jumps too early, the branch is followed on in finer steps, for a step may throw the
  mass off a branch that goes on, and then held at its value at the fold;
- where it jumps too late, the branch after the jump is followed back, up to its own fold. For the
  same reason the fold may lie up to a step beyond the step in which the test jumps.

Near a fit both jump in the same step, and a sweep alone is all that is needed.

A jump of the rig that the test does not show, since it is small or at an end, may still pass one of
its frequencies. The two holds beside it have the value of the other branch, too: that after the
jump followed back, and that before it at its end. A point belongs to the nearer one.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.model import State, equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.engine_system import engine_rig
from vibroimpact.response.hold_rows import HoldRows, Settling, sweep_holds

Array = NDArray[np.float64]

_EXACT = Settling(1e-12, 300, 100, 2000)
_QUICK = Settling(1e-7, 60, 20, 2000)
"""Tolerance, cycles to wait, and cycles over which what did not settle is measured."""
_MAX_EVENTS = 2000
_HALVINGS = 22
_REAL = 0.25
"""What keeps less than this share of its size, halved so often, is steep, and no jump."""
_PARTS = 8
"""Of a step of the test, in which a branch is followed that a whole step leaves too early."""
_LOST = 0.4
"""A step of so much of a jump has left the branch."""
_LEAST, _STEEPER = 0.03, 3.0
"""A step is looked into where it is at least so large, and so many times its neighbours."""
_FEWER = 14
_NEAR = 0.25
"""Share of the test's range in which a jump of the rig is looked for with preference."""


class Way(NamedTuple):
    """One direction of a test."""

    frequency: Array
    """Hz, in the order of the sweep."""
    jumps: tuple[tuple[int, bool], ...]
    """The holds before which it jumps, in order, and whether upwards."""


class DirectionResponse(NamedTuple):
    """What a rig does in one direction of a test."""

    rows: Array
    """What was measured of each hold, see `engine.steady_response`; on the branch of the test."""
    settled: NDArray[np.bool_]
    """Whether the motion became periodic."""
    off: Array
    """By how much each jump lies outside its step (Hz); 0 inside."""
    clamped: NDArray[np.bool_]
    """Whether the branch has ended before."""
    other: dict[int, Array]
    """The other branch of holds beside a jump that the test does not show."""


class SteppedRig:
    """A rig that is held at one frequency after the other."""

    def __init__(self, rig: Rig) -> None:
        oscillator = rig.oscillator
        self.oscillator = oscillator
        self.vector = engine_rig(rig)
        self.amplitude = float(rig.amplitude)
        self.rest = engine_state(oscillator, equilibrium(oscillator))

    def sweep(
        self, frequency: Array, state: Array | None = None, *, quick: bool = False
    ) -> tuple[Array, Array]:
        """Hold the frequencies; rows and states at their ends.

        A `quick` hold is accurate enough to decide on which of two branches it is.
        """
        rows, states = sweep_holds(
            self.vector,
            np.full(len(frequency), self.amplitude),
            frequency,
            0.0,
            self.rest if state is None else state,
            _QUICK if quick else _EXACT,
        )
        return rows.array, states

    def settled(self, start: State, frequency: float, phase: float) -> Array | None:
        """Where a state settles at a frequency (Hz), seen at a phase; None if it does not."""
        levels, state = np.array([self.amplitude]), engine_state(self.oscillator, start)
        rows, states = sweep_holds(self.vector, levels, np.array([frequency]), phase, state, _EXACT)
        return states[0] if rows.period[0] > 0 else None


def sizes(rows: Array) -> Array:
    """Logarithms of both excursions: what jumps are seen by."""
    held = HoldRows(rows)
    swing, force = held.displacement_excursion, held.acceleration_excursion
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.nan_to_num(np.log(np.stack([swing, force], axis=-1)), nan=0.0, neginf=-50.0)


def follow(rig: SteppedRig, way: Way) -> DirectionResponse:
    """Follow one direction of a test, each measured jump matched by one of the rig."""
    rows, states = rig.sweep(way.frequency)
    off = np.zeros(len(way.jumps))
    clamped = np.zeros(len(rows), dtype=bool)
    size = sizes(rows)
    places: list[int | None] = []
    swept_rows = rows
    if way.jumps:
        places = _matched(np.diff(size, axis=0).sum(axis=1), way)
        whole = float(np.ptp(way.frequency))
        taken = rows.copy()
        for number, ((at, _), place) in enumerate(zip(way.jumps, places, strict=True)):
            if place is None:
                off[number] = whole
            elif place != at:
                off[number] = _mend(rig, way, rows, states, size, (at, place), taken, clamped)
        rows = taken
    settled = HoldRows(rows).settled
    other = _untold(rig, way, swept_rows, states, size, places, settled & ~clamped)
    return DirectionResponse(rows, settled, off, clamped, other)


def _untold(
    rig: SteppedRig,
    way: Way,
    rows: Array,
    states: Array,
    size: Array,
    matches: list[int | None],
    plain: NDArray[np.bool_],
) -> dict[int, Array]:
    """The other branch beside each jump of the rig that no jump of the test stands for."""
    change = np.abs(np.diff(size, axis=0)).max(axis=1)
    around = np.zeros(len(change) + 2)
    around[1:-1] = change
    beside = np.maximum(around[:-2], around[2:])
    others: dict[int, Array] = {}
    f = way.frequency
    for i in np.flatnonzero((change > _LEAST) & (change > _STEEPER * beside)) + 1:
        if i in matches or not (plain[i - 1] and plain[i]):
            continue
        ends = (f[i - 1], f[i])
        _, old, _, real = _halved(rig, ends, states[i - 1], size[i - 1 : i + 1], rows[i], _FEWER)
        if not real:
            continue
        others[int(i)] = old
        (back,), _ = rig.sweep(f[i - 1 : i], states[i])
        if np.abs(sizes(back) - size[i]).max() < np.abs(sizes(back) - size[i - 1]).max():
            others[int(i) - 1] = back
    return others


def _matched(change: Array, way: Way) -> list[int | None]:
    """The hold before which the rig makes each jump: the largest steps of its sign, in order."""
    f = way.frequency
    middle = 0.5 * (f[1:] + f[:-1])
    whole = float(np.ptp(f)) or 1.0
    count = len(change)
    best = np.zeros((len(way.jumps) + 1, count + 1))
    chosen = np.full((len(way.jumps) + 1, count + 1), -1)
    for j, (at, upward) in enumerate(way.jumps, 1):
        away = (middle - middle[at - 1]) / (_NEAR * whole)
        score = np.maximum(change if upward else -change, 0.0) / (1.0 + away**2)
        for i in range(1, count + 1):
            best[j, i], chosen[j, i] = best[j, i - 1], chosen[j, i - 1]
            value = best[j - 1, i - 1] + score[i - 1]
            if score[i - 1] > 0.0 and value > best[j, i]:
                best[j, i], chosen[j, i] = value, i
    places: list[int | None] = []
    last = count
    for j in range(len(way.jumps), 0, -1):
        i = int(chosen[j, last])
        places.append(i if i > 0 else None)
        last = i - 1 if i > 0 else last
    return places[::-1]


def _mend(
    rig: SteppedRig,
    way: Way,
    rows: Array,
    states: Array,
    size: Array,
    jump: tuple[int, int],
    taken: Array,
    clamped: NDArray[np.bool_],
) -> float:
    """Put a jump of the rig that lies in another step where the test has it.

    Returns by how much it lies outside its step (Hz).
    """
    at, place = jump
    f = way.frequency
    if place < at:  # too early: in finer steps, and then at its end
        return _carried_on(rig, f, states[place - 1], size[place - 1 : place + 1], jump, taken,
                           clamped)  # fmt: skip
    edge, _, _, real = _halved(
        rig, (f[place - 1], f[place]), states[place - 1], size[[place - 1, place]], rows[place]
    )
    if real:  # too late: the new branch is followed back
        back = f[at:place][::-1]
        branch, there = rig.sweep(back, states[place])
        seen = sizes(branch)
        was = size[at:place][::-1]
        state, last, before = states[place], rows[place], size[place]
        for i in range(len(back)):
            if np.abs(seen[i] - was[i]).max() < np.abs(seen[i] - before).max():
                ends = (f[place] if i == 0 else back[i - 1], back[i])
                _, last, _, _ = _halved(rig, ends, state, np.stack([before, seen[i]]), branch[i])
                last = last if np.isfinite(last).all() else rows[place]
                branch[i:] = last
                clamped[at : place - i] = True
                break
            state, last, before = there[i], branch[i], seen[i]
        taken[at:place] = branch[::-1]
    return max(float(abs(edge - f[at]) - abs(f[at] - f[at - 1])), 0.0)


def _carried_on(
    rig: SteppedRig,
    f: Array,
    state: Array,
    size: Array,
    jump: tuple[int, int],
    taken: Array,
    clamped: NDArray[np.bool_],
) -> float:
    """Follow a branch beyond where a step has thrown the mass off it, up to its end.

    Returns how far before the test's last hold on it it ends (Hz).
    """
    at, place = jump
    ends = f[place - 1 : at]
    fine = np.concatenate([np.linspace(a, b, _PARTS + 1)[1:] for a, b in pairwise(ends)])
    branch, there = rig.sweep(fine, state)
    before, after = size
    seen = np.concatenate([before[np.newaxis], sizes(branch)])
    steps = np.diff(seen, axis=0)
    along = steps @ (after - before)
    last = int(np.argmax(along))
    whole = float(np.abs(after - before).max())
    count = len(fine)
    edge = float(fine[-1])
    if np.abs(steps[last]).max() > _LOST * whole:
        low = float(ends[0]) if last == 0 else float(fine[last - 1])
        begin = state if last == 0 else there[last - 1]
        edge, old, _, real = _halved(
            rig, (low, float(fine[last])), begin, seen[last : last + 2], branch[last]
        )
        if real:
            branch[last:] = old
            count = last
    for k in range(place, at):
        i = (k - place + 1) * _PARTS - 1
        taken[k] = branch[i]
        clamped[k] = i >= count
    return abs(edge - float(f[at - 1])) if count < len(fine) else 0.0


def _halved(
    rig: SteppedRig,
    ends: tuple[float, float],
    state: Array,
    size: Array,
    behind: Array,
    halvings: int = _HALVINGS,
) -> tuple[float, Array, Array, bool]:
    """Where between two frequencies a branch ends, by halving.

    Returns
    -------
    edge, old, new, real
        The frequency (Hz), what is measured on both its sides, and whether it is a jump: whether
        the two still differ.
    """
    low, high = ends
    before, after = size
    whole = float(np.abs(after - before).max())
    (first,), _ = rig.sweep(np.array([low]), state)
    old, new = first, behind
    for _ in range(halvings):
        middle = 0.5 * (low + high)
        (row,), (there,) = rig.sweep(np.array([middle]), state, quick=True)
        seen = sizes(row)
        if np.abs(seen - before).max() <= np.abs(seen - after).max():
            low, state = middle, there
            if HoldRows(row).period > 0:  # a transient beside a fold is no value of the branch
                before, old = seen, row
        else:
            high = middle
            if HoldRows(row).period > 0:
                after, new = seen, row
    return 0.5 * (low + high), old, new, bool(np.abs(after - before).max() > _REAL * whole)
