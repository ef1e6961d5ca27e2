"""Steady motions, measured exactly and classified."""

from __future__ import annotations

import math
import warnings
from collections import Counter
from functools import partial
from typing import Annotated, Any, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, noted
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, warn_of_result
from vibroimpact.model import AssemblyState, State
from vibroimpact.model.argument_types import (
    MaxEvents,
    PositiveInt,
    Share,
    check_samples,
    whole,
)
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig_of_any_masses
from vibroimpact.response.analytic_free_response import exciting_force
from vibroimpact.response.assembly_rows import measured_over
from vibroimpact.response.contacts import contact_log
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.motion_phases import Origin, phases
from vibroimpact.response.plausibility import doubt_stops
from vibroimpact.response.simulate import compute_history
from vibroimpact.response.totals import energies, extremes
from vibroimpact.stability.exponents import DISCARD
from vibroimpact.stability.initial_orbit import first_orbit
from vibroimpact.stability.motion_exponents import judge_orbit, judge_wandering
from vibroimpact.stability.motion_type import Judgement
from vibroimpact.stability.parameter_family import family
from vibroimpact.stability.settled_motion import (
    Settled,
    approach,
    reach,
    settled_on,
    state_distance,
)
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]

ANTISYMMETRIC = 1e-8
"""Distance of a motion from its mirror image, divided by its size, below which both are the
same."""
APPROACHED = 0.05
"""Distance from the orbit to which a motion slowly converges, divided by its size."""
NEUTRAL = 1e-6
"""Logarithm of the largest multiplier below which an orbit counts as neither stable nor unstable:
the rest of a transient hides smaller values."""
_UNDECIDED = (
    "the motion may not have settled, because the largest Floquet multiplier of its orbit is 1 "
    "within the accuracy: the orbit is not isolated, or the motion approaches it more slowly than "
    "exponentially"
)
MOST_CYCLES = 5_000_000
"""Largest number of cycles over which exponents are averaged: about 0.3 GB."""
ExponentCycles: TypeAlias = Annotated[int, partial(whole, most=MOST_CYCLES)]


