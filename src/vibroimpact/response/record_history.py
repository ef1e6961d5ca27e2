"""The straight lines of a record, and its values at samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import record_forcing
from vibroimpact.errors import InputError
from vibroimpact.model import Record
from vibroimpact.model.argument_types import MOST_SAMPLES

_Array = NDArray[np.float64]


def base_acceleration(record: Record, time: _Array, samples: int) -> _Array:
    """Return the base acceleration at the samples; exactly the record's own where it has one."""
    values = record.at(time)
    own = values[: len(record.acceleration) * samples : samples]
    own[:] = record.acceleration[: len(own)]
    return values


def straight(record: Record, tail: float) -> _Array:
    """The record's straight lines, and those of no acceleration after it."""
    values, step = record.acceleration, record.step
    if tail / step > MOST_SAMPLES:
        raise InputError(
            f"tail: {tail:g} s has {tail / step:.3g} time steps of the record; pass at most "
            f"{MOST_SAMPLES * step:g} s"
        )
    whole = int(tail / step)
    rest = tail - whole * step
    lengths = [step] * whole + ([rest] if rest > 1e-9 * step else [])
    moving = len(values) - 1
    lines = np.zeros((moving + len(lengths), record_forcing.LINE))
    lines[:moving, record_forcing.BEGINS] = values[:-1]
    lines[:moving, record_forcing.SLOPE] = np.diff(values) / step
    lines[:moving, record_forcing.LASTS] = step
    lines[moving:, record_forcing.LASTS] = lengths
    return lines
