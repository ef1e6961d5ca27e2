"""Time histories: one sampled motion, with the exact time of each contact and detachment."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import (
    describe,
    excitation_parameters,
    noted,
    system_parameters,
)
from vibroimpact.datasets.stops import part_names
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, warn_of_result
from vibroimpact.model import (
    AssemblyState,
    Record,
    Repeated,
    State,
    to_si,
)
from vibroimpact.model.argument_types import (
    MOST_TAIL,
    MaxEvents,
    NonNegativeInt,
    check_samples,
)
from vibroimpact.model.public import public
from vibroimpact.model.quantities import DIMENSIONLESS, TIME
from vibroimpact.model.read_rig import AnyRig, as_rig_of_any_masses
from vibroimpact.model.rig import Rig
from vibroimpact.model.system import System
from vibroimpact.response.engine_system import EngineSystem, engine_system
from vibroimpact.response.history_variables import EngineRecord
from vibroimpact.response.plausibility import doubt_stops, note_stiff_stops
from vibroimpact.response.record_dataset import record_parameters
from vibroimpact.response.record_history import base_acceleration
from vibroimpact.response.written_motion import WrittenMotion
from vibroimpact.tasks.threads import Progress


@public
def simulate(
    rig: AnyRig,
    cycles: float | None = None,
    start: State | AssemblyState | xr.DataArray | xr.Dataset | None = None,
    samples: NonNegativeInt | None = None,
    *,
    frequency: float | str | None = None,
    tail: float | str | None = None,
    max_events: MaxEvents = 10_000,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Simulate the motion of a rig for a number of forcing cycles, or through a record.

    If nothing shakes the rig, this is its free vibration from the initial state, or its fall.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
        The system may be an `Assembly`.
    cycles
        Duration in forcing cycles, greater than 0. It need not be a whole number. If nothing shakes
        the rig, a cycle is one period of ``frequency``. If a record shakes the rig, do not pass
        ``cycles``: the record has its own duration.
    start
        Initial state: a `State` (by names for an assembly), the dataset of an earlier call, or its
        ``final_state``. The latter two also continue the phase of the excitation. Default: at rest
        in the equilibrium.
    samples
        Number of samples per forcing cycle, or per step of a record. It does not affect the
        computed motion. If it is 0, only ``final_state`` is returned, and the memory does not grow
        with ``cycles``. Default: 256 per forcing cycle, or 1 per step of a record.
    frequency
        Forcing frequency (Hz). Default: the frequency of the rig. If nothing shakes the rig, it
        is only the unit of time, and its default is the natural frequency, or 1 Hz without a
        spring.
    tail
        Duration of free vibration after a record, in seconds or as a string such as ``"10s"``.
        Default: 0.
    max_events
        Largest number of events (contacts, detachments, yielding and turning points) in one forcing
        cycle, or in one step of a record. When the motion reaches this number, the computation is
        given up.
    progress
        A `progress_bar`, or a function that is called from time to time with the number of
        completed cycles (or steps of the record) and the number of all of them.

    Returns
    -------
    xarray.Dataset
        The dim ``time`` (s) counts the samples, including one at the end of the motion. The dim
        ``event`` counts the contacts and detachments, and the dim ``stop`` names the stops that the
        rig has: ``right`` and ``left``, or those of an assembly. ``deformation`` (m) of a stop is
        positive when it is compressed, ``clearance`` (m) is the distance from the mass to its face,
        and ``touching`` (of one mass) states whether they touch. ``event_stop`` is the stop of each
        event.
        ``transmitted_force`` is the force that the isolator and the stops together exert on the
        base, positive to the right, without the infinite force of an impact on a rigid stop. To
        resume the motion, pass ``final_state`` as ``start``. If the computation was given up, the
        dataset ends at that time. The variable ``status`` and the attribute ``message`` then give
        the reason.

        The motion of an assembly has the dims ``mass`` and ``stop``: ``displacement``, ``velocity``
        and ``acceleration`` belong to the masses, ``clearance``, ``deformation`` and
        ``contact_force`` (N, positive when it pushes the bodies apart) to the stops. Each event has
        the name of its stop, ``event_stop``. ``simultaneous_impacts`` counts the impacts whose
        order was decided by the order of the stops, and a warning reports them.

    Raises
    ------
    InputError
        If a value is invalid, or if an assembly has too many parts. Also if an undamped mass
        without stops is shaken at resonance.
    """
    rig = as_rig_of_any_masses(rig)
    if frequency is not None:
        rig = (rig if rig.is_shaken else rig.vibrating_freely()).at(frequency)
    data = compute_history(rig, cycles, start, samples, tail, max_events, progress)
    # A short motion shows nothing: only the closed form of free flight counts.
    notes = [*noted(data), *doubt_stops(rig)]
    return describe(data, "vibroimpact.simulate", notes=notes)


