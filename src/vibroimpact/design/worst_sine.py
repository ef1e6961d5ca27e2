"""The worst of sines: what rigs do steadily over a range of frequencies, swept both ways."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from operator import attrgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator, equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_rig, engine_state
from vibroimpact.response.hold_rows import HoldRows, Settling, sweep_holds
from vibroimpact.response.softening_limit import judged
from vibroimpact.scenarios.map_node import RIG
from vibroimpact.scenarios.sweep_frequencies import LOW, MOST, cycles, highest
from vibroimpact.tasks.threads import Progress, Stopped, Tally, Workers, each

_Array = NDArray[np.float64]

STEP = 0.02
"""Step of the coarse sweep over the natural frequency; finer where the damping is light."""
_PEAK = 0.2
"""Step over the width of a lightly damped resonance, ξ f0, at most."""
_FINER = 8
"""Steps in the place of one beside a maximum, and again in the place of those."""
_LEVELS = 2
_ALIKE = 1e-6
"""Difference of two largest holds that are one motion."""
_FAR = 0.8
"""A sweep whose largest hold is smaller than this share of the other's is not refined."""
_SIZES: tuple[Callable[[HoldRows], _Array], ...] = (
    attrgetter("peak_displacement"),
    attrgetter("peak_acceleration"),
)
"""By which the largest response is sought."""
_TOLERANCE = 1e-9
_LEAST_CYCLES, _WINDOW = 300, 100
_SOUND = (int(Status.DONE), int(Status.NOT_SETTLED))
_UNBOUNDED = (int(Status.NOT_FINITE), int(Status.REVERSED))


class Worst(NamedTuple):
    """What is the largest over all frequencies and both directions, in SI units."""

    right: float
    """Displacement, to the right."""
    left: float
    acceleration: float
    force: _Array
    """Of the right and the left stop."""
    hits: bool
    displacement_frequency: float
    """Where the displacement is largest, to either side (Hz)."""
    acceleration_frequency: float
    unsettled: int
    """Holds at which no periodic motion was reached."""
    status: int


class _Holds(NamedTuple):
    """Frequencies in the order in which they were held, with the results."""

    frequency: _Array
    rows: HoldRows
    states: _Array


