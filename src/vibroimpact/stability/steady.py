"""Steady motion: what a rig settles on, measured exactly and named."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import measure
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator, State
from vibroimpact.response.contacts import contacts
from vibroimpact.response.phases import measured, phases, recorded
from vibroimpact.response.simulate import simulate
from vibroimpact.response.start import as_state, components
from vibroimpact.response.variables import COMPONENTS, describe, motion_parameters
from vibroimpact.stability.exponents import DISCARD
from vibroimpact.stability.growth import judge_orbit, judge_wandering
from vibroimpact.stability.settled import Settled, apart, follow, mirrored, reach, settle

_Array = NDArray[np.float64]

ANTISYMMETRIC = 1e-8
"""Distance from the own mirror image, over the motion's size, below which they are one."""


def steady(
    oscillator: Oscillator,
    excitation: Harmonic,
    start: State | xr.DataArray | xr.Dataset | None = None,
    samples: int = 256,
    *,
    window: int = 200,
    tolerance: float = 1e-12,
    max_cycles: int = 2000,
    exponent_cycles: int = 20_000,
    max_events: int = 10_000,
) -> xr.Dataset:
    """Follow a motion until it is steady; record, measure and name what it has become.

    Parameters
    ----------
    oscillator, excitation
        What vibrates, and what shakes it.
    start
        Where the motion starts; None is rest.
    samples
        Samples per forcing cycle, at least 1. They only look: no other value depends on them.
    window
        Forcing cycles that are recorded of a motion that does not settle.
    tolerance, max_cycles, max_events
        As in `sweeps`.
    exponent_cycles
        Forcing cycles over which the growth of disturbances is averaged where it decides what
        kind of motion it is; of a periodic motion the exponents follow from one period.

    Returns
    -------
    xarray.Dataset
        What `simulate` gives, over one period or over the window; the `contacts` of it; and
        ``motion`` ("periodic", "quasi-periodic", "chaotic" or "undecided") with ``period``,
        ``exponents``, ``exponents_uncertainty`` and ``exponents_cycles``, whether it is
        ``stable`` and ``antisymmetric``, the exact extremes, ``eccentricity``, impacts and
        energies per forcing cycle. The attribute ``evidence`` says why it is called so. If the
        motion met the event limit, the record ends there, and ``status`` says so.

    Raises
    ------
    InputError
        If a value cannot be used, or an undamped mass that no bumper stops is at resonance.
    """
    _check(
        samples=samples,
        window=window,
        max_cycles=max_cycles,
        exponent_cycles=exponent_cycles,
        max_events=max_events,
    )
    begin = as_state(start)
    found = settle(oscillator, excitation, begin, tolerance, max_cycles, max_events)
    if found.status not in (Status.DONE, Status.NOT_SETTLED):
        return _given_up(found, begin, samples, window, max_events)
    return describe_motion(found, samples, window, exponent_cycles, max_events)


def describe_motion(
    found: Settled, samples: int, window: int, exponent_cycles: int, max_events: int
) -> xr.Dataset:
    """Name a motion, record it and measure it."""
    state = found.state.copy()
    used = found.cycles
    if found.period:
        kind, damping, cycles = judge_orbit(found, max_events)
    else:
        kind, damping, cycles = judge_wandering(found, state, exponent_cycles, max_events)
        used += cycles + DISCARD
    stable = {"chaotic": 0, "periodic": int(bool(kind.exponents[0] < 0.0))}.get(kind.motion, -1)
    data = _record(found, state, samples, kind.period or window, max_events)
    if data.attrs["status"] != Status.DONE.advice:
        kind = kind._replace(motion="undecided", period=0)
        stable = -1
    frequency = found.excitation.frequency
    distance = _mirror_distance(found, state, kind.period, max_events)
    scalars: dict[str, Any] = {
        "motion": kind.motion,
        "period": kind.period,
        "stable": stable,
        "cycles": used,
        "exponents_cycles": cycles,
        "effective_damping": damping * frequency,
        "antisymmetric": bool(distance <= ANTISYMMETRIC),
        "mirror_distance": distance,
        "exponents": ("exponent", kind.exponents * frequency),
        "exponents_uncertainty": ("exponent", kind.uncertainty * frequency),
    }
    data.attrs["evidence"] = kind.evidence
    return _measured(data, scalars)


def _check(**values: int) -> None:
    for field, value in values.items():
        if isinstance(value, bool) or not isinstance(value, int) or value < 1:
            raise InputError(f"{field}: {value!r}; a whole number of at least 1 is accepted")