def compute_history(
    rig: Rig,
    cycles: float | None,
    start: State | AssemblyState | xr.DataArray | xr.Dataset | None,
    samples: int | None,
    tail: float | str | None = None,
    max_events: int = 10_000,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Do what `simulate` does, without doubts about the rig."""
    if not rig.is_shaken:
        rig = rig.vibrating_freely()
    excitation = rig.shaking if isinstance(rig.shaking, Record) else rig.harmonic
    per = 1 if isinstance(excitation, Record) else 256
    samples = per if samples is None else samples
    if isinstance(excitation, Record):
        if cycles is not None:
            raise InputError(
                f"cycles: {cycles!r}, but a record has no cycles; remove cycles (to compute the "
                "time after the record, pass tail)"
            )
        behind = 0.0 if tail is None else to_si(tail, TIME, "tail", minimum=0.0, maximum=MOST_TAIL)
        return _history(rig.system, excitation, behind, start, samples, max_events, progress)
    if tail is not None:
        raise InputError(
            f"tail: {tail!r}, but no Record shakes this rig; remove tail, and set the duration by "
            "cycles"
        )
    if cycles is None:
        raise InputError("cycles: missing; pass the number of forcing cycles, such as 100")
    length = to_si(cycles, DIMENSIONLESS, "cycles", above=0.0)
    check_samples(length, samples, "cycles")
    data = _history(rig.system, excitation, length, start, samples, max_events, progress)
    notes = [*noted(data), *note_stiff_stops(rig, excitation.frequency)]
    return describe(data, "vibroimpact.simulate", notes=notes)


def _history(
    system: System,
    shaking: Repeated | Record,
    length: float,
    start: State | AssemblyState | xr.DataArray | xr.Dataset | None,
    samples: int,
    max_events: int,
    progress: Progress | None,
) -> xr.Dataset:
    """Follow a motion, and return what was written down of it; ``length`` as of `WrittenMotion`."""
    record = shaking if isinstance(shaking, Record) else None
    states = engine_system(system)
    states.check_motion(shaking)
    state: Any = states.read(start)
    phase, ends = 0.0, length
    if isinstance(shaking, Record):
        ends = shaking.duration + length
    else:
        phase = shaking.phase if state.phase is None else state.phase
    vector = states.motion_vector(state)
    first = states.components(vector, phase)
    run = WrittenMotion(states, shaking, length, phase, vector, samples, max_events)
    finished = run.follow(progress)
    status = states.ended(run.status, run.out, vector)
    if run.status is not Status.DONE:
        run.truncate(finished)
        ends = finished * (record.step if record else 1.0)
        where = f"{ends:g} s into the record" if record else f"in cycle {finished}"
        too_many = run.status is Status.TOO_MANY_EVENTS
        cause = states.cause_of_events(run.events, finished) if too_many else ""
        advice = f"{status.advice}; here, {cause}" if cause else status.advice
        warn_of_result(f"simulate stopped {where}: {advice}")
    elif status is not run.status:
        warn_of_result(f"simulate: {status.advice}")
    reached = 0.0 if record else phase + 2.0 * math.pi * (ends % 1.0)
    variables: dict[str, Any] = {
        "final_state": ("component", states.components(run.state, reached))
    }
    coordinates: dict[str, Any] = {"component": states.names}
    notes: list[str] = [] if record is None else [*record.about.notes]
    counts, doubts = states.event_doubts(run.events, run.undecided, run.section)
    variables |= counts
    for one in doubts:
        warn_of_result(f"simulate: {one}")
    notes += doubts
    if samples:
        variables["initial_state"] = ("component", first)
        coordinates |= part_names(system, "mass", "stop")
        variables |= _variables(run, states, ends, coordinates)
    variables["status"] = int(status)
    data = xr.Dataset(variables, coordinates)
    data.attrs["message"] = status.advice
    parameters = system_parameters(system)
    if isinstance(shaking, Record):
        parameters |= {"record": record_parameters(shaking), "tail": length}
    else:
        parameters |= {**excitation_parameters(shaking.replace(phase=phase)), "cycles": ends}
    return describe(data, "vibroimpact.simulate", parameters, notes)


def _variables(
    run: WrittenMotion, states: EngineSystem, ends: float, coordinates: dict[str, Any]
) -> dict[str, Any]:
    """Return samples and events, and write the times of the samples into the coordinates."""
    shaking, samples, count = run.shaking, run.samples, run.out.shape[1]
    name = "base_acceleration"
    if isinstance(shaking, Record):
        time = np.minimum(np.arange(count) * (shaking.step / samples), ends)
        coordinates["time"] = time
        values = base_acceleration(shaking, time, samples)
    else:
        cycle = _cycles(count, samples, ends if run.status is Status.DONE else None)
        coordinates["time"] = cycle / shaking.frequency
        coordinates["cycle"] = ("time", cycle)
        name, values = _shaking(shaking, run.phase, cycle, samples)
    variables = states.histories(
        EngineRecord(run.out, run.events, run.interval, shaking, run.phase, name, values)
    )
    if isinstance(shaking, Record):  # a record has steps, not cycles
        variables = {name: one for name, one in variables.items() if "cycle" not in name}
    return variables


def _cycles(count: int, samples: int, length: float | None) -> NDArray[np.float64]:
    """Return the times of the samples in forcing cycles; `length` is included if it was reached."""
    cycle = np.arange(count, dtype=np.float64)  # whole numbers would take ten times as long
    cycle /= samples
    if length is not None:  # the last value is the end itself, which need not lie on the grid
        cycle[-1] = length
    return cycle


def _shaking(
    excitation: Repeated, phase: float, cycle: NDArray[np.float64], samples: int
) -> tuple[str, NDArray[np.float64]]:
    """Return the base acceleration or force at the samples, which repeats in every cycle."""
    angles = 2.0 * np.pi * (np.arange(samples) / samples) + phase
    values = np.empty(len(cycle))
    whole, rest = divmod(len(cycle), samples)
    one = excitation.at(angles) + 0.0
    values[: whole * samples].reshape(whole, samples)[:] = one
    values[whole * samples :] = one[:rest]
    if len(cycle):
        values[-1] = excitation.at(2.0 * np.pi * (cycle[-1] % 1.0) + phase) + 0.0
    return "base_acceleration" if excitation.moves_base else "applied_force", values
