"""Free flight of isolators that have no closed form: swept backward, as the paper says.

What an isolator does by itself then depends on the amplitude and, where its resonance folds, on the
direction of the sweep. Along stable orbits the sweep goes as the curve of orbits does, which
`continuation.arclength` follows: without the wait for each motion to settle, which with a lightly
damped isolator takes 100,000 cycles. Where that curve ends, at a fold, at another loss of stability
or where orbits are not isolated, the next motion is that which the sweep itself settles on.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.continuation.arclength import distance, follow, predicted, strays, unit_tangent
from vibroimpact.continuation.zero import zero_within
from vibroimpact.engine import hold, orbit, section_map
from vibroimpact.engine import motion as layout
from vibroimpact.engine import parameters as par
from vibroimpact.engine.section_map import PARAMETER
from vibroimpact.engine.status import Status
from vibroimpact.model.equilibrium import equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_state, system_vector
from vibroimpact.response.hold_rows import HoldRows, Settling, sweep_holds

_Array = NDArray[np.float64]

_LEAST, _MOST = 0.02, 4.0  # of the natural frequency, where resonance is looked for at first
_WIDEST = 64.0
_FALLING = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -1.0])
"""Direction in which the frequency falls, and normal of the plane on which it does not change."""
_SEEN = np.array([1.0, 1.0, 0.0, 0.0, 0.0, 1.0])
"""Components by which lengths along the curve are measured: u, u̇ and the frequency."""
_PARTS = np.array([layout.U, layout.V, layout.ISOLATOR])
"""Of a state without stops, and where a point of the section's map holds them."""
_POINT = np.array([0, 1, 4])

_LARGE, _WIDE = 3.0, 2.0
"""Sizes that lengths are measured by, over the motion and the natural frequency."""
_CALLED = 64
"""Points after which sizes are taken anew: at a resonance the motion grows without measure."""
_NEUTRAL = 1e-9
"""Distance from 1 of the largest multiplier within which orbits are not isolated."""
_LONGEST, _SHORTEST = 0.1, 1e-6
"""Steps of a sweep, over the natural frequency; over the shortest a motion may jump."""
_JUMPS, _WANTED = 0.1, 0.03
"""Relative change of the excursion over a longer step that may be a jump, and the one aimed at."""
_LITTLE = 1e-6
"""The least such change that counts."""
_PATIENTLY, _SOON = Settling(1e-9, 2000, 64), Settling(1e-9, 32, 32)
"""How long a motion is waited for by itself, and beside the last one of a sweep."""
_MAX_EVENTS = 10_000
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
_SAME = 1e-8
"""Share of a step down to which the place of the largest motion is narrowed."""


class Held(NamedTuple):
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


@dataclass(frozen=True, eq=False)
class Station:
    """An orbit on the curve (see `continuation.arclength.Point`)."""

    y: _Array
    """The point of the section's map, and the frequency."""
    tangent: _Array
    arclength: float
    radius: float
    """Size of the largest multiplier."""
    held: Held


