"""Time histories: one motion, sampled, with every contact and detachment at its exact time."""

from __future__ import annotations

import math
import warnings

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import batch, record
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator, State, to_si
from vibroimpact.model.units import DIMENSIONLESS
from vibroimpact.response.free_flight import check_bounded
from vibroimpact.response.start import as_state, components, engine_rig, engine_state
from vibroimpact.response.variables import COMPONENTS, describe, oscillator_parameters

_EVENTS_AT_ONCE = 20_000


def simulate(
    oscillator: Oscillator,
    excitation: Harmonic,
    cycles: float,
    start: State | xr.DataArray | xr.Dataset | None = None,
    samples: int = 256,
    *,
    max_events: int = 10_000,
) -> xr.Dataset:
    """Follow a motion for a number of forcing cycles.

    Parameters
    ----------
    oscillator, excitation
        What vibrates, and what shakes it.
    cycles
        How long, in forcing cycles, greater than 0; the last may be incomplete.
    start
        Where the motion starts: a `State`, the dataset of an earlier call or its
        ``final_state`` (which carries the phase on); None is rest.
    samples
        Samples per forcing cycle. They only look: no value depends on their number. With 0
        only ``final_state`` is returned, and memory does not grow with `cycles`.
    max_events
        Contacts and detachments in one forcing cycle at which the motion is given up.

    Returns
    -------
    xarray.Dataset
        Dims ``time`` (s; the end included) and ``event``. ``left_bumper`` and its clearance
        have the paper's signs (eq. 4). ``final_state`` can be given as `start`. If the
        motion was given up, what was found until then, and the attribute ``status``
        says why.

    Raises
    ------
    InputError
        If a value cannot be used, or an undamped mass that no bumper stops is at resonance.
    """
    length = to_si(cycles, DIMENSIONLESS, "cycles", above=0.0)
    for field, value, least in (("samples", samples, 0), ("max_events", max_events, 1)):
        if isinstance(value, bool) or not isinstance(value, int) or value < least:
            raise InputError(f"{field}: {value!r}; a whole number of at least {least} is accepted")
    check_bounded(oscillator, excitation.frequency, "frequency")
    state = as_state(start)
    phase = excitation.phase if state.phase is None else state.phase
    vector = engine_state(oscillator, state)

    count = math.ceil(length * samples - 1e-9) + 1 if samples else 0
    out = np.full((count, record.SAMPLE), np.nan)
    capacity = max_events + 1 + (_EVENTS_AT_ONCE if samples else 0)
    buffer = np.empty((capacity, record.EVENT))
    found = []
    rig = engine_rig(oscillator)
    at = 0
    outcome = int(Status.DONE)
    while at < length and outcome == Status.DONE:
        at, events, outcome = batch.trajectory(
            rig,
            excitation.amplitude,
            excitation.frequency,
            phase,
            vector,
            float(at),
            length,
            samples,
            max_events,
            out[at * samples :],
            buffer,
        )
        if samples:
            found.append(buffer[:events].copy())
    status = Status(outcome)
    if status is not Status.DONE:
        # The cycle that was given up is left out; its events until then are kept.
        whole = max(at - 1, 0)
        warnings.warn(
            f"simulate stopped in cycle {whole}: {status.advice}", RuntimeWarning, stacklevel=2
        )
        out = out[: whole * samples]
        length = float(whole)
    data = xr.Dataset(
        {"final_state": ("component", components(vector, phase + 2.0 * math.pi * (length % 1.0)))},
        coords={"component": COMPONENTS},
    )
    if samples:
        complete = status is Status.DONE
        _add_samples(
            data, oscillator, excitation, phase, out, samples, length if complete else None
        )
        _add_events(data, np.concatenate(found), 1.0 / excitation.frequency)
    data.attrs["status"] = status.advice
    return describe(
        data,
        "vibroimpact.simulate",
        {
            "oscillator": oscillator_parameters(oscillator),
            "amplitude": excitation.amplitude,
            "frequency": excitation.frequency,
            "phase": phase,
            "cycles": length,
        },
    )


def _add_samples(
    data: xr.Dataset,
    oscillator: Oscillator,
    excitation: Harmonic,
    phase: float,
    out: NDArray[np.float64],
    samples: int,
    length: float | None,
) -> None:
    whole, part = np.divmod(np.arange(len(out)), samples)
    share = part / samples
    if length is not None:  # the last value is the end itself, which need not lie on the grid
        whole[-1], share[-1] = math.floor(length), length % 1.0
    cycle = whole + share
    time = cycle / excitation.frequency
    data.coords["time"] = time
    data.coords["cycle"] = ("time", cycle)
    u = out[:, record.DISPLACEMENT]
    right, left = out[:, record.RIGHT_FACE], out[:, record.LEFT_FACE]
    touching = out[:, record.CONTACT]
    absent = np.full(len(u), np.nan)

    def clearance(
        gap: float | None, distance: NDArray[np.float64], side: int
    ) -> NDArray[np.float64]:
        # Eq. 4; no bumper, no clearance; in contact it is zero by definition.
        return absent if gap is None else np.where(touching == side, 0.0, gap + distance)

    right_gap = oscillator.right.gap if oscillator.right else None
    left_gap = oscillator.left.gap if oscillator.left else None
    values = {
        "displacement": u,
        "velocity": out[:, record.VELOCITY],
        "acceleration": out[:, record.ACCELERATION],
        "base_acceleration": excitation.amplitude * np.sin(2.0 * np.pi * share + phase),
        "right_bumper": right,
        "left_bumper": left,
        "right_clearance": clearance(right_gap, right - u, 1),
        "left_clearance": clearance(left_gap, u - left, -1),
        "contact": touching,
    }
    for name, value in values.items():
        data[name] = ("time", value.astype(np.int64) if name == "contact" else value + 0.0)


def _add_events(data: xr.Dataset, events: NDArray[np.float64], period: float) -> None:
    columns = {
        "event_cycle_time": record.E_TIME,
        "event_displacement": record.E_U,
        "event_velocity": record.E_V,
        "event_right_bumper": record.E_RIGHT,
        "event_left_bumper": record.E_LEFT,
        "event_acceleration_before": record.E_BEFORE,
        "event_acceleration_behind": record.E_BEHIND,
    }
    data["event_time"] = (
        "event",
        events[:, record.E_CYCLE] * period + events[:, record.E_TIME],
    )
    for name, column in (
        ("event_cycle", record.E_CYCLE),
        ("event_contact", record.E_KIND),
        ("event_side", record.E_SIDE),
    ):
        data[name] = ("event", events[:, column].astype(np.int64))
    for name, column in columns.items():
        data[name] = ("event", events[:, column] + 0.0)  # no negative zeros
