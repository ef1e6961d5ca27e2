"""Free flight along a falling frequency: from orbit to orbit by Newton's method.

It is what a backward sweep does that waits until each motion has settled, without the wait: a
lightly damped isolator needs 100,000 cycles. Where there is no stable orbit beside the last one,
the motion is followed from there until it settles, as the sweep would.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import hold, orbit, section_map
from vibroimpact.engine import motion as layout
from vibroimpact.engine.status import Status
from vibroimpact.model import Oscillator
from vibroimpact.model.equilibrium import equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_state, system_vector
from vibroimpact.response.hold_rows import HoldRows, Settling, sweep_holds
from vibroimpact.response.prepared_rig import PreparedRig

_Array = NDArray[np.float64]

_HELD = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
"""Normal of the plane on which the frequency does not change."""
_PARTS = np.array([layout.U, layout.V, layout.ISOLATOR])
"""Of a state without stops, and where a point of the section's map holds them."""
_POINT = np.array([0, 1, 4])

_MISSED = 0.1
"""Of the motion's size: an orbit farther from where it was expected may be another one."""
_WANTED = 0.03
"""The same, which the next step aims at."""
_LONGEST, _SHORTEST = 0.1, 1e-6
"""Steps of the frequency, over the natural one; a shorter step finds no orbit: it ends there."""
_WARY = 8
"""Orbits to be found one after the other before they are taken to be isolated again."""
_LEAST = 1e-6
"""The same, where nothing is known."""
_STABLE = 1.0 + 1e-9
"""Largest multiplier of an orbit on which a motion stays."""
_PATIENTLY, SOON = 2000, 32
"""Cycles in which a motion should settle by itself, and beside where it is expected."""
_WINDOW = 64
"""Cycles over which one that does not settle is measured."""
_TOLERANCE = 1e-9
_MAX_EVENTS = 10_000


class Held(NamedTuple):
    """The motion at one frequency."""

    frequency: float
    row: HoldRows
    """What was measured of it."""
    state: _Array
    """Of the engine, at the section."""

    @property
    def single(self) -> bool:
        """Whether it repeats after one cycle."""
        return bool(self.row.status == Status.DONE and self.row.period == 1)


class Flight(NamedTuple):
    """What flies, and how hard it is shaken at a frequency."""

    rig: Rig
    system: _Array
    level: Callable[[float], float]

    @property
    def oscillator(self) -> Oscillator:
        """What vibrates."""
        return self.rig.oscillator


def flight(rig: Rig, level: Callable[[float], float]) -> Flight:
    """Prepare a rig without stops, shaken from phase 0."""
    still = Rig(rig.oscillator, rig.periodic.replace(phase=0.0))
    return Flight(rig, system_vector(still), level)


def from_rest(one: Flight, frequency: float) -> Held:
    """Where the motion from rest settles."""
    begin = engine_state(one.oscillator, equilibrium(one.oscillator))
    return _ended(one, _settled(one, begin, frequency, _PATIENTLY))


def backward(one: Flight, last: Held, low: float) -> Iterator[Held]:
    """The motions at falling frequencies, down to the one at `low` (Hz), which is the last."""
    unit = one.oscillator.natural_frequency
    past = [last]
    step, alone = _LONGEST * unit, 0
    while last.frequency > low:
        there = max(low, last.frequency - step)
        found = beside(one, past, there) if last.single else None
        if found is None and (alone or not last.single or step <= _SHORTEST * unit):
            # A fold, or no isolated orbit: what the motion does next, it does by itself.
            held = _ended(one, _settled(one, last.state, there, _PATIENTLY))
            missed = max(_changed(held, last), _LEAST)
            if missed <= _MISSED or not last.single or step <= _SHORTEST * unit:
                alone, past = _WARY if missed <= _MISSED else 0, []
                found = held, missed if alone else _WANTED
        elif found is not None:
            alone = max(alone - 1, 0)
        if found is None:
            step = max(step / 4.0, _SHORTEST * unit)
            continue
        last, missed = found
        past = [*past[-1:], last]
        step *= min(2.0, math.sqrt(_WANTED / missed))
        step = min(max(step, _SHORTEST * unit), _LONGEST * unit)
        yield last


