"""Channels: what sensors make of a motion, and what samples show by themselves.

That is their noise, their jumps, their integral, and the motion that they are samples of.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from vibroimpact.response.sine_fit import forcing_sine, slope

Array = NDArray[np.float64]

_JUMP = 5.0
"""Standard deviations by which a step exceeds its neighbours where a channel jumps."""


def noise_of_channel(values: Array) -> float:
    """Standard deviation of white noise on smooth samples, by their third or fifth differences.

    What is left of the signal makes either too large, hence the smaller one.
    """
    known = values[np.isfinite(values)]
    if len(known) < 8:
        return 0.0
    return min(
        float(np.median(np.abs(np.diff(known, n)))) / 0.6745 / math.sqrt(math.comb(2 * n, n))
        for n in (3, 5)
    )


def doubt(values: Array, noise: float) -> Array:
    """By how much the two samples beside a jump are less certain than the noise.

    When a channel jumps is not known better than the step between its samples, so that each may be
    off by half the jump. A step is a jump if it exceeds both its neighbours by several standard
    deviations.
    """
    factors = np.ones(len(values))
    step = np.abs(np.diff(values))
    over = step[1:-1] - np.maximum(step[:-2], step[2:])
    for i in np.flatnonzero(over > _JUMP * noise):
        beside = slice(i + 1, i + 3)
        factors[beside] = np.maximum(factors[beside], math.hypot(1.0, 0.5 * over[i] / noise))
    return factors


def integrated(time: Array, values: Array) -> Array:
    """The integral of a signal without its mean and its drift."""
    steps = np.diff(time)
    whole = np.concatenate([[0.0], np.cumsum(0.5 * steps * (values[1:] + values[:-1]))])
    basis = np.vander(time / max(time[-1], 1e-300), 3)
    kept: Array = whole - basis @ np.linalg.lstsq(basis, whole, rcond=None)[0]
    return kept


def sensed(name: str, values: Array, sensors: dict[str, float]) -> Array:
    """What a sensor makes of values: η and velocities are right; an excursion has no offset."""
    kind = name.partition("_")[0]
    if kind not in ("displacement", "acceleration"):
        return values
    scale = sensors[f"{kind}_scale"]
    if name.endswith("excursion"):
        return values * abs(scale)
    return values * scale + sensors[f"{kind}_offset"]


def corrected(name: str, shown: Array, sensors: dict[str, float]) -> Array:
    """The values of a history of which a sensor makes what it shows."""
    if name == "velocity":
        return shown
    return (shown - sensors[f"{name}_offset"]) / (sensors[f"{name}_scale"] or 1.0)


def kinematics(time: Array, known: dict[str, Array], base: Array | None) -> tuple[Array, Array]:
    """Displacement and velocity at all times, measured or derived from what is known."""
    sine = forcing_sine(time, base, next(iter(known.values())))
    if "displacement" in known:
        u = known["displacement"]
    else:
        driven = np.zeros_like(time) if base is None else np.nan_to_num(base)
        pulled = known.get("acceleration")
        speed = known["velocity"] if pulled is None else integrated(time, pulled - driven)
        u = integrated(time, speed)
    v = known["velocity"] if "velocity" in known else slope(time, u, sine)
    return u, v
