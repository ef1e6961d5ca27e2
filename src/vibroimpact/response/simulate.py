"""Time histories: one sampled motion, with the exact time of each contact and detachment."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import (
    COMPONENTS,
    describe,
    excitation_parameters,
    noted,
    oscillator_parameters,
)
from vibroimpact.datasets.stops import stops_of
from vibroimpact.engine import batch
from vibroimpact.engine.motion import U
from vibroimpact.engine.observers import record
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, warn_of_result
from vibroimpact.model import Assembly, AssemblyState, Record, Repeated, State, equilibrium, to_si
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
from vibroimpact.response.analytic_free_response import check_bounded
from vibroimpact.response.assembly_motion import compute_assembly_history
from vibroimpact.response.engine_input import as_state, components, engine_rig, engine_state
from vibroimpact.response.history_variables import (
    EVENTS_AT_ONCE,
    listed,
    sampled,
    transmitted,
)
from vibroimpact.response.plausibility import doubt_stops, note_stiff_stops
from vibroimpact.response.record_history import through
from vibroimpact.response.softening_limit import ended
from vibroimpact.tasks.interruptible import Calls
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
        The system may be an `Assembly` whose links are linear and whose stops are bumpers or rigid
        stops.
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
        Duration of free vibration after a record, in seconds or as text such as ``"10s"``. Default:
        0.
    max_events
        Largest number of contacts and detachments in one forcing cycle, or in one step of a record.
        When the motion reaches this number, the computation is given up.
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
        and ``touching`` states whether they touch. ``event_stop`` is the stop of each event.
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
        If a value is invalid, or if an assembly has a law that is not accepted yet. Also if an
        undamped mass without stops is shaken at resonance.
    """
    rig = as_rig_of_any_masses(rig)
    if frequency is not None:
        rig = (rig if rig.is_shaken else rig.vibrating_freely()).at(frequency)
    data = compute_history(rig, cycles, start, samples, tail, max_events, progress)
    if isinstance(rig.system, Assembly):
        return data
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
        if isinstance(rig.system, Assembly):
            return compute_assembly_history(
                rig, excitation, behind, start, samples, max_events, progress
            )
        return through(rig, behind, start, samples, max_events, progress)
    if tail is not None:
        raise InputError(
            f"tail: {tail!r}, but no Record shakes this rig; remove tail, and set the duration by "
            "cycles"
        )
    if cycles is None:
        raise InputError("cycles: missing; pass the number of forcing cycles, such as 100")
    length = to_si(cycles, DIMENSIONLESS, "cycles", above=0.0)
    check_samples(length, samples, "cycles")
    if isinstance(rig.system, Assembly):
        return compute_assembly_history(
            rig, excitation, length, start, samples, max_events, progress
        )
    oscillator = rig.oscillator
    if oscillator.isolator.linear:  # in closed form about its steady motion, which is none there
        check_bounded(Rig(oscillator, excitation))
    state = equilibrium(oscillator) if start is None else as_state(start)
    phase = excitation.phase if state.phase is None else state.phase
    vector = engine_state(oscillator, state)
    first = components(vector, phase)

    count = math.ceil(length * samples - 1e-9) + 1 if samples else 0
    out = np.empty((record.SAMPLE, count))
    capacity = max_events + 1 + (EVENTS_AT_ONCE if samples else 0)
    buffer = np.empty((capacity, record.EVENT))
    found = []
    vector_of_rig = engine_rig(Rig(oscillator, excitation))
    at = 0
    outcome = int(Status.DONE)
    calls = Calls(length, progress)
    while at < length and outcome == Status.DONE:
        at, events, outcome = batch.trajectory(
            vector_of_rig,
            excitation.amplitude,
            excitation.frequency,
            phase,
            vector,
            float(at),
            calls.end(at),
            samples,
            max_events,
            out,
            buffer,
        )
        if samples:
            found.append(buffer[:events].copy())
    status = Status(outcome)
    told = ended(oscillator, status, out[record.DISPLACEMENT], vector[U])
    if status is not Status.DONE:
        # The cycle that was given up is left out; its events until then are kept.
        finished = max(at - 1, 0)
        warn_of_result(f"simulate stopped in cycle {finished}: {told.advice}")
        out = out[:, : finished * samples]
        length = float(finished)
    variables: dict[str, Any] = {
        "final_state": ("component", components(vector, phase + 2.0 * math.pi * (length % 1.0))),
    }
    coordinates: dict[str, Any] = {"component": COMPONENTS}
    if samples:
        complete = status is Status.DONE
        cycle = _cycles(out.shape[1], samples, length if complete else None)
        coordinates["stop"] = stops_of(oscillator)
        coordinates["time"] = cycle / excitation.frequency
        coordinates["cycle"] = ("time", cycle)
        variables["initial_state"] = ("component", first)
        variables |= sampled(out, oscillator)
        name, values = _shaking(excitation, phase, cycle, samples)
        variables[name] = ("time", values)
        variables |= listed(found, 1.0 / excitation.frequency, oscillator)
        forces: tuple[Any, ...] = ()
        if not excitation.moves_base:
            _, since = variables["event_cycle_time"]
            forces = values, excitation.at(excitation.angular_frequency * since + phase)
        variables |= transmitted(variables, oscillator, *forces)
    variables["status"] = int(told)
    data = xr.Dataset(variables, coordinates)
    if status is Status.DONE and told is not status:
        warn_of_result(f"simulate: {told.advice}")
    data.attrs["message"] = told.advice
    return describe(
        data,
        "vibroimpact.simulate",
        {
            "oscillator": oscillator_parameters(oscillator),
            **excitation_parameters(excitation.replace(phase=phase)),
            "cycles": length,
        },
        note_stiff_stops(rig, excitation.frequency),
    )


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
