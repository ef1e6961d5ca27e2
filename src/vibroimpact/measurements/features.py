"""Peaks, jumps and hysteresis of measured curves, with the resolution of the steps.

The features are those of `vibroimpact.response.resonance` for computed sweeps, with thresholds
above the noise of the measurement. The noise is estimated from the differences between the two
directions where both follow the same motion, or from the third differences of a single curve.
"""

from __future__ import annotations

import math

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.measurements.names import CURVES as MEASURED
from vibroimpact.response import resonance
from vibroimpact.response.curve_pair import Swept, judged, swept
from vibroimpact.response.peaks import CURVES, PROMINENCE
from vibroimpact.response.resonance import APART, Features

_NOISES = 6.0
"""Smallest difference of two motions, and smallest prominence of a peak, in standard deviations."""
_ENOUGH = 8
"""Number of values that an estimate requires."""
_APART = 8.0
"""Distance of a value from the median at its frequency, in standard deviations, above which the
value is not noise."""
_QUIET = 1e-3
"""Lower limit of the noise, as a share. Relative values are reported only for values above this
share."""
_WORDS = {
    "eta_a": "η_a",
    "eta_d": "η_d",
    "acceleration_excursion": "E_a",
    "displacement_excursion": "E_d",
    "acceleration_max": "the acceleration's maximum",
    "acceleration_min": "the acceleration's minimum",
    "displacement_max": "the displacement's maximum",
    "displacement_min": "the displacement's minimum",
}
_LOW, _OF_NORMAL = 0.3, 0.3853
"""A quantile, and its value for the absolute value of a standard normal variable."""


def outliers(data: xr.Dataset) -> dict[str, NDArray[np.bool_]]:
    """Find repeated values that lie far from the median at their frequency.

    Such values belong to another motion.

    Returns
    -------
    dict
        For each variable that was measured repeatedly: flags over ``direction``, ``frequency`` and
        ``repeat``.
    """
    off: dict[str, NDArray[np.float64]] = {}
    for name in MEASURED:
        if name in data and "repeat" in data[name].dims:
            held = data[name].transpose("direction", "frequency", "repeat").values
            known = np.isfinite(held)
            some = np.where(known.any(axis=2, keepdims=True), held, 0.0)
            middle = np.nanmedian(some, axis=2, keepdims=True)
            large = np.abs(middle) > _QUIET * np.abs(held[known]).max(initial=0.0)
            off[name] = np.abs(
                np.where(known & large, held / np.where(large, middle, 1.0) - 1.0, 0.0)
            )
    if not off:
        return {}
    apart = np.concatenate([one[one > 0.0] for one in off.values()])
    few = len(apart) < _ENOUGH
    size = _of_neighbours(swept(data)) if few else 1.4826 * float(np.median(apart))
    return {name: one > _APART * max(size, _QUIET) for name, one in off.items()} if size else {}


def noise_of(data: xr.Dataset | Swept) -> float:
    """Estimate the standard deviation of measured values, as a share of the value; 0 if unknown.

    The estimate is robust. If frequencies were measured repeatedly, it is computed from the
    repeated values.
    """
    if isinstance(data, xr.Dataset) and (repeated := _of_repeats(data)):
        return repeated
    return _of_neighbours(data if isinstance(data, Swept) else swept(data))


def _of_neighbours(both: Swept) -> float:
    """Estimate the noise from differences between directions or frequencies; 0 if there are few."""
    changes: list[float] = []
    for name in CURVES:
        values = getattr(both, name)
        with np.errstate(divide="ignore", invalid="ignore"):
            logs = np.log(values)
        if len(logs) == 2:
            change = (logs[0] - logs[1]) / np.sqrt(2.0)
        else:
            # Third differences leave little of a smooth curve, and √20 times the noise.
            change = np.diff(logs[0][np.isfinite(logs[0])], 3) / np.sqrt(20.0)
        change = np.abs(change[np.isfinite(change)])
        changes += change.tolist()
    # The directions differ by more than noise in a hysteresis, hence the lower values alone.
    return float(np.quantile(changes, _LOW)) / _OF_NORMAL if len(changes) >= _ENOUGH else 0.0


def _of_repeats(data: xr.Dataset) -> float:
    """Estimate the noise from repeated values; 0 if there are few."""
    squares: list[float] = []
    spare = 0
    far = outliers(data)
    for name in MEASURED:
        if name in data and "repeat" in data[name].dims:
            values = data[name].transpose("direction", "frequency", "repeat").values
            values = np.where(far[name], np.nan, values) if name in far else values
            held = values.reshape(-1, values.shape[-1])
            held = held[(np.isfinite(held).sum(axis=1) > 1)]
            mean = np.nanmean(held, axis=1, keepdims=True)
            held, mean = held[mean[:, 0] != 0.0], mean[mean[:, 0] != 0.0]
            squares.append(float(np.nansum((held / mean - 1.0) ** 2)))
            spare += int(np.isfinite(held).sum()) - len(held)
    # In any order the same: a sensor that is turned round swaps maxima and minima.
    return math.sqrt(math.fsum(squares) / spare) if spare >= _ENOUGH else 0.0


def measured_features(data: xr.Dataset) -> Features:
    """Find the peaks, jumps and hysteresis of measured curves.

    Returns
    -------
    Features
        The same features as those of a computed sweep. A jump lies between two neighbouring
        frequencies. Their distance is the resolution of the measurement.
    """
    both = swept(data)
    noise = noise_of(both)
    apart = max(APART, _NOISES * noise)
    return resonance.features(
        both, apart=apart, unsettled_apart=apart, prominence=max(PROMINENCE, _NOISES * noise)
    )


def in_words(data: xr.Dataset) -> list[str]:
    """Describe the features of measured curves, with one line per feature."""
    both = swept(data)
    features = measured_features(data)
    step = np.diff(both.frequency)
    lines = []
    if len(step):
        widths = (
            f"{step.min():.4g}" if np.ptp(step) < 1e-6 else f"{step.min():.4g} to {step.max():.4g}"
        )
        lines.append(
            f"{len(both.frequency)} frequencies, {both.frequency[0]:.4g} to "
            f"{both.frequency[-1]:.4g} Hz, in steps of {widths} Hz: features between two steps are "
            "not detected"
        )
    lines.append(f"noise: {100.0 * noise_of(data):.2g} % of a value")
    names = {"eta_a": judged(data, "acceleration"), "eta_d": judged(data, "displacement")}
    lines += [
        f"{peak.direction}: peak of {_WORDS[name]} at "
        f"{peak.frequency:.4g} Hz{' (the end of the curve)' if peak.at_end else ''}"
        for peak in features.peaks
        if peak.primary and (name := names[peak.curve]) is not None
    ]
    lines += [
        f"{kind}: only {side} were measured; the motion on the other side is unknown"
        for kind in ("acceleration", "displacement")
        for end, side in (("max", "maxima"), ("min", "minima"))
        if f"{kind}_{end}" in names.values()
    ]
    for jump in features.jumps:
        way = "up" if jump.upward else "down"
        low, high = sorted((jump.before, jump.after))
        lines.append(f"{jump.direction}: jump {way} between {low:.4g} and {high:.4g} Hz")
    lines += [
        f"hysteresis, {item.order}: {item.low:.4g} to {item.high:.4g} Hz"
        for item in features.hysteresis
    ]
    return lines
