"""Fourier spectra: exact harmonics of a periodic motion, a windowed transform of any other."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import fourier
from vibroimpact.errors import InputError
from vibroimpact.model import Repeated, to_si
from vibroimpact.model.quantities import DIMENSIONLESS
from vibroimpact.response.measuring import asked, table
from vibroimpact.response.phases import Phases, Recorded, phases, recorded
from vibroimpact.response.variables import describe, motion_parameters

_Complex = NDArray[np.complex128]

_QUANTITIES = ("displacement", "velocity", "acceleration")
MOST_LINES = 20_000
"""Lines of a periodic motion."""


def spectrum(motion: xr.Dataset, highest: float = 50.0) -> xr.Dataset:
    """Return the Fourier spectrum of displacement, velocity and absolute acceleration.

    The acceleration is that of finite forces, without the impulses of impacts on rigid stops.

    Of a periodic motion the harmonics are exact: each phase is integrated times exp(−iνt) by the
    quadrature of its series (docs/theory.md, section 7), so that there is neither leakage nor a
    sampling error. Any other motion is transformed with a Hann
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
    found = np.zeros((fourier.QUANTITIES, len(order)))
    rig, size, frequency = asked(origin)
    rows = table(origin, parts, np.zeros(len(parts.contact), dtype=np.int64))
    lines = order * origin.excitation.angular_frequency
    fourier.integrate(rig, size, frequency, rows, parts.begin, lines, found)
    scale = np.where(order == 0.0, 1.0, 2.0) / (origin.cycles * origin.excitation.period)
    return [(real + 1j * imaginary) * scale for real, imaginary in found.reshape(3, 2, -1)]


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
