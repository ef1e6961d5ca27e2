"""Resonances without bound: free flight that no dashpot, no spring and no stop holds.

Where the force of an isolator is K u + q with |q| at most Q, and there is no dashpot, let the
harmonic n of what shakes it have the natural frequency √(K/M) and the size M A_n. Multiplied by
the free motion of that phase and taken over a cycle, the equation of motion says how fast this
motion grows: by the work of M A_n, less than that of q, which is at most 4 Q/π times as large as
that of a unit sine. Above M A_n = 4 Q/π no motion is bounded. For friction it is Den Hartog's
bound (1931), F_c/(M A) = π/4.
"""

from __future__ import annotations

import math

from vibroimpact.model.excitation import Periodic, Repeated
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.rig import Rig


def undamped_frequency(oscillator: Oscillator) -> float:
    """√(K/M)/2π in Hz, if the isolator is K u and a bounded force without a dashpot; or 0."""
    isolator = oscillator.isolator
    parts = isolator.linear_and_bounded
    if isolator.damping > 0.0 or parts is None or parts[0] == 0.0:
        return 0.0
    if isolator.linear:
        return oscillator.natural_frequency
    return math.sqrt(parts[0] / oscillator.mass) / math.tau


def grows(rig: Rig, frequency: float, within: float) -> int:
    """Harmonic at which free flight has no bound at a frequency (Hz); 0 if there is none.

    Parameters
    ----------
    within
        |1 - r²| up to which the two frequencies are one.
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
    """Whether free flight grows without bound at some frequency."""
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
    found = shaken.replace(frequency=frequency).acceleration(oscillator.mass, math.tau * frequency)
    return [abs(float(one)) for one in (found if isinstance(shaken, Periodic) else [found])]


def _exceeds(oscillator: Oscillator, size: float) -> bool:
    parts = oscillator.isolator.linear_and_bounded
    return parts is not None and oscillator.mass * size > 4.0 / math.pi * parts[1]
