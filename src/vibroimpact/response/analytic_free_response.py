"""Steady motion without stops, in closed form: the reference of the normalised excursions."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator, Periodic, Repeated
from vibroimpact.model.largest_free_response import largest_free_flight
from vibroimpact.model.rig import Rig
from vibroimpact.model.unbounded import grows, has_no_bound, undamped_frequency
from vibroimpact.response.free_response import largest_flight, resonance

_RESONANT = 1e-14
_AT_RESONANCE = 1e-9
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)

_Array = NDArray[np.float64]
_Complex = NDArray[np.complex128]


def free_flight_excursions(rig: Rig, frequencies: _Array) -> tuple[_Array, _Array]:
    """Excursions of displacement (m) and absolute acceleration (m/s²) in steady free flight.

    With r = ω/ω₀ and A the peak base acceleration, or what does the same, the displacement's
    amplitude is A/ω₀² / √((1 − r²)² + (2ξr)²). The absolute acceleration's is
    A √(1 + (2ξr)²) / √((1 − r²)² + (2ξr)²), or A r² / √((1 − r²)² + (2ξr)²) where a force on the
    mass takes the place of the base. An excursion of one sine is twice that.

    Raises
    ------
    InputError
        If the isolator is not linear; at the natural frequency of an undamped one, where the
        motion has no bound.
    """
    oscillator, shaken = rig.oscillator, rig.periodic
    oscillator.check_linear("free flight in closed form", stops=False)
    _check(rig, frequencies, "frequencies[{}]")
    if isinstance(shaken, Periodic):
        return tuple(np.ptp(extremes(one), axis=0) for one in harmonics(rig, frequencies))
    omega = 2.0 * np.pi * frequencies
    size = 2.0 * shaken.acceleration(oscillator.mass, omega)
    if oscillator.isolator.initial_stiffness == 0.0:
        c = oscillator.isolator.damping / oscillator.mass
        distance = np.hypot(omega, c)
        return size / (omega * distance), size * (c if shaken.moves_base else omega) / distance
    ratio = omega / oscillator.angular_frequency
    damping = 2.0 * oscillator.damping_ratio * ratio
    # (1 − r)(1 + r) keeps the digits near resonance.
    gain = size / np.hypot((1.0 - ratio) * (1.0 + ratio), damping)
    share = np.sqrt(1.0 + damping**2) if shaken.moves_base else ratio**2
    return gain / oscillator.angular_frequency**2, gain * share


def free_transmitted_excursion(
    rig: Rig, frequencies: _Array, swing: _Array, acceleration: _Array
) -> _Array:
    """Excursion of the force of a linear isolator on the base per unit mass (m/s²).

    K u + C u̇ has the amplitude √(K² + C²ω²) X. If the base moves, it is M times the absolute
    acceleration.

    `swing` and `acceleration` are the excursions of `free_flight_excursions`.
    """
    oscillator, shaken = rig.oscillator, rig.periodic
    if shaken.moves_base:
        return acceleration
    k = oscillator.isolator.initial_stiffness / oscillator.mass
    c = oscillator.isolator.damping / oscillator.mass
    omega = 2.0 * np.pi * frequencies
    if not isinstance(shaken, Periodic):
        return np.asarray(np.hypot(k, c * omega) * swing)
    phasors, _ = harmonics(rig, frequencies)
    rates = np.outer(omega, np.arange(1, phasors.shape[1] + 1))
    return np.asarray(np.ptp(extremes((k + 1j * c * rates) * phasors), axis=0))


def exciting_excursion(rig: Rig, frequencies: _Array) -> _Array:
    """Excursion of the exciting force per unit mass (m/s²): of F/M, or of A_t if the base moves."""
    shaken, mass = rig.periodic, rig.oscillator.mass
    omega = 2.0 * np.pi * frequencies
    if not isinstance(shaken, Periodic):
        return np.asarray(2.0 * shaken.acceleration(mass, omega))
    # The shape is the same at all frequencies.
    sizes = shaken.acceleration(mass, 1.0)
    wave = float(np.ptp(extremes(_turned(shaken, sizes[np.newaxis]))))
    return np.asarray(wave * (omega**2 if shaken.grows_with_frequency else np.ones_like(omega)))


def exciting_force(rig: Rig) -> float:
    """Excursion of the exciting force (N)."""
    frequency = np.array([rig.periodic.frequency])
    return rig.oscillator.mass * float(exciting_excursion(rig, frequency)[0])


def reference_excursions(rig: Rig) -> tuple[float, float]:
    """Excursions of displacement (m) and absolute acceleration (m/s²) that η is taken over.

    Those of the largest free flight at any frequency, whatever range is swept (the maximum of
    the paper's free-flight sweep, Section 4). An undamped isolator has none: there they are
    2A/ω0² and 2A, those under a base acceleration that changes slowly. Under a given displacement
    of the base or an unbalance the acceleration grows on with the frequency: it is taken where the
    displacement is largest. Without a spring there is no such scale, and both are NaN. Of an
    isolator that is not linear they are those of a backward sweep of its own free flight
    (`largest_flight`); if that has no bound either, as with little friction and no dashpot, those
    of its spring alone, with ω0² = K/M, under a base acceleration that changes slowly.
    """
    oscillator, shaken = rig.oscillator, rig.periodic
    if not oscillator.isolator.linear:
        if not has_no_bound(rig):
            return largest_flight(rig)
        natural = undamped_frequency(oscillator)
        if isinstance(shaken, Periodic):
            return _slow(rig, natural)
        size = 2.0 * float(shaken.acceleration(oscillator.mass, math.tau * natural))
        return size / (math.tau * natural) ** 2, size
    omega0 = oscillator.angular_frequency
    if omega0 == 0.0:
        return math.nan, math.nan
    xi = oscillator.damping_ratio
    peaked = 0.0 < xi < math.sqrt(0.5)
    if isinstance(shaken, Periodic):
        if xi > 0.0:
            return _largest(rig)
        return _slow(rig, oscillator.natural_frequency)
    size = float(shaken.acceleration(oscillator.mass, omega0))
    if xi == 0.0:
        return 2.0 * size / omega0**2, 2.0 * size
    if shaken.of == "acceleration":
        swing, acceleration = largest_free_flight(omega0, xi, size)
        return 2.0 * swing, 2.0 * acceleration
    # Under a force the acceleration has the peak that the displacement has under a displacement.
    peak = 1.0 / (2.0 * xi * math.sqrt(1.0 - xi**2)) if peaked else 1.0
    if shaken.of == "force":
        return 2.0 * peak * size / omega0**2, 2.0 * peak * size
    if not peaked:
        return 2.0 * size / omega0**2, 2.0 * size
    at = 1.0 / math.sqrt(1.0 - 2.0 * xi**2)
    share = math.hypot(1.0, 2.0 * xi * at) if shaken.moves_base else at**2
    return 2.0 * peak * size / omega0**2, 2.0 * peak * size * share


def resonance_ratio(rig: Rig) -> float:
    """Where free flight's displacement is largest, over the natural frequency.

    Of an isolator that is not linear, in a backward sweep of its own free flight; 1 if none
    settles.
    """
    oscillator, shaken = rig.oscillator, rig.sine
    if oscillator.isolator.linear:
        return peak_ratio(oscillator.damping_ratio, shaken)
    if has_no_bound(rig):
        return undamped_frequency(oscillator) / oscillator.natural_frequency
    ratio = resonance(rig) / oscillator.natural_frequency
    return ratio if math.isfinite(ratio) else 1.0


def peak_ratio(damping_ratio: float, shaken: Harmonic) -> float:
    """Where a linear free flight's displacement is largest, over the natural frequency.

    At √(1 − 2ξ²), or at 1/√(1 − 2ξ²) where the displacement of the base or an unbalance is given.
    With ξ of 1/√2 or more there is no peak, and it is 0 or infinite: the end towards which the
    curve rises.
    """
    # As a product: the square of a huge ratio is beyond the range of numbers.
    below = math.sqrt(max(0.0, 1.0 - 2.0 * damping_ratio * damping_ratio))
    if not shaken.grows_with_frequency:
        return below
    return 1.0 / below if below else math.inf


def check_bounded(rig: Rig, field: str = "frequency") -> None:
    """Refuse resonance of an undamped mass that no bumper stops."""
    oscillator, shaken = rig.oscillator, rig.periodic
    if not oscillator.stops:
        _check(rig, [shaken.frequency], field)


def check_each_bounded(rig: Rig, frequencies: _Array) -> None:
    """The same of each frequency of a sweep, of which the shaking may have any amplitude."""
    oscillator = rig.oscillator
    if not oscillator.stops:
        _check(rig, frequencies, "frequencies[{}]")


def beside_resonance(oscillator: Oscillator, frequencies: _Array) -> _Array:
    """Frequencies to hold by default: the resonance of an undamped isolator moved half a step.

    Where the user has not chosen them, a default must not be what is refused.
    """
    natural = undamped_frequency(oscillator)
    if natural == 0.0:
        return frequencies
    step = frequencies[1] - frequencies[0]
    there = np.abs(frequencies / natural - 1.0) < _AT_RESONANCE
    return frequencies + np.where(there, 0.5 * step, 0.0)


def _check(rig: Rig, frequencies: Iterable[float], field: str) -> None:
    """Refuse resonance of an undamped isolator; the field may have a place for the position."""
    oscillator = rig.oscillator
    if undamped_frequency(oscillator) == 0.0:
        return
    bounded = oscillator.isolator.linear_and_bounded
    held = ", whose bounded force is too small to hold the mass," if bounded and bounded[1] else ","
    for i, frequency in enumerate(frequencies):
        if n := grows(rig, float(frequency), _RESONANT):
            which = "" if n == 1 else f"1/{n} of "
            raise InputError(
                f"{field.format(i)}: {float(frequency)!r} Hz is {which}the natural frequency of "
                f"an undamped isolator{held} so the motion without stops grows without bound; "
                "change the frequency, or add isolator damping"
            )


def harmonics(rig: Rig, frequencies: _Array) -> tuple[_Complex, _Complex]:
    """Steady free flight: displacement and absolute acceleration are Im Σ z_n exp(inθ).

    Returns
    -------
    tuple of ndarray, shape (frequency, n)
        z_n of both, n = 1, 2, ….
    """
    oscillator, shaken = rig.oscillator, rig.periodic
    oscillator.check_linear("free flight in closed form", stops=False)
    mass, isolator = oscillator.mass, oscillator.isolator
    k, c = isolator.initial_stiffness, isolator.damping
    omega = 2.0 * np.pi * frequencies
    sizes = shaken.acceleration(mass, omega).reshape(len(omega), -1)
    order = np.arange(1, sizes.shape[1] + 1)
    base = _turned(shaken, sizes)
    base *= 1.0 if shaken.of == "acceleration" else -1.0
    omega = np.outer(omega, order)
    natural = math.sqrt(k / mass)
    stiff = (natural - omega) * (natural + omega)
    swing: _Complex = -base / (stiff + 1j * omega * c / mass)
    moved = base if shaken.moves_base else np.zeros_like(base)
    return swing, np.asarray(moved - omega**2 * swing, dtype=np.complex128)


def _turned(shaken: Repeated, sizes: _Array) -> _Complex:
    """Sizes of harmonics (last axis) as phasors, each at its phase."""
    phasors: _Complex = sizes.astype(np.complex128)
    if isinstance(shaken, Periodic):
        phasors *= np.exp(1j * np.array(shaken.phases))
    return phasors


def extremes(phasors: _Complex) -> _Array:
    """Minimum and maximum of Im Σ z_n exp(inθ), for each row: at the zeros of its slope."""
    known = np.flatnonzero(np.any(phasors != 0.0, axis=0))
    extrema = np.zeros((2, len(phasors)))
    if not len(known):
        return extrema
    count = int(known[-1]) + 1
    n = np.arange(1, count + 1)
    rows = phasors[:, :count]
    # Re Σ n z_n wⁿ = 0 on |w| = 1, times w^N: a polynomial of degree 2N, whose roots are the
    # eigenvalues of its companion matrix.
    slopes = n * rows
    lead = np.where(slopes[:, -1:] == 0.0, np.finfo(float).tiny, slopes[:, -1:])
    below = np.concatenate([slopes[:, -2::-1], np.zeros((len(rows), 1)), slopes.conj()], axis=1)
    companion = np.zeros((len(rows), 2 * count, 2 * count), dtype=np.complex128)
    companion[:, np.arange(1, 2 * count), np.arange(2 * count - 1)] = 1.0
    companion[:, 0, :] = -below / lead
    angles = np.concatenate(
        [
            np.angle(np.linalg.eigvals(companion)),
            np.broadcast_to(np.pi * np.arange(8) / 4.0, (len(rows), 8)),
        ],
        axis=1,
    )
    values = np.einsum("itn,in->it", np.exp(1j * angles[..., np.newaxis] * n), rows).imag
    extrema[0], extrema[1] = values.min(axis=1), values.max(axis=1)
    return extrema


def _sampled(phasors: _Complex) -> _Array:
    """Excursion of Im Σ z_n exp(inθ), for each row, from 64 samples of the highest harmonic.

    A parabola through the largest sample and its neighbours is right to about a millionth.
    """
    rows, count = phasors.shape
    padded = np.zeros((rows, 64 * count), dtype=np.complex128)
    padded[:, 1 : count + 1] = phasors
    values = np.fft.ifft(padded, axis=1, norm="forward").imag

    def top(values: _Array) -> _Array:
        at, row = values.argmax(axis=1), np.arange(rows)
        before, here = values[row, at - 1], values[row, at]
        behind = values[row, (at + 1) % values.shape[1]]
        bend = np.maximum(2.0 * here - before - behind, np.finfo(float).tiny)
        return np.asarray(here + (behind - before) ** 2 / (8.0 * bend))

    return np.asarray(top(values) + top(-values))


def _slow(rig: Rig, natural: float) -> tuple[float, float]:
    """What an excitation that changes slowly does to displacement and acceleration."""
    oscillator, shaken = rig.oscillator, rig.periodic
    here = shaken.replace(frequency=natural)
    sizes = here.acceleration(oscillator.mass, here.angular_frequency)
    low, high = extremes(_turned(shaken, sizes[np.newaxis]))
    wave = float(high[0] - low[0])
    return wave / (math.tau * natural) ** 2, wave


def _largest(rig: Rig) -> tuple[float, float]:
    """The largest excursion of displacement at any frequency, and of acceleration likewise.

    Under a displacement of the base or an unbalance, the acceleration at the frequency of the
    former. Neither the frequency nor the stops matter, and the size only scales it: along a branch
    it is found once.
    """
    oscillator, shaken = rig.oscillator, rig.periodic
    bare = oscillator.replace(right=None, left=None, force=0.0)
    shape = shaken.replace(amplitude=1.0, frequency=oscillator.natural_frequency, phase=0.0)
    swing, acceleration = _largest_of(Rig(bare, shape))
    return shaken.amplitude * swing, shaken.amplitude * acceleration


@lru_cache(maxsize=64)
def _largest_of(rig: Rig) -> tuple[float, float]:
    oscillator, shaken = rig.oscillator, rig.periodic
    assert isinstance(shaken, Periodic)
    natural, count = oscillator.natural_frequency, len(shaken.amplitudes)
    grid = natural * np.geomspace(0.02 / count, 5.0, 2000)
    curves = [_sampled(one) for one in harmonics(rig, grid)]

    def peak(which: int) -> tuple[float, float]:
        curve = curves[which]
        # Samples fall a little short of an extreme: the best are looked at again, exactly.
        best = np.flatnonzero(curve >= 0.998 * curve.max())
        best = best[np.argsort(-curve[best])][: max(20, 4000 // count**2)]
        i = int(best[np.argmax(free_flight_excursions(rig, grid[best])[which])])
        low, high = grid[max(i - 1, 0)], grid[min(i + 1, len(grid) - 1)]
        for _ in range(60):
            one, other = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
            pair = free_flight_excursions(rig, np.array([one, other]))[which]
            low, high = (low, other) if pair[0] > pair[1] else (one, high)
        at = 0.5 * (low + high)
        return at, float(free_flight_excursions(rig, np.array([at]))[which][0])

    at, swing = peak(0)
    if shaken.grows_with_frequency:
        return swing, float(free_flight_excursions(rig, np.array([at]))[1][0])
    return swing, peak(1)[1]
