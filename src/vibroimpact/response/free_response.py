"""Free flight of isolators that have no closed form: swept backward, as the paper says.

What an isolator does by itself then depends on the amplitude and, where its resonance folds, on the
direction of the sweep: each motion begins with the last one, and steps are short where it changes.
Newton's method finds what does not settle, as a lightly damped isolator would need 100,000 cycles.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import orbit, section_map, steady_response
from vibroimpact.engine import parameters as par
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.engine.status import Status
from vibroimpact.model.equilibrium import equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_state, section_numbers
from vibroimpact.response.hold_rows import MAX_EVENTS, HoldRows, Settling, sweep_holds

_Array = NDArray[np.float64]

_LEAST, _MOST = 0.02, 4.0  # of the natural frequency, where resonance is looked for at first
_WIDEST = 64.0
_PARTS, _POINT = (
    np.array([parts.displacement(), parts.velocity(), parts.memory()])
    for parts in (ONE_MASS, ONE_MASS.of_point)
)
"""Of a state without stops, and where a point of the section's map holds them."""
_HELD = np.array([*[0.0] * ONE_MASS.total, 1.0])
"""Normal of the plane on which the frequency does not change."""
_STABLE = 1.0 + 1e-9
"""Largest multiplier of an orbit on which a motion stays."""
_LONGEST, _SHORTEST = 0.1, 1e-6
"""Steps of the sweep itself, over the natural frequency; over the shortest a motion may jump."""
_JUMPS, _WANTED = 0.1, 0.03
"""Relative change of the excursion over a longer step that may be a jump, and the one aimed at."""
_LITTLE = 1e-6
"""The least such change that counts."""
_PATIENTLY = Settling(1e-9, 200, 64), Settling(1e-9, 2000, 64)
"""How long a motion is waited for by itself, before Newton's method and where that finds none."""
_SOON = Settling(1e-9, 32, 32)
"""How long where it is expected."""
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
_SAME = 1e-8
"""Width, over the frequency, down to which the place of the largest motion is narrowed."""


class FreeMotion(NamedTuple):
    """The motion at one frequency."""

    frequency: float
    row: HoldRows
    """What was measured of it."""
    state: _Array
    """Of the engine, at the section."""

    @property
    def is_single(self) -> bool:
        """Whether it repeats after one cycle."""
        return bool(self.row.status == Status.DONE and self.row.period == 1)

    @property
    def size(self) -> float:
        """Of the displacement (m)."""
        u, v, _ = np.abs(self.state[_PARTS])
        return max(float(u), float(v) / (math.tau * self.frequency))


