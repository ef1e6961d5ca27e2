"""Unbounded resonances: motions without stops whose amplitude grows without limit.

The force of the isolator is K u + q with |q| at most Q, and there is no dashpot. Harmonic n of the
shaking has the natural frequency √(K/M) and the force amplitude M A_n. Multiply the equation of
motion by the free motion in phase with this force, and integrate over a cycle. The integral shows
how fast the motion grows: by the work of M A_n, minus the work of q. The work of q is at most 4 Q/π
times the work of a unit sine. Therefore no motion is bounded if M A_n is greater than 4 Q/π. For
friction, this is the limit of Den Hartog (1931), F_c/(M A) = π/4.
"""

from __future__ import annotations

import math

from vibroimpact.model.excitation import Periodic, Repeated
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.rig import Rig


def undamped_frequency(oscillator: Oscillator) -> float:
    """Return √(K/M)/2π in Hz if the force is K u plus a bounded force, without a dashpot; or 0."""
    isolator = oscillator.isolator
    parts = isolator.linear_and_bounded
    if isolator.damping > 0.0 or parts is None or parts[0] == 0.0:
        return 0.0
    if isolator.linear:
        return oscillator.natural_frequency
    return math.sqrt(parts[0] / oscillator.mass) / math.tau


def grows(rig: Rig, frequency: float, within: float) -> int:
    """Return the harmonic that makes the motion without stops unbounded, or 0 if there is none.

    Parameters
    ----------
    frequency
        Forcing frequency (Hz).
    within
        Largest |1 - r²| for which a harmonic counts as resonant. r is its frequency divided by the
        natural frequency.
    """
    oscillator, shaken = rig.oscillator, rig.periodic
    natural = undamped_frequency(oscillator)
    if natural == 0.0:
        return 0
    for n in range(1, _count(shaken) + 1):
        ratio = n * frequency / natural
        near = abs((1.0 - ratio) * (1.0 + ratio)) <= within
        if near and _exceeds(oscillator, _sizes(rig, frequency)[n - 1]):
            return n
    return 0


def has_no_bound(rig: Rig) -> bool:
    """Return whether the motion without stops is unbounded at some forcing frequency."""
    oscillator, shaken = rig.oscillator, rig.periodic
    natural = undamped_frequency(oscillator)
    if natural == 0.0:
        return False
    harmonics = range(1, _count(shaken) + 1)
    return any(grows(rig, natural / n, 1e-12) for n in harmonics)


def _count(shaken: Repeated) -> int:
    """Number of harmonics."""
    return len(shaken.amplitudes) if isinstance(shaken, Periodic) else 1


def _sizes(rig: Rig, frequency: float) -> list[float]:
    """Base acceleration (m/s²) of each harmonic, or what does the same."""
    oscillator, shaken = rig.oscillator, rig.periodic
    values = shaken.replace(frequency=frequency).acceleration(oscillator.mass, math.tau * frequency)
    return [abs(float(one)) for one in (values if isinstance(shaken, Periodic) else [values])]


def _exceeds(oscillator: Oscillator, size: float) -> bool:
    parts = oscillator.isolator.linear_and_bounded
    return parts is not None and oscillator.mass * size > 4.0 / math.pi * parts[1]