@dataclass(frozen=True, eq=False)
class Curve:
    """Orbits along the frequency (see `continuation.arclength.Path`).

    The amplitude changes along a straight line with the frequency.
    """

    base: _Array
    direction: _Array
    scale: _Array
    low: float
    """Frequency (Hz) at which it ends."""
    has_memory: bool
    """Whether the isolator remembers anything."""
    seen = _SEEN

    def corrected(
        self, aim: _Array, normal: _Array, before: Station | None = None
    ) -> Station | None:
        """The orbit that Newton's method finds on the plane through a point, if any."""
        point, facts = aim.copy(), np.zeros(section_map.FACTS)
        carried, slope = np.zeros((PARAMETER, PARAMETER)), np.zeros(PARAMETER)
        outcome = orbit.correct(
            self.base + aim[PARAMETER] * self.direction,
            self.base,
            self.direction,
            0.0,
            1,
            False,
            _MAX_EVENTS,
            self.scale,
            normal * _SEEN,
            point,
            facts,
            carried,
            slope,
        )
        if outcome != Status.DONE:
            return None
        system = self.base + point[PARAMETER] * self.direction
        results = np.full(hold.RESULTS, np.nan)
        outcome = orbit.measure_orbit(system, 0.0, point, facts, 1, _MAX_EVENTS, results)
        if outcome != Status.DONE:
            return None
        results[hold.PERIOD], results[hold.CYCLES], results[hold.OUTCOME] = 1, 0, Status.DONE
        state = np.zeros(layout.STATE)
        state[_PARTS] = point[_POINT]
        held = Held(float(point[PARAMETER]), HoldRows(results), state)
        sizes = self.scale[:PARAMETER]
        jacobian = np.empty((PARAMETER, section_map.POINT))
        jacobian[:, :PARAMETER] = carried.T * sizes / sizes[:, np.newaxis]
        jacobian[:, :PARAMETER] -= np.eye(PARAMETER)
        jacobian[:, PARAMETER] = slope * self.scale[PARAMETER] / sizes
        along = _FALLING if before is None else before.tangent
        parts = _POINT if self.has_memory else _POINT[:2]
        return Station(
            point,
            unit_tangent(jacobian, along, _SEEN),
            0.0 if before is None else before.arclength + distance(self, point, before.y),
            float(np.abs(np.linalg.eigvals(carried[np.ix_(parts, parts)])).max()),
            held,
        )

    def step(self, here: Station, length: float) -> tuple[Station | None, bool]:
        """See `Path`; no step goes beyond the end."""
        aim = predicted(self, here, length)
        if aim[PARAMETER] < self.low:
            return self.at(self.low, here), False
        found = self.corrected(aim, here.tangent, here)
        return (None if found is None or strays(self, found.y, aim, length) else found), False

    def from_(self, held: Held) -> Station | None:
        """The orbit that a motion has settled on, if it is one of the curve's."""
        if not self.scale[0] > 0.0:
            return None
        point = np.zeros(section_map.POINT)
        point[_POINT], point[PARAMETER] = held.state[_PARTS], held.frequency
        return self.corrected(point, _FALLING)

    def at(self, frequency: float, here: Station) -> Station | None:
        """The orbit at a frequency next to another orbit, if any."""
        length = (frequency - here.y[PARAMETER]) / (here.tangent[PARAMETER] * self.unit)
        aim = predicted(self, here, length)
        aim[PARAMETER] = frequency
        found = self.corrected(aim, _FALLING, here)
        return None if found is None or strays(self, found.y, aim, abs(length)) else found

    @property
    def unit(self) -> float:
        """Size of the frequency (Hz)."""
        return float(self.scale[PARAMETER])

    def corner(self, here: Station, length: float) -> list[Station]:
        """See `Path`: what a corner leads to, the sweep finds."""
        return []

    def elsewhere(self, here: Station) -> Station | None:
        """See `Path`."""
        return None

    def end(self, here: Station, there: Station) -> tuple[list[Station], str] | None:
        """See `Path`."""
        if there.radius > 1.0 - _NEUTRAL and here.radius > 1.0 - _NEUTRAL:
            return [], "orbits are not isolated"
        if there.tangent[PARAMETER] >= 0.0:
            found = zero_within(
                here,
                there.arclength - here.arclength,
                lambda length: self.step(here, length)[0],
                lambda one: float(one.tangent[PARAMETER]),
            )
            return [found[0]] if found else [], "it turns back"
        if there.radius > 1.0 + _NEUTRAL:
            return [], "it loses its stability"
        if there.y[PARAMETER] > self.low:
            return None
        last = there if there.y[PARAMETER] == self.low else self.at(self.low, here)
        return [] if last is None else [last], "the range ends"

    def lost(self, here: Station) -> str:
        """See `Path`."""
        return "no orbit is found"