def _start(found: Settled, state: _Array) -> State:
    values = dict(zip(COMPONENTS, components(state, found.excitation.phase), strict=True))
    return State(**{**values, "contact": int(values["contact"])})


def _record(
    found: Settled, state: _Array, samples: int, cycles: int, max_events: int
) -> xr.Dataset:
    return simulate(
        found.oscillator,
        found.excitation,
        cycles,
        _start(found, state),
        samples,
        max_events=max_events,
    )


def _mirror_distance(found: Settled, state: _Array, period: int, max_events: int) -> float:
    """Distance of a periodic motion from its own mirror image half a period later.

    Half a period must turn the forcing round, so that the period is an odd number of cycles.
    """
    if period % 2 == 0:
        return math.nan
    half = follow(found, state, 0.5 * period, max_events)
    return apart(found, mirrored(half), state, reach(found, state))


def _measured(data: xr.Dataset, scalars: dict[str, Any]) -> xr.Dataset:
    """Add the scalars, the contact log, the exact extremes, and what follows from them."""
    data = data.assign(period=scalars["period"])  # tells the log that the end is the beginning
    origin = recorded(data)
    every = phases(data)
    rows = measured(origin, every)
    rig, shaken = origin.oscillator, origin.excitation
    side = every.contact
    gaps = [b.gap if b else 0.0 for b in (rig.right, rig.left)]
    face = np.where(side == 1, gaps[0], np.where(side == -1, -gaps[1], 0.0))
    # A left contact is measured towards the bumper.
    least = np.where(side == -1, -rows[:, measure.X_MOST], rows[:, measure.X_LEAST]) + face
    most = np.where(side == -1, -rows[:, measure.X_LEAST], rows[:, measure.X_MOST]) + face
    high, low = float(most.max()), float(least.min())
    top, bottom = float(rows[:, measure.A_MOST].max()), float(rows[:, measure.A_LEAST].min())
    log = contacts(data)
    cycles = max(origin.cycles, 1.0)
    damping = [b.damping if b else 0.0 for b in (rig.right, rig.left)]
    pressed = np.where(side == 1, damping[0], np.where(side == -1, damping[1], 0.0))
    squares = rows[:, measure.SQUARES]
    values: dict[str, Any] = {
        "displacement_max": high,
        "displacement_min": low,
        "displacement_excursion": high - low,
        "acceleration_max": top,
        "acceleration_min": bottom,
        "acceleration_excursion": top - bottom,
        "eccentricity": 0.5 * (high + low),
        "impacts_right": int((log["contact_side"] == 1).sum()) / cycles,
        "impacts_left": int((log["contact_side"] == -1).sum()) / cycles,
        "energy_supplied": -rig.mass * shaken.amplitude * rows[:, measure.WORK].sum() / cycles,
        "energy_isolator": rig.isolator.damping * squares.sum() / cycles,
        "energy_bumpers": (
            float(pressed @ squares) + float(log["contact_dissipated_relaxing"].sum())
        )
        / cycles,
    }
    data = data.assign({**scalars, **values, **{str(name): log[name] for name in log}})
    data.attrs["created_by"] = "vibroimpact.steady"
    return describe(data, "vibroimpact.steady", motion_parameters(data))


def _given_up(
    found: Settled, start: State, samples: int, window: int, max_events: int
) -> xr.Dataset:
    """What a motion did in the last cycles before it met a limit."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        before = max(found.cycles - 1 - window, 0)
        if before:
            ahead = simulate(found.oscillator, found.excitation, before, start, 0)
            start = as_state(ahead)
        data = simulate(
            found.oscillator,
            found.excitation,
            found.cycles - before if found.cycles else 1,
            start,
            samples,
            max_events=max_events,
        )
    warnings.warn(
        f"steady stopped in cycle {found.cycles}: {found.status.advice}",
        RuntimeWarning,
        stacklevel=3,
    )
    nothing = ("exponent", np.full(2, np.nan))
    scalars: dict[str, Any] = {
        "motion": "undecided",
        "period": 0,
        "stable": -1,
        "cycles": found.cycles,
        "exponents_cycles": 0,
        "effective_damping": np.nan,
        "antisymmetric": False,
        "mirror_distance": np.nan,
        "exponents": nothing,
        "exponents_uncertainty": nothing,
    }
    data.attrs["evidence"] = data.attrs["status"] = found.status.advice
    return _measured(data, scalars) if data.sizes["time"] else data.assign(scalars)
