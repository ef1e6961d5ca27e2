"""What the samples of one channel tell by themselves: their noise, their jumps, their integral."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

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
    found = np.ones(len(values))
    step = np.abs(np.diff(values))
    over = step[1:-1] - np.maximum(step[:-2], step[2:])
    for i in np.flatnonzero(over > _JUMP * noise):
        beside = slice(i + 1, i + 3)
        found[beside] = np.maximum(found[beside], math.hypot(1.0, 0.5 * over[i] / noise))
    return found


def integrated(time: Array, values: Array) -> Array:
    """The integral of a signal without its mean and its drift."""
    steps = np.diff(time)
    whole = np.concatenate([[0.0], np.cumsum(0.5 * steps * (values[1:] + values[:-1]))])
    basis = np.vander(time / max(time[-1], 1e-300), 3)
    kept: Array = whole - basis @ np.linalg.lstsq(basis, whole, rcond=None)[0]
    return kept