class Flight(NamedTuple):
    """What flies, and how hard it is shaken at a frequency."""

    rig: Rig
    """Without stops."""
    system: _Array
    level: Callable[[float], float]

    def swept(
        self, begin: _Array, frequencies: Sequence[float], settling: Settling = _SOON
    ) -> list[Held]:
        """One motion after the other, each waited for, from a state."""
        levels = np.array([self.level(frequency) for frequency in frequencies])
        rows, states = sweep_holds(self.system, levels, np.array(frequencies), 0.0, begin, settling)
        return [Held(frequencies[k], rows[k], states[k]) for k in range(len(rows))]

    def settled(self, begin: _Array, frequency: float) -> Held:
        """What a motion settles on by itself; where it is slow, the stable orbit nearby, if any.

        A free isolator whose damping vanishes with the motion takes longer than any patience.
        """
        (held,) = self.swept(begin, [frequency], _PATIENTLY)
        if held.row.status != Status.NOT_SETTLED:
            return held
        found = self.curve(held, frequency).from_(held)
        return held if found is None or found.radius > 1.0 + _NEUTRAL else found.held

    def curve(self, last: Held, low: float) -> Curve:
        """The curve of orbits from a motion down to a frequency, if it is on one."""
        high, parameter = last.frequency, section_map.PARAMETER
        rise = (self.level(high) - self.level(low)) / (high - low) if high > low else 0.0
        base, direction = self.system.copy(), np.zeros_like(self.system)
        base[section_map.AMPLITUDE] = self.level(high) - rise * high
        base[section_map.FREQUENCY] = 0.0
        direction[section_map.AMPLITUDE], direction[section_map.FREQUENCY] = rise, 1.0
        rate = math.tau * high
        size = max(abs(float(last.state[layout.U])), abs(float(last.state[layout.V])) / rate)
        scale = _LARGE * np.array([size, size * rate, size, size, size, 0.0])
        scale[parameter] = _WIDE * self.rig.oscillator.natural_frequency
        return Curve(base, direction, scale, low, bool(self.system[par.HYSTERETIC]))

    def orbits(self, last: Held, low: float) -> Iterator[Held]:
        """The stable orbits that continue a motion as the frequency falls, as far as they do."""
        while last.is_single and last.frequency > low:
            curve = self.curve(last, low)
            first = curve.from_(last)
            if first is None or first.radius > 1.0 - _NEUTRAL:
                return
            trace = follow(curve, first, _CALLED)
            for station in trace.points[1:]:
                yield station.held
            if trace.is_complete:
                return
            last = trace.points[-1].held

    def backward(self, last: Held, low: float) -> Iterator[Held]:
        """The motions at falling frequencies, down to the one at `low` (Hz), which is the last."""
        unit = self.rig.oscillator.natural_frequency
        step = _LONGEST * unit
        while last.frequency > low:
            for held in self.orbits(last, low):
                last = held
                yield held
            if last.frequency <= low:
                return
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

    def from_rest(self, frequency: float) -> Held:
        """Where the motion from rest settles."""
        return self.settled(self.rest, frequency)

    @property
    def rest(self) -> _Array:
        """The state at rest."""
        oscillator = self.rig.oscillator
        return engine_state(oscillator, equilibrium(oscillator))


def flight(rig: Rig, level: Callable[[float], float]) -> Flight:
    """Prepare a rig, whose stops are left out, shaken from phase 0."""
    free, shaken = rig.oscillator.without_bumpers(), rig.periodic
    return Flight(Rig(free, shaken), system_vector(Rig(free, shaken.replace(phase=0.0))), level)


def _changed(found: Held, last: Held) -> float:
    """How much the swing has changed, over the larger one."""
    before, after = (float(one.row.displacement_excursion) for one in (last, found))
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
    found = one.swept(one.rest, falling)
    if not all(held.row.status == Status.DONE for held in found):
        # What settles slowly is not waited for.
        found = [one.from_rest(falling[0])]
        for frequency in falling[1:]:
            *_, last = one.backward(found[-1], frequency)
            found.append(last)
    return _excursions(found[::-1])


def _excursions(found: list[Held]) -> _Array:
    rows = HoldRows(np.array([one.row.array for one in found]))
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
        found = [one.from_rest(high * unit)]
        found.extend(one.backward(found[0], _LEAST * unit))
        curves = _excursions(found)
        if np.all(np.isnan(curves)):
            return math.nan, math.nan, math.nan
        top = found[int(np.nanargmax(curves[0]))].frequency
        if top < 0.98 * high * unit or high >= _WIDEST:
            break
        high *= 2.0
    largest = _top(one, found, curves, 0)
    fastest = largest if shaken.grows_with_frequency else _top(one, found, curves, 1)
    swing, acceleration = (
        float(_excursions([top])[which, 0]) for which, top in enumerate((largest, fastest))
    )
    if not swing > 0.0:
        return math.nan, math.nan, math.nan
    return swing, acceleration, largest.frequency


def _top(one: Flight, found: list[Held], curves: _Array, which: int) -> Held:
    """The motion of the largest excursion, between the motions beside the largest that was found.

    The frequencies fall. Narrowed by golden sections; where the largest stands at a fold there is
    no orbit on its far side, and the near one is closed in on.
    """
    k = int(np.nanargmax(curves[which]))
    best, most = found[k], float(curves[which, k])
    curve = one.curve(best, best.frequency)
    about = curve.from_(best)
    if about is None:
        return best
    low = found[min(k + 1, len(found) - 1)].frequency
    high = found[max(k - 1, 0)].frequency

    def at(frequency: float) -> float:
        nonlocal best, most
        reached = curve.at(frequency, about)
        if reached is None or reached.radius > 1.0 + _NEUTRAL:
            return -math.inf
        value = float(_excursions([reached.held])[which, 0])
        if value > most:
            best, most = reached.held, value
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
