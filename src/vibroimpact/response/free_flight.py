"""Steady motion without bumpers, in closed form: the reference of the normalised excursions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model import Oscillator
from vibroimpact.model.dimensionless import largest_free_flight

_RESONANT = 1e-14


def free_flight_excursions(
    oscillator: Oscillator, amplitude: float, frequencies: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Excursions of displacement (m) and absolute acceleration (m/s²) in steady free flight.

    With r = ω/ω₀, the displacement's amplitude is A/ω₀² / √((1 − r²)² + (2ξr)²) and the
    absolute acceleration's A √(1 + (2ξr)²) / √((1 − r²)² + (2ξr)²); an excursion is twice that.

    Raises
    ------
    InputError
        At the natural frequency of an undamped isolator, where the motion has no bound.
    """
    omega = 2.0 * np.pi * frequencies
    ratio = omega / oscillator.angular_frequency
    damping = 2.0 * oscillator.damping_ratio * ratio
    # (1 − r)(1 + r) keeps the digits near resonance.
    distance = np.hypot((1.0 - ratio) * (1.0 + ratio), damping)
    for i in np.flatnonzero(distance <= _RESONANT):
        raise InputError(unbounded(f"frequencies[{i}]", float(frequencies[i])))
    gain = 2.0 * amplitude / distance
    return gain / oscillator.angular_frequency**2, gain * np.sqrt(1.0 + damping**2)


def reference_excursions(
    angular_frequency: float, damping_ratio: float, amplitude: float
) -> tuple[float, float]:
    """Excursions of displacement (m) and absolute acceleration (m/s²) that η is taken over.

    Those of the largest free flight at any frequency, whatever range is swept (the maximum of
    the paper's free-flight sweep, Section 4). An undamped isolator has none: there they are
    2A/ω0² and 2A, those under a base acceleration that changes slowly.
    """
    if damping_ratio == 0.0:
        return 2.0 * amplitude / angular_frequency**2, 2.0 * amplitude
    swing, acceleration = largest_free_flight(angular_frequency, damping_ratio, amplitude)
    return 2.0 * swing, 2.0 * acceleration


def check_bounded(oscillator: Oscillator, frequency: float, field: str) -> None:
    """Refuse resonance of an undamped mass that no bumper stops."""
    if oscillator.right is None and oscillator.left is None and oscillator.isolator.damping == 0.0:
        ratio = frequency / oscillator.natural_frequency
        if abs((1.0 - ratio) * (1.0 + ratio)) <= _RESONANT:
            raise InputError(unbounded(field, frequency))


def unbounded(field: str, frequency: float) -> str:
    """The message of both."""
    return (
        f"{field}: {frequency!r} Hz is the natural frequency of an undamped isolator, where free "
        "flight grows without bound; another frequency or some isolator damping is accepted"
    )
