"""Free flight of isolators that have no closed form: swept backward, as the paper says.

What an isolator does by itself then depends on the amplitude and, where its resonance folds, on
the direction of the sweep.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.status import Status
from vibroimpact.model.equilibrium import equilibrium
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.free_response_branch import (
    Flight,
    Held,
    backward,
    beside,
    flight,
    from_rest,
    swept,
)
from vibroimpact.response.hold_rows import HoldRows

_Array = NDArray[np.float64]

_LEAST, _MOST = 0.02, 4.0  # of the natural frequency, where resonance is looked for at first
_WIDEST = 64.0
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
_SAME = 1e-8
"""Width, over the frequency, down to which the place of the largest motion is narrowed."""


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
    oscillator, shaken = rig.oscillator, rig.periodic

    def level(frequency: float) -> float:
        return float(np.interp(frequency, frequencies, levels))

    one = flight(Rig(oscillator.without_bumpers(), shaken), level)
    falling = [float(frequency) for frequency in frequencies[::-1]]
    begin = engine_state(one.oscillator, equilibrium(one.oscillator))
    found = swept(one, begin, falling)
    if not all(held.row.status == Status.DONE for held in found):
        # What settles slowly is not waited for.
        found = [from_rest(one, falling[0])]
        for frequency in falling[1:]:
            *_, last = backward(one, found[-1], frequency)
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
    free, shaken = rig.oscillator, rig.periodic
    unit = free.natural_frequency
    one = flight(rig, lambda _: shaken.amplitude)
    high = _MOST
    while True:
        found = [from_rest(one, high * unit)]
        found.extend(backward(one, found[0], _LEAST * unit))
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
    if not best.single:
        return best
    low = found[min(k + 1, len(found) - 1)].frequency
    high = found[max(k - 1, 0)].frequency

    def at(frequency: float) -> float:
        nonlocal best, most
        reached = beside(one, [best], frequency)
        if reached is None:
            return -math.inf
        value = float(_excursions([reached[0]])[which, 0])
        if value > most:
            best, most = reached[0], value
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
