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
from vibroimpact.response.analytic_free_response import exciting_excursion
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
    later,
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
    found = approach(rig, state, tolerance, max_cycles, max_events, progress)
    if found.status not in (Status.DONE, Status.NOT_SETTLED):
        return _given_up(found, samples, max_events)
    data = describe_motion(found, samples, window, exponent_cycles, max_events, progress)
    if progress:
        progress(max_cycles, max_cycles)  # it may have settled long before
    return data


def describe_motion(
    found: Settled,
    samples: int,
    window: int,
    exponent_cycles: int,
    max_events: int,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Classify a motion, record it and measure it."""
    used, slowly = found.cycles, ""
    if not found.period:
        state = found.state.copy()
        kind, damping, cycles, status = judge_wandering(
            found, state, exponent_cycles, max_events, progress
        )
        used += cycles + DISCARD
        found = found._replace(state=state, period=kind.period, cycles=used)
        if status is not Status.DONE:
            return _given_up(found._replace(status=status), samples, max_events)
        if kind.returns and (orbit := approached(found, kind.returns)) is not None:
            found = orbit._replace(cycles=used)
            slowly = "; it settles slowly, and was computed by Newton's method"
    if found.period:
        kind, damping, cycles, status = judge_orbit(found, max_events)
        if status is not Status.DONE:
            return _given_up(found._replace(status=status), samples, max_events)
        kind = kind._replace(evidence=kind.evidence + slowly)
    stable = {"chaotic": 0, "periodic": _stable(kind)}.get(kind.motion, -1)
    if kind.period and stable == -1:
        kind = kind._replace(evidence=f"{kind.evidence}; {_UNDECIDED}")
        if used:
            told = f"{_UNDECIDED}; to find out which, compare it with the motion from another start"
            warn_of_result(f"steady: {told}")
    data = _record(found, found.state, samples, kind.period or window, max_events)
    if int(data["status"]) not in (Status.DONE, Status.REVERSED):
        return _given_up(found._replace(status=Status.TOO_MANY_EVENTS), samples, max_events)
    frequency = found.excitation.frequency
    distance = _mirror_distance(found, found.state, kind.period, max_events)
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
    return _measured(data, found, scalars)


def approached(found: Settled, period: int) -> Settled | None:
    """Compute the stable orbit to which a motion slowly converges, by Newton's method."""
    along = family(found.rig, "frequency")
    here = found.states.state(found.state, found.excitation.phase)
    try:
        orbit = first_orbit(along, (0.0, 1.0), here, period, symmetric=False)
    except InputError:
        return None
    there = settled_on(orbit)
    size = reach(found, found.state)
    near = state_distance(found, there.state, found.state, size) <= APPROACHED
    return there if near and orbit.stable else None


def _stable(kind: Judgement) -> int:
    """Return 1 or 0; -1 if the largest exponent is zero within its accuracy."""
    largest, spread = (float(one[0]) * kind.period for one in (kind.exponents, kind.uncertainty))
    return -1 if abs(largest) <= max(NEUTRAL, spread) else int(largest < 0.0)


def _record(
    found: Settled, state: _Array, samples: int, cycles: int, max_events: int
) -> xr.Dataset:
    return compute_history(
        found.rig,
        cycles,
        found.states.state(state, found.excitation.phase),
        samples,
        max_events=max_events,
    )


def _mirror_distance(found: Settled, state: _Array, period: int, max_events: int) -> float:
    """Return the distance of a periodic motion from its own mirror image half a period later.

    The forcing must change its sign after half a period, so the period is an odd number of cycles.
    """
    if period % 2 == 0:
        return math.nan
    status, half = later(found, state, 0.5 * period, max_events)
    if status is not Status.DONE:
        return math.nan  # seen from there a cycle has more events than are allowed
    image = found.states.mirror_image(half)
    return math.nan if image is None else state_distance(found, image, state, reach(found, state))


def _measured(data: xr.Dataset, found: Settled, scalars: dict[str, Any]) -> xr.Dataset:
    """Add the scalars, the contact log, the exact extremes, and quantities derived from them."""
    if found.states.system.by_mass:
        return _measured_by_mass(data, found, scalars)
    periodic = scalars["period"] > 0
    origin = Origin(found.oscillator, found.excitation, float(data["cycle"].values[-1]), periodic)
    every = phases(data, origin)
    log = contact_log(data, origin, every)
    cycles = max(origin.cycles, 1.0)
    counts = Counter(log["contact_stop"].values.tolist())
    total, sizes = energies(every), extremes(every)
    exciting = found.oscillator.mass * float(
        exciting_excursion(found.rig, np.array([found.excitation.frequency]))[0]
    )
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
    notes = [*doubt_stops(found.rig, ends), *noted(data), *every.notes]
    return describe(data, "vibroimpact.steady", notes=notes)


def _measured_by_mass(data: xr.Dataset, found: Settled, scalars: dict[str, Any]) -> xr.Dataset:
    """Add the scalars, and the exact extremes, forces and impacts, by mass and stop."""
    cycles = max(round(float(data["cycle"].values[-1])), 1)
    row = measured_over(found.engine, found.state, cycles)
    variables = found.states.measured(row, ())
    ordered = int(data["simultaneous_impacts"])
    data = data.assign({**variables, **scalars, "simultaneous_impacts": ordered})
    data.attrs["created_by"] = "vibroimpact.steady"
    return describe(data, "vibroimpact.steady", notes=noted(data))


def _given_up(found: Settled, samples: int, max_events: int) -> xr.Dataset:
    """Record a motion in the cycle in which it reached a limit, from the previous section."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        data = _record(found, found.state, samples, 1, max_events)
        if not data.sizes["time"]:
            data = _until_the_last_event(data, found, samples)
    if not data.sizes["time"]:
        told = found.status.advice
        raise InputError(f"excitation: the motion could not be simulated: {told}")
    warn_of_result(f"steady stopped in cycle {found.cycles}: {found.status.advice}")
    nothing = ("exponent", np.full(2 * found.states.masses, np.nan))
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
    data["status"] = int(found.status)
    data.attrs["evidence"] = data.attrs["message"] = found.status.advice
    return _measured(data, found, scalars)


def _until_the_last_event(data: xr.Dataset, found: Settled, samples: int) -> xr.Dataset:
    """Return the simulated part of a cycle: up to its last event, or only its start."""
    length = 0.0
    if data.sizes["event"]:
        length = float(data["event_cycle_time"][-1]) * found.excitation.frequency
    length = max(length, 1e-12)
    return compute_history(
        found.rig,
        length,
        found.states.state(found.state, found.excitation.phase),
        samples,
        max_events=max(data.sizes["event"], 1),
    )
