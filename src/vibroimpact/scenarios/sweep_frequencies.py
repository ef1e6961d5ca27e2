"""Which frequencies a rig has to be swept over to name its scenario."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator, Stop
from vibroimpact.model.clearance import clearances_at_rest
from vibroimpact.model.rig import Rig
from vibroimpact.response.analytic_free_response import (
    beside_resonance,
    peak_ratio,
    reference_excursions,
    resonance_ratio,
)

LOW = 0.4
"""Lowest frequency over the natural one: that at which the published tests begin (0.40 to
0.45 for the three accelerations)."""
STEP = 0.01
"""Step over the natural frequency: a tenth of that of the published tests."""
LEAST_HIGH = 1.5
"""Highest frequency over that of free flight's resonance, or over the natural one if that lies
higher, at least."""

MOST_HIGH = 20.0
"""Highest frequency over the natural one for a rigid stop, whose stiffness sets no bound: that of
bumpers with λ = 330."""

MOST = 100_000
"""Frequencies of a sweep."""
CLOSE = 1e-3
"""Distance from an orbit, over the motion's size, at which a hold sees that it closes in."""
MOST_CYCLES = 20_000
"""Of a nearly undamped rig."""
ROUND = 0.5
"""Rigs that differ little are swept over the same range, many at once."""


def highest(rig: Rig) -> float:
    """Frequency over the natural one below which the primary resonance lies.

    Two bounds, the lower one counts, with a margin, rounded up to a multiple of `ROUND`:

    - Energy. A motion of one forcing cycle that reaches both bumpers travels 2 (G_R + G_L) in a
      cycle, so that the mean of its velocity squared is at least (2 f (G_R + G_L))². The base
      supplies at most M A √(mean of u̇²/2) of power, the isolator alone takes C (mean of u̇²):
      f ≤ M A/(2√2 C (G_R + G_L)). A motion that reaches one bumper alone travels 2 G of that
      side at least, for the mean of u is not on its side: it only pushes. So of a rig whose gaps
      differ, or that has one bumper, the smallest gap takes the place of the sum. A force F on
      the mass takes the place of M A; a given displacement of the base or an unbalance supplies the
      more the faster it moves, and sets no bound.
    - Stiffness. Nothing is stiffer than isolator and bumper in contact all the time, whose
      resonance lies at f0 √(1 + λ); flights lower it, and so does damping, or raises it where
      the displacement of the base or an unbalance is given. With a rigid stop it is `MOST_HIGH`.
      Of other laws the stiffness counts that they have where the largest free flight would reach.
    """
    oscillator, shaken = rig.oscillator, rig.sine
    free = max(1.0, resonance_ratio(rig))
    least = ROUND * math.ceil(min(LEAST_HIGH * free, MOST_HIGH) / ROUND)
    stops = oscillator.stops
    if not stops:
        return least
    stiff = max(_in_contact(oscillator, side, shaken) for side in clearances_at_rest(oscillator))
    gaps = list(clearances_at_rest(oscillator).values())
    apart = sum(gaps) if len(gaps) == 2 and gaps[0] == gaps[1] else min(gaps)
    viscous = oscillator.isolator.damping_exponent == 1.0
    travel = apart * oscillator.isolator.damping if viscous else 0.0
    energy = math.inf
    if travel > 0.0 and not shaken.grows_with_frequency:
        supplied = oscillator.mass * float(shaken.acceleration(oscillator.mass, 0.0))
        energy = supplied / (2.0 * math.sqrt(2.0)) / travel / oscillator.natural_frequency
    bound = 1.1 * min(stiff, energy) + 0.1
    return max(least, ROUND * math.ceil(bound / ROUND))


def _in_contact(oscillator: Oscillator, side: str, shaken: Harmonic) -> float:
    """Resonance over the natural frequency of a mass in contact with a stop all the time."""
    stop: Stop = getattr(oscillator, side)
    if stop.rigid:
        return MOST_HIGH
    spring = oscillator.isolator.initial_stiffness
    if stop.spring_and_dashpot is not None and oscillator.isolator.linear:
        stiffer = math.sqrt(1.0 + stop.spring_and_dashpot[0] / spring)
    else:
        swing = 0.5 * reference_excursions(Rig(oscillator, shaken))[0]
        depth = max(swing - clearances_at_rest(oscillator)[side], 0.0)
        pressed = _tangent(stop.static_force, depth)
        held = max(_tangent(oscillator.isolator.static_force, swing), spring)
        stiffer = min(math.sqrt((held + pressed) / spring), MOST_HIGH)
    if not shaken.grows_with_frequency:
        return stiffer
    natural = stiffer * oscillator.angular_frequency
    damping = oscillator.isolator.damping + stop.initial_damping
    higher = stiffer * peak_ratio(damping / (2.0 * oscillator.mass * natural), shaken)
    return min(higher, max(stiffer, MOST_HIGH))


def _tangent(force: Callable[[float], float], at: float) -> float:
    """The slope of a force that rises ever more steeply, or ever less, at a displacement (N/m)."""
    if not 0.0 < at < math.inf:
        return 0.0
    return max((force(at) - force(0.999 * at)) / (0.001 * at), 0.0)


def cycles(rig: Rig, high: float, least: int) -> int:
    """Forcing cycles after which a free transient has decayed enough for a hold to go on waiting.

    At f = `high` f0 it decays by exp(-2πξ/high) a cycle; `CLOSE` is reached after
    ln(1/CLOSE) high/(2πξ) of them, and twice as many are given. Of an isolator that is not linear,
    ξ = A/(2 u ω²) is that of the linear one whose free flight is as large at its resonance.
    """
    oscillator, shaken = rig.oscillator, rig.sine
    if oscillator.isolator.linear:
        ratio = oscillator.damping_ratio
    else:
        swing = 0.5 * reference_excursions(rig)[0]
        omega = resonance_ratio(rig) * oscillator.angular_frequency
        ratio = float(shaken.acceleration(oscillator.mass, omega)) / (2.0 * swing * omega**2)
    wanted = (
        2.0 * math.log(1.0 / CLOSE) * high / (2.0 * math.pi * ratio) if ratio > 0.0 else math.inf
    )
    return int(min(max(wanted, least), MOST_CYCLES))


def frequencies(rig: Rig, step: float = STEP) -> NDArray[np.float64]:
    """Frequencies (Hz) from `LOW` by `step` to `highest`, all over the natural frequency."""
    oscillator = rig.oscillator
    return held(oscillator, highest(rig), step)


def held(oscillator: Oscillator, high: float, step: float) -> NDArray[np.float64]:
    """Frequencies (Hz) of `grid`; beside the natural one where free flight has no bound there."""
    return beside_resonance(oscillator, grid(high, step) * oscillator.natural_frequency)


def grid(high: float, step: float) -> NDArray[np.float64]:
    """Multiples of `step` above `LOW` up to `high` at least."""
    count = (high - LOW) / step - 1e-9
    if count > MOST and (high - LOW) / STEP <= MOST:
        raise InputError(
            f"step: {step:g} gives {count:.3g} frequencies, more than the maximum of {MOST}; pass "
            "a larger step"
        )
    if count > MOST:
        raise InputError(
            f"stiffness: the stops may raise the resonance to {high:.3g} times the natural "
            f"frequency of the rig, so the sweep would have {count:.3g} frequencies, more than "
            f"the maximum of {MOST}; lower the stiffness of the stops"
        )
    return LOW + step * np.arange(math.ceil(count) + 1, dtype=np.float64)
