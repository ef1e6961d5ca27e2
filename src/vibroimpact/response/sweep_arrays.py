"""The sweep of one rig as plain numbers, from which datasets and maps are made."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.settling import PATIENT
from vibroimpact.model import AssemblyState, Rig, State
from vibroimpact.response.analytic_free_response import (
    check_each_bounded,
    exciting_excursion,
    free_flight_excursions,
    free_transmitted_excursion,
    reference_excursions,
)
from vibroimpact.response.engine_system import engine_rig, engine_system
from vibroimpact.response.free_response import swept_flight
from vibroimpact.response.hold_rows import Settling, sweep_holds
from vibroimpact.tasks.threads import Tally

_Array = NDArray[np.float64]


class SweepPlan(NamedTuple):
    """A rig, ready to be swept over some frequencies."""

    frequencies: _Array
    """In Hz, rising."""
    rig: _Array
    """As the engine's vector."""
    levels: _Array
    """The amplitude at each frequency."""
    start: _Array
    """Where either sweep begins, as the engine's vector."""
    free: _Array
    """Excursions in free flight at each frequency, shape (3, frequency): of the displacement (m),
    of the absolute acceleration (m/s²) and of the transmitted force per unit mass (m/s²). This and
    what follows is empty for an assembly."""
    largest: _Array
    """The largest ones of the first two at any frequency."""
    exciting: _Array
    """Excursion of the exciting force per unit mass (m/s²) at each frequency."""


def plan_sweep(
    rig: Rig, frequencies: _Array, state: State | AssemblyState | None = None
) -> SweepPlan:
    """Prepare a rig once, before it is swept in either direction.

    Raises
    ------
    InputError
        If the sizes do not go with the frequencies, or the state or a frequency not with the rig.
    """
    levels = rig.levels(len(frequencies))
    rig = rig.hardest
    states = engine_system(rig.system)
    states.check_size()
    if rig.system.by_mass:
        vector = states.numbers(rig.periodic, tables=True)
        begin, none = states.vector_of(state or states.read(None)), np.empty(0)
        return SweepPlan(frequencies, vector, levels, begin, none, none, none)
    oscillator, shaken = rig.oscillator, rig.periodic
    least = shaken.replace(amplitude=levels.min())
    check_each_bounded(Rig(oscillator, least), frequencies)
    if oscillator.isolator.linear:
        flying = Rig(oscillator, shaken)
        swing, acceleration = free_flight_excursions(flying, frequencies)
        carried = free_transmitted_excursion(flying, frequencies, swing, acceleration)
        free = np.array([swing, acceleration, carried])
        free *= levels / shaken.amplitude
    else:
        free = np.array(swept_flight(Rig(oscillator, shaken), frequencies, levels))
    return SweepPlan(
        frequencies,
        engine_rig(rig),
        levels,
        states.vector_of(state or states.read(None)),
        free,
        np.array(reference_excursions(Rig(oscillator, shaken))),
        exciting_excursion(rig, frequencies) * (levels / shaken.amplitude),
    )


def rows(
    one: SweepPlan,
    direction: str,
    phase: float,
    settling: Settling,
    tally: Tally,
    transient: float = PATIENT,
) -> tuple[_Array, _Array]:
    """Sweep a rig in one direction.

    A motion that is plainly chaotic after `transient` (s) is not waited for.

    Returns
    -------
    results, states : ndarray, shape (frequency, column)
        As `sweep_holds` gives them, but by rising frequency.
    """
    order = slice(None, None, 1 if direction == "forward" else -1)
    hold_rows, reached = sweep_holds(
        one.rig,
        one.levels[order],
        one.frequencies[order],
        phase,
        one.start,
        settling,
        tally,
        transient,
    )
    return hold_rows.array[order], reached[order]
