"""Motions that go beyond where a softening isolator pushes back to rest."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact.engine.status import Status
from vibroimpact.model import Oscillator


def judged(oscillator: Oscillator, outcome: ArrayLike, farthest: ArrayLike) -> NDArray[np.int64]:
    """How computations ended, `Status.REVERSED` where the isolator pushed the mass away.

    Parameters
    ----------
    oscillator
        What vibrates.
    outcome
        How they ended, each a `Status`.
    farthest
        The largest displacement of each without its sign (m); NaN where it is not known.
    """
    codes = np.asarray(outcome).astype(np.int64)
    reach = oscillator.isolator.restoring_reach
    if reach == np.inf:
        return codes
    with np.errstate(invalid="ignore"):
        beyond = np.asarray(farthest) > reach
    ended = np.isin(codes, (Status.DONE, Status.NOT_SETTLED)) & beyond
    # What is pushed away farther and farther leaves the range of numbers.
    return np.where(ended | (codes == Status.NOT_FINITE), int(Status.REVERSED), codes)


def ended(oscillator: Oscillator, status: Status, *displacements: ArrayLike) -> Status:
    """How a motion ended that was seen at these displacements (m)."""
    if oscillator.isolator.restoring_reach == np.inf:
        return status
    known = np.abs(np.concatenate([np.ravel(one) for one in displacements]))
    known = known[np.isfinite(known)]
    return Status(int(judged(oscillator, status, known.max() if known.size else np.nan)))
