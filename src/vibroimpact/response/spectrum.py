"""Fourier spectra: exact harmonics of a periodic motion, a windowed transform of any other."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model import Periodic, Repeated, to_si
from vibroimpact.model.quantities import DIMENSIONLESS
from vibroimpact.response.phases import Phases, Recorded, phases, recorded, settling, view
from vibroimpact.response.variables import describe, motion_parameters

_Complex = NDArray[np.complex128]

_QUANTITIES = ("displacement", "velocity", "acceleration")
MOST_LINES = 20_000
"""Lines of a periodic motion."""

_NEAR = 1e-3
_POINTS = 32


def spectrum(motion: xr.Dataset, highest: float = 50.0) -> xr.Dataset:
    """Return the Fourier spectrum of displacement, velocity and absolute acceleration.

    The acceleration is that of finite forces, without the impulses of impacts on rigid stops.

    Of a periodic motion the harmonics are exact: within each phase the integral of the motion
    times exp(−iνt) follows from the states at its two ends (docs/theory.md, section 7), so that
    there is neither leakage nor a sampling error. Any other motion is transformed with a Hann
    window over the whole forcing cycles of its record; a line between two points of the transform
    is then up to 15 % too low, and lines closer than two such points run together.

    Parameters
    ----------
    motion
        Dataset of `steady`, or of `simulate` with samples.
    highest
        Highest order f / f_exc.

    Returns
    -------
    xarray.Dataset
        Dim ``order`` (f / f_exc; that of order 0 is the mean), with ``line_frequency`` in Hz.
        Amplitudes and phases of the cosines whose sum is the motion, from the beginning of the
        record. The attribute ``method`` says how they were found.

    Raises
    ------
    InputError
        If the dataset is not that of a motion with samples, or `highest` is not positive.
    """
    limit = to_si(highest, DIMENSIONLESS, "highest", above=0.0)
    origin = recorded(motion)
    if origin.periodic:
        n = int(motion["period"])
        if limit * n > MOST_LINES:
            raise InputError(f"highest: {limit:g}; at most {MOST_LINES / n:g} is accepted")
        order = np.arange(int(limit * n + 1e-9) + 1) / n
        lines = _exact(origin, phases(motion), order)
        method = f"exact Fourier coefficients over one period of {n} forcing cycles"
    else:
        order, lines, cycles = _windowed(motion, origin, limit)
        method = f"Hann window over {cycles} forcing cycles"
    data = xr.Dataset(coords={"order": order})
    data.coords["line_frequency"] = ("order", order * origin.excitation.frequency)
    for name, values in zip(_QUANTITIES, lines, strict=True):
        data[f"{name}_amplitude"] = ("order", np.abs(values))
        data[f"{name}_phase"] = ("order", np.angle(values))
    data.attrs["method"] = method
    return describe(data, "vibroimpact.spectrum", motion_parameters(motion))


def _exact(origin: Recorded[Repeated], parts: Phases, order: NDArray[np.float64]) -> list[_Complex]:
    """Complex amplitudes at the given orders: of u, u̇ and ü + A_t."""
    rig, shaken = origin.oscillator, origin.excitation
    rig.check_linear("Fourier integrals in closed form")
    contact, side = parts.contact, view(parts)
    # In contact x = u − (±gap), the bumper's deformation; the right one's if both are pressed.
    face = (side * origin.of_side(side, "gap"))[:, np.newaxis]
    spring = rig.isolator.initial_stiffness
    k = (spring + origin.of_side(contact, "stiffness"))[:, np.newaxis] / rig.mass
    c = (rig.isolator.damping + origin.of_side(contact, "damping"))[:, np.newaxis] / rig.mass
    load = -spring * face
    if rig.right and rig.left:
        overlap = -(rig.right.gap + rig.left.gap)
        other = origin.of_side(-side, "stiffness") * overlap
        load += np.where(contact == 2, other, 0.0)[:, np.newaxis]
    load = (load + rig.force) / rig.mass
    phases_of = shaken.phases if isinstance(shaken, Periodic) else (0.0,)
    sizes = np.atleast_1d(shaken.acceleration(rig.mass, shaken.angular_frequency))
    # What is given as a displacement of the base or as a force pulls the other way.
    sign = 1.0 if shaken.of == "acceleration" else -1.0
    waves = [(sign * float(size), shift) for size, shift in zip(sizes, phases_of, strict=True)]
    resting = (origin.resting(contact) | settling(origin, parts))[:, np.newaxis]
    pressed = np.where(side == 1, 2, 3)
    ends = []
    for states in (parts.first, parts.last):
        deformation = np.take_along_axis(states, pressed[:, np.newaxis], axis=1)
        ends.append(
            (np.where(side[:, np.newaxis] == 0, states[:, :1], deformation), states[:, 1:2])
        )
    (x0, v0), (x1, v1) = ends
    length = parts.length[:, np.newaxis]
    angle = parts.angle[:, np.newaxis]
    omega = shaken.angular_frequency

    def integrals(nu: Any) -> _Complex:
        """∫ e^(−iνt) times x, x′, 1 and A_t over each phase from its beginning."""
        constant = length * _phi(-1j * nu * length)
        base = np.zeros_like(constant)
        for n, (size, shift) in enumerate(waves, start=1):
            turn, rate = n * angle + shift, n * omega
            forward = np.exp(1j * turn) * length * _phi(1j * (rate - nu) * length)
            backward = np.exp(-1j * turn) * length * _phi(-1j * (rate + nu) * length)
            base = base + size * (forward - backward) / 2j
        forcing = load * constant - base
        turned = np.exp(-1j * nu * length)
        rise, push = x1 * turned - x0, v1 * turned - v0
        x = (forcing - push - (1j * nu + c) * rise) / (k - nu * nu + 1j * c * nu)
        return np.stack([x, rise + 1j * nu * x, constant, base])

    nu = order * omega
    with np.errstate(divide="ignore", invalid="ignore"):
        found = integrals(nu)
    # Where a line meets an undamped resonance of the phase, numerator and denominator vanish;
    # the integral is an entire function of ν, and so the mean of its values on a circle.
    close = np.abs(k - nu * nu + 1j * c * nu) <= _NEAR * (k + nu * nu)
    if close.any():
        # No larger than where exp(−iνt) begins to grow over the phase.
        radius = np.minimum(
            0.5 * np.sqrt(np.maximum(k, omega**2)), 1.0 / np.maximum(length, 1e-300)
        )
        found = np.where(close, _circle_mean(integrals, nu, radius), found)
    x, v, constant, base = found
    moved = base if shaken.moves_base else np.zeros_like(base)
    a = load * constant - k * x - c * v - (base - moved)
    x, v, a = (
        np.where(resting, x0 * constant, x),
        np.where(resting, 0.0, v),
        np.where(resting, moved, a),
    )
    u = face * constant + x
    turn = np.exp(-1j * nu * parts.begin[:, np.newaxis])
    whole = origin.cycles * shaken.period
    scale = np.where(order == 0.0, 1.0, 2.0) / whole
    return [(turn * values).sum(axis=0) * scale for values in (u, v, a)]


def _phi(z: _Complex) -> _Complex:
    """(exp(z) − 1) / z, which is 1 at 0."""
    at_zero = z == 0.0
    safe = np.where(at_zero, 1.0, z)
    return np.where(at_zero, 1.0, np.expm1(safe) / safe)


def _circle_mean(
    function: Callable[[Any], _Complex], centre: NDArray[np.float64], radius: NDArray[np.float64]
) -> _Complex:
    turns = np.exp(2j * np.pi * (np.arange(_POINTS) + 0.5) / _POINTS)
    return sum(function(centre + radius * turn) for turn in turns) / _POINTS  # type: ignore[return-value]


def _windowed(
    motion: xr.Dataset, origin: Recorded[Repeated], highest: float
) -> tuple[NDArray[np.float64], list[_Complex], int]:
    """Orders, complex amplitudes, and the number of cycles used: the first whole ones."""
    samples = int(np.searchsorted(motion["cycle"].values, 1.0 - 1e-9))
    cycles = int(origin.cycles + 1e-9)
    count = cycles * samples
    if cycles < 1 or count < 4:
        raise InputError(
            f"motion: a record of {origin.cycles:g} cycles and {count} samples has no spectrum; "
            "at least one cycle and four samples are accepted"
        )
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(count) / count)
    order = np.arange(count // 2 + 1) / cycles
    kept = order <= highest
    lines = []
    for name in _QUANTITIES:
        values = motion[name].values[:count]
        mean = values.mean()
        line = 2.0 * np.fft.rfft(window * (values - mean)) / window.sum()
        line[0] = mean
        lines.append(line[kept])
    return order[kept], lines, cycles
