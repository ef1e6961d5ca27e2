"""Exact motions of a rig at the times of a measurement, from given states."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch, record_forcing
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.status import DONE
from vibroimpact.model import State
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.engine_system import engine_rig
from vibroimpact.response.record_history import straight

Array = NDArray[np.float64]

_SAMPLES = 400
"""In a forcing cycle, between which a cubic is laid: its error is 1e-6 of a tenth harmonic."""
_FINER = 2
"""Samples for each of a measurement, at least: a jump is spread over one of them."""
_MAX_EVENTS = 2000
_COLUMNS = {
    "displacement": record_layout.DISPLACEMENT,
    "velocity": record_layout.VELOCITY,
    "acceleration": record_layout.ACCELERATION,
}


class SampledMotion(NamedTuple):
    """A motion at some times."""

    values: dict[str, Array]
    end: tuple[float, float]
    """Displacement (m) and velocity (m/s) at the last time."""
    reach: tuple[float, float]
    """How far it goes to the right and to the left (m), between these times as well."""


class Joined(NamedTuple):
    """What a rig does in a test, window by window."""

    values: dict[str, Array]
    """At all times, by channel."""
    gaps: Array
    """Between the end of each window and the beginning of the next."""
    reach: tuple[float, float]
    """How far it goes to the right and to the left (m)."""


def under_sine(rig: Rig, start: State | Array, time: Array) -> SampledMotion | None:
    """The motion under a sine from a state at the first of the times; None if it was given up.

    The phase is that at the first time. Displacement and velocity between samples are cubics with
    the right slopes; the acceleration, which jumps at contacts, is a straight line.
    """
    oscillator, shaken = rig.oscillator, rig.sine
    vector = engine_state(oscillator, start) if isinstance(start, State) else start.copy()
    at = (time - time[0]) * shaken.frequency
    length = max(float(at[-1]), 1.0 / _SAMPLES)
    samples = max(_SAMPLES, math.ceil(_FINER * (len(at) - 1) / length))
    out = np.empty((record_layout.SAMPLE, math.ceil(length * samples - 1e-9) + 1))
    buffer = np.empty((_MAX_EVENTS + 1 + 20_000, record_layout.EVENT))
    numbers, done, outcome = engine_rig(rig), 0, int(DONE)
    while done < length and outcome == DONE:
        done, _, outcome = batch.trajectory(
            numbers, shaken.amplitude, shaken.frequency, shaken.phase, vector, float(done), length,
            samples, _MAX_EVENTS, out, buffer,
        )  # fmt: skip
    if outcome != DONE:
        return None
    grid = np.minimum(np.arange(out.shape[1]) / samples, length)
    base = shaken.at(2.0 * np.pi * grid + shaken.phase) if shaken.moves_base else 0.0 * grid
    seconds = np.asarray(grid / shaken.frequency, dtype=np.float64)
    wanted: Array = at / shaken.frequency
    return _between(out, seconds, wanted, base)


def under_record(rig: Rig, start: State, time: Array) -> SampledMotion | None:
    """The motion under a record from a state at its beginning; None if it was given up.

    The times are those since the beginning of the record.
    """
    oscillator, record = rig.oscillator, rig.record
    vector = engine_state(oscillator, start)
    lines = straight(record, 0.0)
    out = np.empty((record_layout.SAMPLE, len(lines) + 1))
    buffer = np.empty((_MAX_EVENTS + 1 + 20_000, record_layout.EVENT))
    steepest = float(np.abs(lines[:, record_forcing.SLOPE]).max())
    numbers, done, outcome = engine_rig(rig), 0, int(DONE)
    while done < len(lines) and outcome == DONE:
        done, _, outcome = record_forcing.follow(
            numbers, record.peak, steepest, lines, vector, done, 1, record.step, _MAX_EVENTS, out,
            buffer,
        )  # fmt: skip
    if outcome != DONE:
        return None
    grid: Array = np.arange(out.shape[1], dtype=np.float64) * record.step
    return _between(out, grid, time, record.at(grid))


def _between(out: Array, grid: Array, time: Array, base: Array) -> SampledMotion:
    """Values at times between the samples of a motion."""
    step = np.diff(grid)
    keep = np.concatenate([[True], step > 1e-12 * max(grid[-1], 1e-300)])
    grid, out, base = grid[keep], out[:, keep], base[keep]
    i = np.clip(np.searchsorted(grid, time, side="right") - 1, 0, max(len(grid) - 2, 0))
    u = out[record_layout.DISPLACEMENT]
    reach = float(u.max()), -float(u.min())
    if len(grid) < 2:
        start = float(out[0, 0]), float(out[1, 0])
        return SampledMotion(
            {n: np.full(len(time), out[c, 0]) for n, c in _COLUMNS.items()}, start, reach
        )
    h = grid[i + 1] - grid[i]
    s = (time - grid[i]) / h
    rows = {name: out[column] for name, column in _COLUMNS.items()}
    slopes = {
        "displacement": rows["velocity"],
        "velocity": rows["acceleration"] - base,
    }
    values = {"acceleration": rows["acceleration"][i] * (1.0 - s) + rows["acceleration"][i + 1] * s}
    for name, slope in slopes.items():
        y, k = rows[name], slope
        values[name] = (
            (1.0 + 2.0 * s) * (1.0 - s) ** 2 * y[i]
            + s * (1.0 - s) ** 2 * h * k[i]
            + s**2 * (3.0 - 2.0 * s) * y[i + 1]
            + s**2 * (s - 1.0) * h * k[i + 1]
        )
    last = (float(values["displacement"][-1]), float(values["velocity"][-1]))
    return SampledMotion(values, last, reach)
