"""Free flight of isolators that have no closed form: swept backward, as the paper says.

What an isolator does by itself then depends on the amplitude and, where its resonance folds, on
the direction of the sweep.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch, hold
from vibroimpact.engine import motion as layout
from vibroimpact.engine.status import Status
from vibroimpact.model import Oscillator, Repeated
from vibroimpact.model.equilibrium import equilibrium
from vibroimpact.response.start import engine_rig, engine_state

_Array = NDArray[np.float64]

_STEP = 0.02  # of the natural frequency of small motions, first
_FINER = 20  # times, twice about the largest
_LEAST, _MOST = 0.02, 4.0  # of that frequency, where resonance is looked for at first
_WIDEST = 64.0


def swept_flight(
    oscillator: Oscillator, shaken: Repeated, frequencies: _Array, levels: _Array
) -> _Array:
    """Excursions of displacement (m) and absolute acceleration (m/s²) in free flight.

    Parameters
    ----------
    frequencies, levels
        Rising frequencies (Hz), and the amplitude at each.

    Returns
    -------
    ndarray, shape (2, frequency)
        Of a backward sweep; NaN where the motion does not settle.
    """
    free = oscillator.without_bumpers()
    results = np.empty((len(frequencies), hold.RESULTS))
    states = np.zeros((len(frequencies), layout.STATE))
    state = engine_state(free, equilibrium(free))
    batch.sweep(
        engine_rig(free, shaken),
        np.ascontiguousarray(levels[::-1]),
        np.ascontiguousarray(frequencies[::-1]),
        0.0,
        state,
        1e-9,
        2000,
        64,
        10_000,
        hold.PATIENT,
        results,
        states,
        np.zeros(2, dtype=np.int64),
    )
    results = results[::-1]
    excursions = np.array(
        [
            results[:, hold.U_MOST] - results[:, hold.U_LEAST],
            results[:, hold.A_MOST] - results[:, hold.A_LEAST],
        ]
    )
    excursions[:, results[:, hold.OUTCOME] != Status.DONE] = np.nan
    return excursions


def largest_flight(oscillator: Oscillator, shaken: Repeated) -> tuple[float, float]:
    """Excursions (m, m/s²) of the largest free flight of a backward sweep, each at its own place.

    Both are NaN where no free flight settles, or none moves.
    """
    swing, acceleration, _ = _peaks(oscillator, shaken)
    return swing, acceleration


def resonance(oscillator: Oscillator, shaken: Repeated) -> float:
    """Frequency (Hz) at which the displacement of that free flight is largest; or NaN."""
    return _peaks(oscillator, shaken)[2]


def _peaks(oscillator: Oscillator, shaken: Repeated) -> tuple[float, float, float]:
    key = shaken.replace(frequency=oscillator.natural_frequency, phase=0.0)
    return _largest(oscillator.without_bumpers(), key)


@lru_cache(maxsize=256)
def _largest(free: Oscillator, shaken: Repeated) -> tuple[float, float, float]:
    unit = free.natural_frequency

    def swept(low: float, high: float, count: int) -> tuple[_Array, _Array]:
        grid = np.linspace(low, high, count)
        return grid, swept_flight(free, shaken, grid, np.full(count, shaken.amplitude))

    high = _MOST
    while True:
        grid, curves = swept(_LEAST * unit, high * unit, round((high - _LEAST) / _STEP) + 1)
        if np.all(np.isnan(curves)):
            return math.nan, math.nan, math.nan
        rising = int(np.nanargmax(curves[0])) > len(grid) - 4
        if not rising or high >= _WIDEST:
            break
        high *= 2.0
    largest = []
    places = []
    for which in range(2):
        curve, about = curves[which], grid
        for _ in range(2):
            k = int(np.nanargmax(curve))
            low, top = about[max(k - 1, 0)], about[min(k + 1, len(about) - 1)]
            # From above, so that the sweep comes to where it was on the same side of a fold.
            finer, found = swept(low, top + 10.0 * (top - low) / _FINER, 2 * _FINER + 11)
            if np.all(np.isnan(found[which])):
                break
            about, curve = finer, found[which]
        places.append(float(about[np.nanargmax(curve)]))
        largest.append(float(max(np.nanmax(curve), np.nanmax(curves[which]))))
    swing, acceleration = largest
    if not swing > 0.0:
        return math.nan, math.nan, math.nan
    return swing, acceleration, places[0]
