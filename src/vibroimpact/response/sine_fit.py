"""The sine in a measured signal: its frequency, size and phase."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]


class Sine(NamedTuple):
    """``mean + amplitude sin(2π frequency t + phase)``, the best fit of a signal."""

    frequency: float
    """Hz."""
    amplitude: float
    phase: float
    """rad, at t = 0."""
    mean: float
    rest: float
    """Root mean square of what it leaves, over that of the sine."""


def fitted_sine(time: _Array, values: _Array, frequency: float | None = None) -> Sine | None:
    """Fit one sine by least squares; None where there are fewer than 8 samples, or no signal.

    Parameters
    ----------
    time, values
        Samples (s), evenly spaced or not; NaN are left out.
    frequency
        Hz, if it is known; otherwise that of the highest line of the spectrum, refined.
    """
    known = np.isfinite(time) & np.isfinite(values)
    t, y = time[known], values[known]
    if len(t) < 8 or np.ptp(y) == 0.0:
        return None
    if frequency is None:
        from scipy.optimize import minimize_scalar  # which takes long to load

        even = np.linspace(t[0], t[-1], len(t))
        line = np.abs(np.fft.rfft((np.interp(even, t, y) - y.mean()) * np.hanning(len(t))))
        top = int(np.argmax(line[1:])) + 1
        width = 1.0 / (t[-1] - t[0])
        optimum = minimize_scalar(
            lambda f: _linear(t, y, f)[1],
            bounds=(max(top - 1.5, 0.25) * width, (top + 1.5) * width),
            method="bounded",
            options={"xatol": 1e-10 * width},
        )
        frequency = float(optimum.x)
    (mean, sine, cosine), left = _linear(t, y, frequency)
    size = float(np.hypot(sine, cosine))
    if size == 0.0:
        return None
    rest = float(np.sqrt(left / len(t)) / (size / np.sqrt(2.0)))
    return Sine(frequency, size, float(np.arctan2(cosine, sine)), float(mean), rest)


def _linear(t: _Array, y: _Array, frequency: float) -> tuple[_Array, float]:
    """Mean, sine and cosine of a given frequency, and the sum of squares that they leave."""
    angle = 2.0 * np.pi * frequency * t
    basis = np.stack([np.ones_like(t), np.sin(angle), np.cos(angle)], axis=1)
    weights = np.linalg.lstsq(basis, y, rcond=None)[0]
    return weights, float(np.sum((y - basis @ weights) ** 2))


def forcing_sine(
    time: _Array, base: _Array | None, moved: _Array | None, frequency: float | None = None
) -> Sine | None:
    """The sine that shakes a measured motion: that of the base, or the mass's own highest line."""
    for signal in (base, moved):
        if signal is not None and (sine := fitted_sine(time, signal, frequency)) is not None:
            return sine
    return None


def slope(time: _Array, values: _Array, sine: Sine | None) -> _Array:
    """The derivative of a measured signal, of a cubic through each tenth of the sine's cycle."""
    from scipy.signal import savgol_filter  # which takes a third of a second to load

    step = float(np.median(np.diff(time)))
    width = 0 if sine is None else int(0.1 / (sine.frequency * step)) // 2 * 2 + 1
    even = np.allclose(np.diff(time), step, rtol=0.05)
    if not even or not 5 <= width < len(values):
        return np.gradient(values, time)
    derivative: _Array = savgol_filter(values, width, 3, deriv=1, delta=step)
    return derivative