@public
def steady(
    rig: AnyRig,
    start: State | AssemblyState | xr.DataArray | xr.Dataset | None = None,
    samples: PositiveInt = 256,
    *,
    frequency: float | str | None = None,
    window: PositiveInt = 200,
    tolerance: Share = 1e-12,
    max_cycles: PositiveInt = 2000,
    exponent_cycles: ExponentCycles = 20_000,
    max_events: MaxEvents = 10_000,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Simulate a rig until its motion is steady; then record, measure and classify this motion.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    start
        Initial state. Default: the mass at rest.
    samples
        Number of samples per forcing cycle, at least 1. It affects only the recorded time history.
    frequency
        Forcing frequency (Hz). Default: the frequency of the rig.
    window
        Number of forcing cycles that are recorded if a motion does not become periodic.
    tolerance, max_cycles, max_events
        As in `sweeps`.
    exponent_cycles
        Number of forcing cycles over which the growth of disturbances is averaged, if this is
        required to classify the motion. It is not required for a periodic motion, whose exponents
        follow from one period.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the number of
        completed cycles and the largest possible number of cycles. These are first counted until
        the motion is steady, and then counted again while the exponents are averaged.

    Returns
    -------
    xarray.Dataset
        The dataset contains the variables of `simulate`, over one period or over the window, and
        the variables of `contacts`. Further variables are:

        - ``motion`` ("periodic", "quasi-periodic", "chaotic" or "undecided") and ``period``;
        - ``exponents``, ``exponents_uncertainty`` and ``exponents_cycles``;
        - ``stable`` and ``antisymmetric``: whether the motion is stable, and whether it is its own
          mirror image half a period later;
        - the exact extremes of the displacement, of the absolute acceleration and of the
          transmitted force, and ``eccentricity``;
        - ``transmissibility``, as in `sweep`;
        - the impacts and the energies per forcing cycle.

        Of an assembly, the variables are those of `simulate` and `sweep` by mass and stop, and
        ``exponents`` has twice as many entries as there are masses if the motion is periodic. There
        are no energies and no list of contacts.

        The attribute ``evidence`` gives the reason for the classification. If the motion reached
        ``max_events``, the recorded history ends at that time, and ``status`` reports it.

    Raises
    ------
    InputError
        If a value is invalid, or if an undamped mass without stops is shaken at resonance.
    """
    rig = as_rig_of_any_masses(rig, frequency=frequency)
    engine_system(rig.system).check_size()
    check_samples(window, samples, "window")
    state = engine_system(rig.system).read(start)
    motion = approach(rig, state, tolerance, max_cycles, max_events, progress)
    if motion.status not in (Status.DONE, Status.NOT_SETTLED):
        return _given_up(motion, samples, max_events)
    data = describe_motion(motion, samples, window, exponent_cycles, max_events, progress)
    if progress:
        progress(max_cycles, max_cycles)  # it may have settled long before
    return data


def describe_motion(
    motion: Settled,
    samples: int,
    window: int,
    exponent_cycles: int,
    max_events: int,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Classify a motion, record it and measure it."""
    used, slowly = motion.cycles, ""
    if not motion.period:
        state = motion.state.copy()
        kind, damping, cycles, status = judge_wandering(
            motion, state, exponent_cycles, max_events, progress
        )
        used += cycles + DISCARD
        motion = motion._replace(state=state, period=kind.period, cycles=used)
        if status is not Status.DONE:
            return _given_up(motion._replace(status=status), samples, max_events)
        if kind.returns and (orbit := approached(motion, kind.returns)) is not None:
            motion = orbit._replace(cycles=used)
            slowly = "; it settles slowly, and was computed by Newton's method"
    if motion.period:
        kind, damping, cycles, status = judge_orbit(motion, max_events)
        if status is not Status.DONE:
            return _given_up(motion._replace(status=status), samples, max_events)
        kind = kind._replace(evidence=kind.evidence + slowly)
    stable = {"chaotic": 0, "periodic": _stable(kind)}.get(kind.motion, -1)
    if kind.period and stable == -1:
        kind = kind._replace(evidence=f"{kind.evidence}; {_UNDECIDED}")
        if used:
            message = (
                f"{_UNDECIDED}; to find out which, compare it with the motion from another start"
            )
            warn_of_result(f"steady: {message}")
    data = _record(motion, motion.state, samples, kind.period or window, max_events)
    if int(data["status"]) not in (Status.DONE, Status.REVERSED):
        return _given_up(motion._replace(status=Status.TOO_MANY_EVENTS), samples, max_events)
    frequency = motion.excitation.frequency
    distance = _mirror_distance(motion, motion.state, kind.period, max_events)
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
    return _measured(data, motion, scalars)


def approached(motion: Settled, period: int) -> Settled | None:
    """Compute the stable orbit to which a motion slowly converges, by Newton's method."""
    along = family(motion.rig, "frequency")
    here = motion.states.state(motion.state, motion.excitation.phase)
    try:
        orbit = first_orbit(along, (0.0, 1.0), here, period, symmetric=False)
    except InputError:
        return None
    there = settled_on(orbit)
    size = reach(motion, motion.state)
    near = state_distance(motion, there.state, motion.state, size) <= APPROACHED
    return there if near and orbit.stable else None


def _stable(kind: Judgement) -> int:
    """Return 1 or 0; -1 if the largest exponent is zero within its accuracy."""
    largest, spread = (float(one[0]) * kind.period for one in (kind.exponents, kind.uncertainty))
    return -1 if abs(largest) <= max(NEUTRAL, spread) else int(largest < 0.0)


def _record(
    motion: Settled, state: _Array, samples: int, cycles: int, max_events: int
) -> xr.Dataset:
    return compute_history(
        motion.rig,
        cycles,
        motion.states.state(state, motion.excitation.phase),
        samples,
        max_events=max_events,
    )


def _mirror_distance(motion: Settled, state: _Array, period: int, max_events: int) -> float:
    """Return the distance of a periodic motion from its own mirror image half a period later.

    The forcing must change its sign after half a period, so the period is an odd number of cycles.
    """
    if period % 2 == 0:
        return math.nan
    status, half = motion.engine.propagate(state, 0.5 * period, max_events)
    if status is not Status.DONE:
        return math.nan  # seen from there a cycle has more events than are allowed
    image = motion.states.mirror_image(half)
    return math.nan if image is None else state_distance(motion, image, state, reach(motion, state))


def _measured(data: xr.Dataset, motion: Settled, scalars: dict[str, Any]) -> xr.Dataset:
    """Add the scalars, the contact log, the exact extremes, and quantities derived from them."""
    if motion.states.system.by_mass:
        return _measured_by_mass(data, motion, scalars)
    periodic = scalars["period"] > 0
    origin = Origin(
        motion.rig.oscillator, motion.excitation, float(data["cycle"].values[-1]), periodic
    )
    every = phases(data, origin)
    log = contact_log(data, origin, every)
    cycles = max(origin.cycles, 1.0)
    counts = Counter(log["contact_stop"].values.tolist())
    total, sizes = energies(every), extremes(every)
    exciting = exciting_force(motion.rig)
    values: dict[str, Any] = {
        **sizes,
        "transmissibility": sizes["transmitted_force_excursion"] / (exciting or math.nan),
        "impacts": ("stop", [counts.get(one, 0) / cycles for one in data["stop"].values.tolist()]),
        "energy_supplied": total["total_supplied"] / cycles,
        "energy_isolator": total["total_isolator"] / cycles,
        "energy_bumpers": total["total_bumpers"] / cycles,
    }
    data = data.assign({**scalars, **values, **{str(name): log[name] for name in log}})
    data.attrs["created_by"] = "vibroimpact.steady"
    ends = [values["displacement_max"], values["displacement_min"]]
    notes = [*doubt_stops(motion.rig, ends), *noted(data), *every.notes]
    return describe(data, "vibroimpact.steady", notes=notes)


def _measured_by_mass(data: xr.Dataset, motion: Settled, scalars: dict[str, Any]) -> xr.Dataset:
    """Add the scalars, and the exact extremes, forces and impacts, by mass and stop."""
    cycles = max(round(float(data["cycle"].values[-1])), 1)
    row = measured_over(motion.engine, motion.state, cycles)
    variables = motion.states.measured(row, ())
    ordered = int(data["simultaneous_impacts"])
    data = data.assign({**variables, **scalars, "simultaneous_impacts": ordered})
    data.attrs["created_by"] = "vibroimpact.steady"
    return describe(data, "vibroimpact.steady", notes=noted(data))


def _given_up(motion: Settled, samples: int, max_events: int) -> xr.Dataset:
    """Record a motion in the cycle in which it reached a limit, from the previous section."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        data = _record(motion, motion.state, samples, 1, max_events)
        if not data.sizes["time"]:
            data = _until_the_last_event(data, motion, samples)
    if not data.sizes["time"]:
        advice = motion.status.advice
        raise InputError(f"excitation: the motion could not be simulated: {advice}")
    warn_of_result(f"steady stopped in cycle {motion.cycles}: {motion.status.advice}")
    nothing = ("exponent", np.full(2 * motion.states.masses, np.nan))
    scalars: dict[str, Any] = {
        "motion": "undecided",
        "period": 0,
        "stable": -1,
        "cycles": motion.cycles,
        "exponents_cycles": 0,
        "effective_damping": np.nan,
        "antisymmetric": False,
        "mirror_distance": np.nan,
        "exponents": nothing,
        "exponents_uncertainty": nothing,
    }
    data["status"] = int(motion.status)
    data.attrs["evidence"] = data.attrs["message"] = motion.status.advice
    return _measured(data, motion, scalars)


def _until_the_last_event(data: xr.Dataset, motion: Settled, samples: int) -> xr.Dataset:
    """Return the simulated part of a cycle: up to its last event, or only its start."""
    length = 0.0
    if data.sizes["event"]:
        length = float(data["event_cycle_time"][-1]) * motion.excitation.frequency
    length = max(length, 1e-12)
    return compute_history(
        motion.rig,
        length,
        motion.states.state(motion.state, motion.excitation.phase),
        samples,
        max_events=max(data.sizes["event"], 1),
    )