class Sines(NamedTuple):
    """Sines of one size over a range of frequencies."""

    shaken: Harmonic
    low: float | None = None
    """Lowest frequency (Hz); None for that at which scenarios begin, of each rig."""
    high: float | None = None
    """Highest frequency (Hz); None for one that is beyond the primary resonance of each rig."""
    step: float = STEP

    def frequencies(self, rig: Oscillator) -> _Array:
        """The frequencies of the coarse sweep (Hz)."""
        natural = rig.natural_frequency
        low = LOW * natural if self.low is None else self.low
        high = highest(Rig(rig, self.shaken)) * natural if self.high is None else self.high
        step = self.step
        if rig.isolator.linear and rig.damping_ratio > 0.0:
            step = min(step, max(_PEAK * rig.damping_ratio, 0.1 * step))
        count = max(2, math.ceil((max(high, low) - low) / (step * natural) - 1e-9) + 1)
        if count > MOST:
            raise InputError(
                f"step: {self.step:g} gives {count:g} frequencies from {low:.3g} to {high:.3g} Hz "
                f"at a natural frequency of {natural:.3g} Hz, but at most {MOST} are accepted; "
                "narrow the frequency range or raise step"
            )
        found: _Array = np.linspace(low, max(high, low), count)
        return found

    def worst(
        self, rigs: Sequence[Oscillator], workers: Workers, progress: Progress | None
    ) -> list[Worst]:
        """The worst that each rig does."""
        vectors = [engine_rig(Rig(rig, self.shaken)) for rig in rigs]
        starts = [engine_state(rig, equilibrium(rig)) for rig in rigs]
        batch.sweep.prepare(*vectors)
        for rig in rigs:
            self.frequencies(rig)  # refused before anything is computed

        def task(one: tuple[Oscillator, _Array, _Array], tally: Tally) -> Worst:
            found = _Search(self, *one, tally).worst()
            tally[0] = RIG
            return found

        return each(
            task,
            list(zip(rigs, vectors, starts, strict=True)),
            steps=len(rigs) * RIG,
            threads=workers,
            progress=progress and (lambda done, _: progress(done // RIG, len(rigs))),
        )


class _Search:
    """One rig swept coarsely, then finely about its largest displacement and acceleration."""

    def __init__(
        self, sines: Sines, rig: Oscillator, vector: _Array, start: _Array, tally: Tally
    ) -> None:
        self.tally = tally
        self.rig, self.vector, self.start = rig, vector, start
        self.amplitude = sines.shaken.amplitude
        self.phase = sines.shaken.phase
        self.grid = sines.frequencies(rig)
        high = float(self.grid[-1]) / rig.natural_frequency
        self.max_cycles = cycles(Rig(rig, sines.shaken), high, _LEAST_CYCLES)

    def worst(self) -> Worst:
        swept = [self._held(np.ascontiguousarray(self.grid[::way]), self.start) for way in (1, -1)]
        every = list(swept)
        for size in _SIZES:
            for about in _to_be_refined(swept, size):
                for _ in range(_LEVELS):
                    at = _top(size(about.rows))
                    if not about.rows.period[at]:
                        break  # no smooth curve goes through a motion that is not periodic
                    about = self._finer(about, at)
                    every.append(about)
        whole = _Holds(
            np.concatenate([one.frequency for one in every]),
            HoldRows(np.concatenate([one.rows.array for one in every])),
            np.concatenate([one.states for one in every]),
        )
        return self._seen(whole)

    def _held(self, frequency: _Array, start: _Array) -> _Holds:
        levels = np.full(len(frequency), self.amplitude)
        settling = Settling(_TOLERANCE, self.max_cycles, _WINDOW)
        rows, states = sweep_holds(
            self.vector, levels, frequency, self.phase, start, settling, self.tally
        )
        if self.tally[1]:
            raise Stopped
        return _Holds(frequency, rows, states)

    def _finer(self, held: _Holds, at: int) -> _Holds:
        """From the hold before the largest to the one after it, in the sweep's own direction."""
        first, last = max(at - 1, 0), min(at + 1, len(held.frequency) - 1)
        places = np.linspace(
            held.frequency[first], held.frequency[last], _FINER * (last - first) + 1
        )
        # The sweep carries on what it had reached there.
        sound = held.rows.status[first] in _SOUND
        return self._held(places, held.states[first] if sound else self.start)

    def _seen(self, held: _Holds) -> Worst:
        rows = held.rows
        size = rows.peak_displacement
        codes = judged(self.rig, rows.status, size)
        if np.isin(codes, _UNBOUNDED).any():
            beyond = (math.inf, math.inf, math.inf, np.full(2, math.inf))
            status = int(codes[np.isin(codes, _UNBOUNDED)][0])
            return Worst(*beyond, bool(self.rig.stops), math.nan, math.nan, 0, status)
        sound = np.isin(codes, _SOUND)
        if not sound.all():
            unknown = (math.nan, math.nan, math.nan, np.full(2, math.nan))
            return Worst(*unknown, False, math.nan, math.nan, 0, int(codes[~sound][0]))
        touching = (rows.impacts > 0.0).any(axis=-1)
        # What stays pressed all the time begins no contact.
        right, left = rows.displacement_max, -rows.displacement_min
        for stop, reached in ((self.rig.right, right), (self.rig.left, left)):
            if stop is not None:
                touching |= reached > stop.gap
        acceleration = rows.peak_acceleration
        return Worst(
            float(right.max()),
            float(left.max()),
            float(acceleration.max()),
            rows.peak_force.max(axis=0) * self.rig.mass,
            bool(touching.any()),
            float(held.frequency[size.argmax()]),
            float(held.frequency[acceleration.argmax()]),
            int((codes != Status.DONE).sum()),
            int(Status.DONE),
        )


def _to_be_refined(swept: list[_Holds], size: Callable[[HoldRows], _Array]) -> list[_Holds]:
    """The sweeps whose largest may be that of both; of two that are at one motion, one."""
    tops = [_top(size(one.rows)) for one in swept]
    values = [float(size(one.rows)[k]) for one, k in zip(swept, tops, strict=True)]
    places = [float(one.frequency[k]) for one, k in zip(swept, tops, strict=True)]
    if places[0] == places[1] and math.isclose(*values, rel_tol=_ALIKE):
        return swept[:1]
    return [one for one, value in zip(swept, values, strict=True) if not value < _FAR * max(values)]


def _top(size: _Array) -> int:
    """Where it is largest, of what is known."""
    return int(np.argmax(np.nan_to_num(size, nan=-1.0)))
