"""The worst of sines: what rigs do steadily over a range of frequencies, swept both ways."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic
from vibroimpact.model.rig import Rig, one_mass_only, several_masses_only
from vibroimpact.model.system import System
from vibroimpact.response.engine_system import engine_rig, engine_system
from vibroimpact.response.hold_rows import HoldRows, Settling, sweep_holds
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
_TOLERANCE = 1e-9
_LEAST_CYCLES, _WINDOW = 300, 100
_CYCLES_OF_ASSEMBLIES = 2000
_SOUND = (int(Status.DONE), int(Status.NOT_SETTLED))
_UNBOUNDED = (int(Status.NOT_FINITE), int(Status.REVERSED))


class Worst(NamedTuple):
    """What is the largest over all frequencies and both directions, in SI units.

    Values of a mass are plain numbers of an oscillator, and have a value for each mass of an
    assembly.
    """

    right: _Array
    """Displacement, to the right."""
    left: _Array
    acceleration: _Array
    force: _Array
    """Of each stop; of an oscillator of the right and the left one."""
    hits: bool
    displacement_frequency: _Array
    """Where the displacement is largest, to either side (Hz)."""
    acceleration_frequency: _Array
    unsettled: int
    """Holds at which no periodic motion was reached."""
    status: int


class _Holds(NamedTuple):
    """Frequencies in the order in which they were held, with the results."""

    frequency: _Array
    rows: HoldRows
    states: _Array


class _Measured(NamedTuple):
    """What was measured of holds, in SI units, shape (hold,) or (hold, part)."""

    most: _Array
    """Largest displacement."""
    least: _Array
    acceleration: _Array
    force: _Array
    touched: NDArray[np.bool_]

    @property
    def displacement(self) -> _Array:
        """To either side."""
        return np.maximum(np.abs(self.most), np.abs(self.least))

    @property
    def sizes(self) -> _Array:
        """By which the largest response is sought, shape (size, hold)."""
        count = len(self.touched)
        both = [one.reshape(count, -1).T for one in (self.displacement, self.acceleration)]
        return np.concatenate(both)


def _measured(system: System, rows: HoldRows) -> _Measured:
    if system.by_mass:
        measured = engine_system(system).measured(rows.array, ())
        variables = {name: v for name, (_, v) in measured.items()}
        force = variables["peak_force"]
        return _Measured(
            variables["displacement_max"],
            variables["displacement_min"],
            variables["peak_acceleration"],
            force,
            np.asarray((force > 0.0).any(axis=-1)),
        )
    touched = np.asarray((rows.impacts > 0.0).any(axis=-1))
    # What stays pressed all the time begins no contact.
    reached = {"right": rows.displacement_max, "left": -rows.displacement_min}
    for side, stop in system.stop_laws.items():
        touched |= reached[side] > stop.gap
    force = rows.peak_force * engine_system(system).largest_mass
    return _Measured(
        rows.displacement_max, rows.displacement_min, rows.peak_acceleration, force, touched
    )


class Sines(NamedTuple):
    """Sines of one size over a range of frequencies."""

    shaken: Harmonic
    low: float | None = None
    """Lowest frequency (Hz); None for that at which scenarios begin, of each rig."""
    high: float | None = None
    """Highest frequency (Hz); None for one that is beyond the primary resonance of each rig."""
    step: float = STEP

    def frequencies(self, rig: System) -> _Array:
        """The frequencies of the coarse sweep (Hz).

        Raises
        ------
        InputError
            If they are too many, or if the range for an assembly is missing.
        """
        natural = rig.angular_frequency / math.tau
        step = self.step
        if rig.by_mass:
            if self.low is None or self.high is None:
                raise InputError(
                    "vary: 'frequency' is missing; an Assembly has several resonances, so pass its "
                    "lowest and its highest value as (low, high)"
                )
            low, high, natural = self.low, self.high, natural or self.low
            ratios = several_masses_only(rig).damping_ratios
            damping = float(np.min(ratios[ratios > 0.0], initial=1.0))
        else:
            low = LOW * natural if self.low is None else self.low
            high = highest(Rig(rig, self.shaken)) * natural if self.high is None else self.high
            oscillator = one_mass_only(rig)
            damping = oscillator.damping_ratio if oscillator.isolator.linear else 0.0
        if damping > 0.0:
            step = min(step, max(_PEAK * damping, 0.1 * step))
        count = max(2, math.ceil((max(high, low) - low) / (step * natural) - 1e-9) + 1)
        if count > MOST:
            raise InputError(
                f"step: {self.step:g} gives {count:g} frequencies from {low:.3g} to {high:.3g} Hz "
                f"at a natural frequency of {natural:.3g} Hz, more than {MOST}; "
                "narrow the frequency range or raise step"
            )
        return np.linspace(low, max(high, low), count)

    def worst(
        self, rigs: Sequence[System], workers: Workers, progress: Progress | None
    ) -> list[Worst]:
        """The worst that each rig does."""
        vectors = [engine_rig(Rig(rig, self.shaken)) for rig in rigs]
        states = [engine_system(rig) for rig in rigs]
        starts = [one.vector_of(one.read(None)) for one in states]
        batch.sweep.prepare(*vectors)
        for rig in rigs:
            self.frequencies(rig)  # refused before anything is computed

        def task(one: tuple[System, _Array, _Array], tally: Tally) -> Worst:
            worst_case = _Search(self, *one, tally).worst()
            tally[0] = RIG
            return worst_case

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
        self, sines: Sines, rig: System, vector: _Array, start: _Array, tally: Tally
    ) -> None:
        self.tally = tally
        self.rig, self.vector, self.start = rig, vector, start
        self.amplitude = sines.shaken.amplitude
        self.phase = sines.shaken.phase
        self.grid = sines.frequencies(rig)
        self.max_cycles = _CYCLES_OF_ASSEMBLIES
        if not rig.by_mass:
            high = float(self.grid[-1]) / one_mass_only(rig).natural_frequency
            self.max_cycles = cycles(Rig(rig, sines.shaken), high, _LEAST_CYCLES)

    def worst(self) -> Worst:
        swept = [self._held(np.ascontiguousarray(self.grid[::way]), self.start) for way in (1, -1)]
        every = list(swept)
        for k in range(len(self._sizes(swept[0]))):
            for about in _to_be_refined(swept, [self._sizes(one)[k] for one in swept]):
                for _ in range(_LEVELS):
                    at = _top(self._sizes(about)[k])
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

    def _sizes(self, held: _Holds) -> _Array:
        return _measured(self.rig, held.rows).sizes

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
        rows, measures = held.rows, _measured(self.rig, held.rows)
        codes = engine_system(self.rig).judged(rows.status, measures.displacement)
        bad = codes[np.isin(codes, _UNBOUNDED)]
        sound = np.isin(codes, _SOUND)
        if len(bad) or not sound.all():
            status = int(bad[0] if len(bad) else codes[~sound][0])
            value = math.inf if len(bad) else math.nan
            of_mass = np.full_like(measures.acceleration[0], value)
            nowhere = np.full_like(of_mass, math.nan)
            force = np.full_like(measures.force[0], value)
            hits = bool(len(bad) and self.rig.stops)
            return Worst(of_mass, of_mass, of_mass, force, hits, nowhere, nowhere, 0, status)
        return Worst(
            measures.most.max(axis=0),
            (-measures.least).max(axis=0),
            measures.acceleration.max(axis=0),
            measures.force.max(axis=0),
            bool(measures.touched.any()),
            held.frequency[measures.displacement.argmax(axis=0)],
            held.frequency[measures.acceleration.argmax(axis=0)],
            int((codes != Status.DONE).sum()),
            int(Status.DONE),
        )


def _to_be_refined(swept: list[_Holds], sizes: list[_Array]) -> list[_Holds]:
    """The sweeps whose largest may be that of both; of two that are at one motion, one."""
    tops = [_top(one) for one in sizes]
    values = [float(one[k]) for one, k in zip(sizes, tops, strict=True)]
    places = [float(one.frequency[k]) for one, k in zip(swept, tops, strict=True)]
    if places[0] == places[1] and math.isclose(*values, rel_tol=_ALIKE):
        return swept[:1]
    return [one for one, value in zip(swept, values, strict=True) if not value < _FAR * max(values)]


def _top(size: _Array) -> int:
    """Where it is largest, of what is known."""
    return int(np.argmax(np.nan_to_num(size, nan=-1.0)))