class Flight(NamedTuple):
    """What flies, and how hard it is shaken at a frequency."""

    rig: Rig
    """Without stops."""
    system: _Array
    level: Callable[[float], float]

    @property
    def rest(self) -> _Array:
        """The state at rest."""
        oscillator = self.rig.oscillator
        return engine_state(oscillator, equilibrium(oscillator))

    def swept(
        self, begin: _Array, frequencies: Sequence[float], settling: Settling = _SOON
    ) -> list[FreeMotion]:
        """One motion after the other, each waited for, from a state."""
        levels = np.array([self.level(frequency) for frequency in frequencies])
        rows, states = sweep_holds(self.system, levels, np.array(frequencies), 0.0, begin, settling)
        return [FreeMotion(frequencies[k], rows[k], states[k]) for k in range(len(rows))]

    def beside(self, near: _Array, frequency: float) -> FreeMotion | None:
        """The stable orbit near a state, if any."""
        (held,) = self.swept(near, [frequency])
        return held if held.is_single else self.orbit(near, frequency)

    def settled(self, begin: _Array, frequency: float) -> FreeMotion:
        """What a motion settles on by itself; where it is slow, the stable orbit nearby, if any.

        A free isolator whose damping vanishes with the motion takes longer than any patience.
        """
        for settling in _PATIENTLY:
            (held,) = self.swept(begin, [frequency], settling)
            if held.row.status != Status.NOT_SETTLED:
                break
            if (motion := self.orbit(held.state, frequency)) is not None:
                return motion
            begin = held.state
        return held

    def orbit(self, near: _Array, frequency: float) -> FreeMotion | None:
        """The stable orbit that Newton's method finds from a state, if any."""
        system = self.system.copy()
        system[section_map.AMPLITUDE] = self.level(frequency)
        system[section_map.FREQUENCY] = frequency
        size = FreeMotion(frequency, HoldRows.empty(), near).size
        scale = np.array([size, size * math.tau * frequency, size, size, size, 1.0])
        point = np.zeros(ONE_MASS.total + 1)
        facts = np.zeros(section_map.CONTACTS + ONE_MASS.stops)
        point[_POINT] = near[_PARTS]
        carried = np.zeros((ONE_MASS.total, ONE_MASS.total))
        outcome = orbit.correct(
            system,
            system,
            np.zeros_like(system),
            0.0,
            1,
            False,
            MAX_EVENTS,
            scale,
            _HELD,
            point,
            facts,
            carried,
            np.zeros(ONE_MASS.total),
        )
        if outcome != Status.DONE:
            return None
        parts = _POINT if system[par.HYSTERETIC] else _POINT[:2]
        if np.abs(np.linalg.eigvals(carried[np.ix_(parts, parts)])).max() > _STABLE:
            return None
        results = np.full(steady_response.RESULTS, np.nan)
        outcome = orbit.measure_orbit(system, 0.0, point, facts, 1, MAX_EVENTS, results)
        if outcome != Status.DONE:
            return None
        (
            results[steady_response.PERIOD],
            results[steady_response.CYCLES],
            results[steady_response.OUTCOME],
        ) = 1, 0, Status.DONE
        state = np.zeros(ONE_MASS.width)
        state[_PARTS] = point[_POINT]
        return FreeMotion(frequency, HoldRows(results), state)

    def backward(self, last: FreeMotion, low: float) -> Iterator[FreeMotion]:
        """The motions at falling frequencies, down to the one at `low` (Hz), which is the last."""
        unit = self.rig.oscillator.natural_frequency
        step = _LONGEST * unit
        while last.frequency > low:
            while True:
                held = self.settled(last.state, max(low, last.frequency - step))
                change = max(_changed(held, last), _LITTLE)
                if change <= _JUMPS or step <= _SHORTEST * unit or not last.is_single:
                    break
                step = max(step / 4.0, _SHORTEST * unit)
            last = held
            yield last
            step *= min(2.0, math.sqrt(_WANTED / change))
            step = min(max(step, _SHORTEST * unit), _LONGEST * unit)


def flight(rig: Rig, level: Callable[[float], float]) -> Flight:
    """Prepare a rig, whose stops are left out, shaken from phase 0."""
    free, shaken = rig.oscillator.without_bumpers(), rig.periodic
    return Flight(Rig(free, shaken), section_numbers(free, shaken.replace(phase=0.0)), level)


def _changed(motion: FreeMotion, last: FreeMotion) -> float:
    """How much the swing has changed, over the larger one."""
    before, after = (float(one.row.displacement_excursion) for one in (last, motion))
    return abs(after - before) / max(after, before) if max(after, before) > 0.0 else 0.0


def swept_flight(rig: Rig, frequencies: _Array, levels: _Array) -> _Array:
    """Excursions in free flight, as in `sweep_arrays.SweepPlan`.

    Parameters
    ----------
    frequencies, levels
        Rising frequencies (Hz), and the amplitude at each.

    Returns
    -------
    ndarray, shape (3, frequency)
        Of a backward sweep; NaN where the motion does not settle.
    """

    def level(frequency: float) -> float:
        return float(np.interp(frequency, frequencies, levels))

    one = flight(rig, level)
    falling = [float(frequency) for frequency in frequencies[::-1]]
    holds = one.swept(one.rest, falling)
    if not all(held.row.status == Status.DONE for held in holds):
        # What settles slowly is not waited for.
        holds = [one.settled(one.rest, falling[0])]
        for frequency in falling[1:]:
            *_, last = one.backward(holds[-1], frequency)
            holds.append(last)
    return _excursions(holds[::-1])


