"""Fourier spectra: exact harmonics of periodic motions, windowed transforms of others."""

from __future__ import annotations

import numpy as np
import scipy
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import check_variables
from vibroimpact.datasets.description import describe, motion_parameters, noted
from vibroimpact.errors import InputError
from vibroimpact.model.argument_types import Positive
from vibroimpact.model.public import public
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.motion_phases import Origin, fourier_integrals, recorded
from vibroimpact.response.sine_fit import forcing_sine

_Complex = NDArray[np.complex128]

_QUANTITIES = ("displacement", "velocity", "acceleration")
MOST_LINES = 20_000
"""Largest number of lines of a periodic motion."""


@public
def fourier_spectrum(motion: xr.Dataset, highest: Positive = 50.0) -> xr.Dataset:
    """Compute the Fourier spectrum of displacement, velocity and absolute acceleration.

    The acceleration is computed from finite forces. The impulses of impacts on rigid stops are left
    out.

    For a periodic motion the harmonics are exact, without leakage and without sampling error. They
    are integrals over each contact and each flight, computed from the series of the motion
    (docs/theory.md, section 7). Other motions are transformed by an FFT with a Hann window over
    their whole forcing cycles. In that case a spectral line between two points of the transform is
    up to 15 % too low. Lines that are closer than two points of the transform merge.

    Parameters
    ----------
    motion
        Dataset of `steady`, or of `simulate` with samples. A measured time history is also
        accepted; its orders refer to the frequency of the sine that shakes its base.
    highest
        Highest order of the result. The order is the frequency divided by the forcing frequency.

    Returns
    -------
    xarray.Dataset
        The dim ``order`` is the frequency divided by the forcing frequency. Order 0 is the mean.
        ``line_frequency`` is the frequency in Hz. The variables are the amplitudes and the phases
        of cosines whose sum is the motion; of an assembly, they have the last dim ``mass``. The
        phases refer to the start of the motion. The attribute ``method`` describes how the spectrum
        was computed.

    Raises
    ------
    InputError
        If the dataset does not hold a motion with samples, or if ``highest`` is not positive.
    """
    check_variables(motion, (), "motion", "the result of simulate or steady")
    if motion.attrs.get("kind") == "history" and "event_time" not in motion:
        return _of_measured(motion, highest)
    origin = recorded(motion, masses=True)
    if origin.periodic:
        n = int(motion["period"])
        if highest * n > MOST_LINES:
            most = MOST_LINES / n
            raise InputError(f"highest: {highest:g} is too large; pass at most {most:g}")
        order = np.arange(int(highest * n + 1e-9) + 1) / n
        lines = _exact(motion, origin, order)
        method = f"exact Fourier coefficients over one period of {n} forcing cycles"
    else:
        order, lines, cycles = _windowed(motion, origin, highest)
        method = f"Hann window over {cycles} forcing cycles"
    data = xr.Dataset(coords={"order": order})
    data.coords["line_frequency"] = ("order", order * origin.repeated.frequency)
    dims = ("order", "mass") if "mass" in motion.dims else ("order",)
    for name, values in zip(_QUANTITIES, lines, strict=True):
        data[f"{name}_amplitude"] = (dims, np.abs(values))
        data[f"{name}_phase"] = (dims, np.angle(values))
    if "mass" in dims:
        data.coords["mass"] = motion["mass"]
    data.attrs["method"] = method
    return describe(data, "vibroimpact.fourier_spectrum", motion_parameters(motion), noted(motion))


def _exact(motion: xr.Dataset, origin: Origin, order: NDArray[np.float64]) -> list[_Complex]:
    """Compute complex amplitudes of u, u̇ and ü + A_t at the given orders."""
    rates = order * origin.repeated.angular_frequency
    scale = np.where(order == 0.0, 1.0, 2.0) / (origin.cycles * origin.repeated.period)
    integrals = fourier_integrals(motion, origin, rates) * scale[:, np.newaxis]
    _, amplitudes = engine_system(origin.system).of_masses((), integrals)
    return [*amplitudes]


def _windowed(
    motion: xr.Dataset, origin: Origin, highest: float
) -> tuple[NDArray[np.float64], list[_Complex], int]:
    """Compute orders, complex amplitudes, and the number of cycles used (the first whole ones)."""
    samples = int(np.searchsorted(motion["cycle"].values, 1.0 - 1e-9))
    cycles = int(origin.cycles + 1e-9)
    count = cycles * samples
    if cycles < 1 or count < 4:
        few = f"{origin.cycles:g} cycles" if cycles < 1 else f"{count} samples"
        raise InputError(
            f"motion: {few} are too few for a spectrum; pass a motion of at least one whole cycle "
            "with four samples"
        )
    order = np.arange(count // 2 + 1) / cycles
    kept = order <= highest
    lines = [
        _lines(motion[name].transpose("time", ...).values[:count])[kept] for name in _QUANTITIES
    ]
    return order[kept], lines, cycles


def _lines(values: NDArray[np.float64]) -> _Complex:
    """Compute complex amplitudes of even samples over whole cycles, with a Hann window.

    The samples are along the first axis.
    """
    count = len(values)
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(count) / count)
    mean = values.mean(axis=0)
    line: _Complex = 2.0 * np.fft.rfft((window * (values - mean).T).T, axis=0) / window.sum()
    line[0] = mean
    return line


def _of_measured(motion: xr.Dataset, highest: float) -> xr.Dataset:
    """Compute the spectrum of a measured history, over the whole cycles of its forcing.

    A spline resamples it at times that divide these cycles evenly.
    """
    time = motion["time"].values
    held = {name: motion[name].values for name in _QUANTITIES if name in motion}
    base = motion["base_acceleration"].values if "base_acceleration" in motion else None
    sine = forcing_sine(time, base, next(iter(held.values()), None), motion.attrs.get("frequency"))
    cycles = 0 if sine is None else int((time[-1] - time[0]) * sine.frequency + 1e-9)
    if sine is None or cycles < 1 or not held:
        raise InputError(
            "motion: the measured history does not contain a whole cycle of a sine; pass at "
            "least one cycle of displacement, velocity or acceleration with 8 samples"
        )
    span = cycles / sine.frequency
    count = int(np.searchsorted(time, time[0] + span))
    even = time[0] + span * np.arange(count) / count
    order = np.arange(count // 2 + 1) / cycles
    kept = order <= highest
    data = xr.Dataset(coords={"order": order[kept]})
    data.coords["line_frequency"] = ("order", order[kept] * sine.frequency)
    for name, values in held.items():
        known = np.isfinite(values)
        line = _lines(scipy.interpolate.CubicSpline(time[known], values[known])(even))[kept]
        data[f"{name}_amplitude"] = ("order", np.abs(line))
        data[f"{name}_phase"] = ("order", np.angle(line))
    data.attrs["method"] = f"Hann window over {cycles} forcing cycles"
    return describe(data, "vibroimpact.fourier_spectrum", {"frequency": sine.frequency})
