"""Largest response without stops over all frequencies, for a linear isolator, in closed form."""

from __future__ import annotations

import math

from vibroimpact.errors import InputError
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.quantities import ACCELERATION
from vibroimpact.model.units import to_si

_NO_DAMPING = 1e-150
"""Damping ratio below which the peak is larger than the largest floating-point number."""
_ALL_DAMPING = 1e100
"""Damping ratio above which the mass moves with the base, except for rounding errors."""


def peak_displacement(oscillator: Oscillator, amplitude: float | str) -> float:
    """Return the largest displacement amplitude without stops, over all frequencies.

    It is u_max = A/(2ξ√(1-ξ²) ω0²), at ω = ω0√(1-2ξ²).

    Parameters
    ----------
    oscillator
        The oscillator. Its stops are ignored.
    amplitude
        Peak base acceleration A in m/s², or a string with a unit.

    Returns
    -------
    float
        u_max in m.

    Raises
    ------
    InputError
        If the isolator is not linear. If the amplitude is 0, or if the damping ratio is 0 (the
        peak is unbounded) or at least 1/√2 (the displacement has no peak).
    """
    a = to_si(amplitude, ACCELERATION, "amplitude", minimum=0.0)
    oscillator.check_linear("peak displacement in closed form", stops=False)
    stiffness = oscillator.isolator.initial_stiffness
    return peak_of(oscillator.mass, stiffness, oscillator.damping_ratio, a)


def largest_free_flight(
    angular_frequency: float, damping_ratio: float, amplitude: float
) -> tuple[float, float]:
    """Return the largest amplitudes without stops, over all frequencies.

    The amplitude of the displacement is A/(2ξ√(1-ξ²) ω0²) (see ``peak_displacement``). If ξ is at
    least 1/√2, it is A/ω0², its limit at low frequencies. The amplitude of the absolute
    acceleration is A √(1 + 4ξ²r²)/√((1 - r²)² + 4ξ²r²) at r² = 2/(1 + √(1 + 8ξ²)).

    Parameters
    ----------
    angular_frequency
        Natural angular frequency ω0 in rad/s.
    damping_ratio
        Damping ratio ξ. If it is 0, both amplitudes are infinite.
    amplitude
        Peak base acceleration A in m/s².

    Returns
    -------
    tuple of float
        Amplitudes of the displacement (m) and of the absolute acceleration (m/s²).
    """
    xi, static = damping_ratio, amplitude / angular_frequency**2
    if xi < _NO_DAMPING:
        return math.inf, math.inf
    peaked = xi < math.sqrt(0.5)
    swing = static / (2.0 * xi * math.sqrt(1.0 - xi**2)) if peaked else static
    if xi > _ALL_DAMPING:
        return swing, amplitude
    square = 2.0 / (1.0 + math.sqrt(1.0 + 8.0 * xi**2))
    damped = 4.0 * xi**2 * square
    return swing, amplitude * math.sqrt((1.0 + damped) / ((1.0 - square) ** 2 + damped))


def peak_of(mass: float, stiffness: float, damping_ratio: float, amplitude: float) -> float:
    """Return the largest displacement amplitude without stops (m), which scales the gaps.

    Raises
    ------
    InputError
        If there is no finite resonance peak.
    """
    if not 0.0 < damping_ratio < math.sqrt(0.5):
        raise InputError(
            f"damping_ratio: at {damping_ratio:.6g}, the motion without stops has no finite "
            "resonance peak, so the gap ratio is undefined; use a damping ratio greater than 0 "
            "and less than 0.707107"
        )
    if amplitude == 0.0:
        raise InputError(
            "amplitude: 0 causes no motion, so the gap ratio is undefined; use an acceleration "
            "greater than 0"
        )
    peak, _ = largest_free_flight(math.sqrt(stiffness / mass), damping_ratio, amplitude)
    if not 0.0 < peak < math.inf:
        raise InputError(
            f"amplitude: {amplitude:g} m/s² moves a mass of {mass:g} kg on {stiffness:g} N/m by "
            "a distance outside the range of floating-point numbers; correct these three values or "
            "their units"
        )
    return peak
