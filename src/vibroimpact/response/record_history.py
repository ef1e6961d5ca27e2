"""A motion through a record, and the free vibration after it."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import COMPONENTS, describe, oscillator_parameters
from vibroimpact.datasets.stops import stops_of
from vibroimpact.engine import record_forcing
from vibroimpact.engine.motion import U
from vibroimpact.engine.observers import record as observed
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, warn_of_result
from vibroimpact.model import AssemblyState, Record, State, equilibrium
from vibroimpact.model.argument_types import MOST_SAMPLES, check_samples
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import as_state, components, engine_rig, engine_state
from vibroimpact.response.history_variables import (
    EVENTS_AT_ONCE,
    listed,
    sampled,
    transmitted,
)
from vibroimpact.response.softening_limit import ended
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]


def through(
    rig: Rig,
    tail: float,
    start: State | AssemblyState | xr.DataArray | xr.Dataset | None,
    samples: int,
    max_events: int,
    progress: Progress | None = None,
) -> xr.Dataset:
    """What `simulate` returns of a record; `tail` in s."""
    oscillator, record = rig.oscillator, rig.record
    lines = straight(record, tail)
    check_samples(len(lines), samples, "samples", "time steps")
    state = equilibrium(oscillator) if start is None else as_state(start)
    vector = engine_state(oscillator, state)
    first = components(vector, 0.0)
    numbers = engine_rig(rig)
    ends = record.duration + tail
    count = int(np.ceil(ends / record.step * samples - 1e-6)) + 1 if samples else 0
    out = np.empty((observed.SAMPLE, count))
    buffer = np.empty((max_events + 1 + (EVENTS_AT_ONCE if samples else 0), observed.EVENT))
    steepest = float(np.abs(lines[:, record_forcing.SLOPE]).max())
    found = []
    at, outcome = 0, int(Status.DONE)
    calls = Calls(len(lines), progress)
    while at < len(lines) and outcome == Status.DONE:
        at, events, outcome = record_forcing.follow(
            numbers,
            record.peak,
            steepest,
            lines[: int(calls.end(at))],
            vector,
            at,
            samples,
            record.step,
            max_events,
            out,
            buffer,
        )
        found.append(buffer[:events].copy())
    del lines  # a third of the result
    status = Status(outcome)
    told = ended(oscillator, status, out[observed.DISPLACEMENT], vector[U])
    time = np.minimum(np.arange(count) * (record.step / max(samples, 1)), ends)
    if status is not Status.DONE:
        # The step that was given up is left out; its events until then are kept.
        finished = max(at - 1, 0)
        stopped = f"simulate stopped {finished * record.step:g} s into the record: {told.advice}"
        warn_of_result(stopped)
        out, time = out[:, : finished * samples], time[: finished * samples]
    variables: dict[str, Any] = {"final_state": ("component", components(vector, 0.0))}
    coordinates: dict[str, Any] = {"component": COMPONENTS}
    if samples:
        coordinates["stop"] = stops_of(oscillator)
        coordinates["time"] = time
        variables["initial_state"] = ("component", first)
        variables |= sampled(out, oscillator)
        variables["base_acceleration"] = ("time", base_acceleration(record, time, samples))
        events = listed(found, record.step, oscillator)
        # A record has steps, not cycles.
        variables |= {name: one for name, one in events.items() if "cycle" not in name}
        variables |= transmitted(variables, oscillator)
    variables["status"] = int(told)
    data = xr.Dataset(variables, coordinates)
    if status is Status.DONE and told is not status:
        warn_of_result(f"simulate: {told.advice}")
    data.attrs["message"] = told.advice
    parameters = {
        "oscillator": oscillator_parameters(oscillator),
        "record": {"samples": len(record.acceleration), "step": record.step, "peak": record.peak},
        "tail": tail,
    }
    return describe(data, "vibroimpact.simulate", parameters, record.about.notes)


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