def beside(one: Flight, past: Sequence[Held], frequency: float) -> tuple[Held, float] | None:
    """The stable orbit at another frequency that continues the last ones, if any.

    Returns
    -------
    held, missed
        And how far it was from where it was expected, over its size.
    """
    *before, last = past
    expected = last.state.copy()
    for one_before in before:  # the line through both
        share = (frequency - last.frequency) / (last.frequency - one_before.frequency)
        expected += share * (last.state - one_before.state)
    if not _size(expected, frequency) > 0.0:
        return None
    for found in (_settled(one, expected, frequency, SOON), _corrected(one, expected, frequency)):
        if found is not None and found.single:
            missed = _apart(found, expected)
            return (found, max(missed, _LEAST)) if missed <= _MISSED else None
    return None


def _apart(found: Held, expected: _Array) -> float:
    """How far a motion is from a state, over its size."""
    size = max(_size(found.state, found.frequency), _size(expected, found.frequency))
    away = np.abs(found.state - expected)[_PARTS] / [1.0, math.tau * found.frequency, 1.0]
    return float(away.max()) / size if size > 0.0 else 0.0


def _changed(found: Held, last: Held) -> float:
    """How much the swing has changed, over the larger one.

    Where orbits are not isolated, a state says nothing.
    """
    before, after = (float(one.row.displacement_excursion) for one in (last, found))
    return abs(after - before) / max(after, before) if max(after, before) > 0.0 else 0.0


def _size(state: _Array, frequency: float) -> float:
    return max(abs(float(state[layout.U])), abs(float(state[layout.V])) / (math.tau * frequency))


def _ended(one: Flight, held: Held) -> Held:
    """Where a motion that has not settled would end: on the stable orbit nearby, if there is one.

    A free isolator whose damping vanishes with the motion takes longer than any patience.
    """
    if held.row.status != Status.NOT_SETTLED:
        return held
    return _corrected(one, held.state, held.frequency) or held


def _corrected(one: Flight, near: _Array, frequency: float) -> Held | None:
    """The stable orbit that Newton's method finds from a state, if any."""
    system = one.system.copy()
    system[section_map.AMPLITUDE] = one.level(frequency)
    system[section_map.FREQUENCY] = frequency
    size = _size(near, frequency)
    scale = np.array([size, size * math.tau * frequency, size, size, size, 1.0])
    point = np.zeros(section_map.POINT)
    point[_POINT] = near[_PARTS]
    facts = np.zeros(section_map.FACTS)
    carried = np.zeros((section_map.PARAMETER, section_map.PARAMETER))
    outcome = orbit.correct(
        system,
        system,
        np.zeros_like(system),
        0.0,
        1,
        False,
        _MAX_EVENTS,
        scale,
        _HELD,
        point,
        facts,
        carried,
        np.zeros(section_map.PARAMETER),
    )
    if outcome != Status.DONE:
        return None
    if np.abs(np.linalg.eigvals(carried[np.ix_(_POINT, _POINT)])).max() > _STABLE:
        return None
    results = np.full(hold.RESULTS, np.nan)
    outcome = orbit.measure_orbit(system, 0.0, point, facts, 1, _MAX_EVENTS, results)
    if outcome != Status.DONE:
        return None
    results[hold.PERIOD], results[hold.CYCLES], results[hold.OUTCOME] = 1, 0, Status.DONE
    state = np.zeros(layout.STATE)
    state[_PARTS] = point[_POINT]
    return Held(frequency, HoldRows(results), state)


def _settled(one: Flight, begin: _Array, frequency: float, cycles: int) -> Held:
    """What the motion from a state does after so many cycles at most."""
    if cycles == SOON:
        return swept(one, begin, [frequency])[0]
    here = one.rig.periodic.replace(amplitude=one.level(frequency), frequency=frequency, phase=0.0)
    engine = PreparedRig(Rig(one.oscillator, here), one.system)
    row, reached = engine.dwell(begin, Settling(_TOLERANCE, cycles, _WINDOW, _MAX_EVENTS))
    return Held(frequency, row, reached)


def swept(one: Flight, begin: _Array, frequencies: Sequence[float]) -> list[Held]:
    """One motion after the other, each waited for a few cycles, from a state."""
    levels = np.array([one.level(frequency) for frequency in frequencies])
    settling = Settling(_TOLERANCE, SOON, SOON)
    rows, states = sweep_holds(one.system, levels, np.array(frequencies), 0.0, begin, settling)
    return [Held(frequencies[k], rows[k], states[k]) for k in range(len(rows))]