def _excursions(holds: list[FreeMotion]) -> _Array:
    rows = HoldRows(np.array([one.row.array for one in holds]))
    excursions = np.array(
        [rows.displacement_excursion, rows.acceleration_excursion, rows.transmitted_excursion]
    )
    excursions[:, rows.status != Status.DONE] = np.nan
    return excursions


def largest_flight(rig: Rig) -> tuple[float, float]:
    """Excursions (m, m/s²) of the largest free flight of a backward sweep, each at its own place.

    Where the excitation grows as ω², the acceleration does too: it is that of the largest
    displacement. Both are NaN where no free flight settles, or none moves.
    """
    swing, acceleration, _ = _peaks(rig)
    return swing, acceleration


def resonance(rig: Rig) -> float:
    """Frequency (Hz) at which the displacement of that free flight is largest; or NaN."""
    return _peaks(rig)[2]


def _peaks(rig: Rig) -> tuple[float, float, float]:
    oscillator, shaken = rig.oscillator, rig.periodic
    key = shaken.replace(frequency=oscillator.natural_frequency, phase=0.0)
    return _largest(Rig(oscillator.without_bumpers(), key))


@lru_cache(maxsize=256)
def _largest(rig: Rig) -> tuple[float, float, float]:
    shaken, unit = rig.periodic, rig.oscillator.natural_frequency
    one = flight(rig, lambda _: shaken.amplitude)
    high = _MOST
    while True:
        holds = [one.settled(one.rest, high * unit)]
        holds.extend(one.backward(holds[0], _LEAST * unit))
        curves = _excursions(holds)
        if np.all(np.isnan(curves)):
            return math.nan, math.nan, math.nan
        top = holds[int(np.nanargmax(curves[0]))].frequency
        if top < 0.98 * high * unit or high >= _WIDEST:
            break
        high *= 2.0
    largest = _top(one, holds, curves, 0)
    fastest = largest if shaken.grows_with_frequency else _top(one, holds, curves, 1)
    swing, acceleration = (
        float(_excursions([top])[which, 0]) for which, top in enumerate((largest, fastest))
    )
    if not swing > 0.0:
        return math.nan, math.nan, math.nan
    return swing, acceleration, largest.frequency


def _top(one: Flight, holds: list[FreeMotion], curves: _Array, which: int) -> FreeMotion:
    """The motion of the largest excursion, between the motions beside the largest that was found.

    The frequencies fall. Narrowed by golden sections; where the largest stands at a fold there is
    no orbit on its far side, and the near one is closed in on.
    """
    k = int(np.nanargmax(curves[which]))
    best, most = holds[k], float(curves[which, k])
    if not best.is_single:
        return best
    low = holds[min(k + 1, len(holds) - 1)].frequency
    high = holds[max(k - 1, 0)].frequency

    def at(frequency: float) -> float:
        nonlocal best, most
        reached = one.beside(best.state, frequency)
        if reached is None or _changed(reached, best) > _JUMPS:
            return -math.inf
        value = float(_excursions([reached])[which, 0])
        if value > most:
            best, most = reached, value
        return value

    left, right = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    values = at(left), at(right)
    while high - low > _SAME * best.frequency:
        if values[0] > values[1]:
            high, right = right, left
            left = high - _GOLDEN * (high - low)
            values = at(left), values[0]
        else:
            low, left = left, right
            right = low + _GOLDEN * (high - low)
            values = values[1], at(right)
    return best
