"""Held frequencies: what the engine measures of each, by name."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch, steady_response
from vibroimpact.engine.assembly import layout, measures
from vibroimpact.engine.one_mass.extremes import by_stop
from vibroimpact.engine.parameters import FORCING, MASSES
from vibroimpact.engine.settling import PATIENT
from vibroimpact.engine.status import Status
from vibroimpact.tasks.threads import Tally

_Array = NDArray[np.float64]

MAX_EVENTS = 10_000
"""Events in one forcing cycle at which a motion is given up, unless stated."""


class Settling(NamedTuple):
    """How long a frequency is held until the motion has settled."""

    tolerance: float = 1e-12
    """Distance between stroboscopic states, relative to the motion, at which it has settled."""
    max_cycles: int = 2000
    """Forcing cycles after which the wait ends."""
    window: int = 500
    """Forcing cycles over which a motion that did not settle is measured."""
    max_events: int = MAX_EVENTS


class HoldRows:
    """Measurements of held frequencies, by name; a view of the rows that the engine writes.

    Forces and impulses are per unit mass.

    Parameters
    ----------
    array : ndarray, shape (..., steady_response.RESULTS)
        A row for each held frequency.
    """

    __slots__ = ("array",)

    def __init__(self, array: _Array) -> None:
        self.array = array

    @classmethod
    def empty(cls, *shape: int) -> HoldRows:
        """Return rows for the engine to write."""
        return cls(np.empty((*shape, steady_response.RESULTS)))

    def __len__(self) -> int:
        return len(self.array)

    def __getitem__(self, index: object) -> HoldRows:
        """Return some of the rows."""
        return HoldRows(self.array[index])  # type: ignore[call-overload]

    @property
    def displacement_min(self) -> _Array:
        """Smallest relative displacement (m)."""
        return self.array[..., steady_response.U_LEAST]

    @property
    def displacement_max(self) -> _Array:
        """Largest relative displacement (m)."""
        return self.array[..., steady_response.U_MOST]

    @property
    def displacement_excursion(self) -> _Array:
        """Largest less smallest relative displacement (m)."""
        excursion: _Array = self.displacement_max - self.displacement_min
        return excursion

    @property
    def peak_displacement(self) -> _Array:
        """Largest relative displacement to either side (m)."""
        peak: _Array = np.maximum(np.abs(self.displacement_max), np.abs(self.displacement_min))
        return peak

    @property
    def acceleration_min(self) -> _Array:
        """Smallest absolute acceleration (m/s²)."""
        return self.array[..., steady_response.A_LEAST]

    @property
    def acceleration_max(self) -> _Array:
        """Largest absolute acceleration (m/s²)."""
        return self.array[..., steady_response.A_MOST]

    @property
    def acceleration_excursion(self) -> _Array:
        """Largest less smallest absolute acceleration (m/s²)."""
        excursion: _Array = self.acceleration_max - self.acceleration_min
        return excursion

    @property
    def peak_acceleration(self) -> _Array:
        """Largest absolute acceleration, without sign (m/s²)."""
        peak: _Array = np.maximum(np.abs(self.acceleration_max), np.abs(self.acceleration_min))
        return peak

    @property
    def impacts(self) -> _Array:
        """Contacts per forcing cycle with the right and the left stop, shape (..., 2)."""
        counts: _Array = self.array[..., by_stop(steady_response.HITS)]
        return counts

    @property
    def peak_force(self) -> _Array:
        """Largest forces of the right and the left stop per unit mass (m/s²), shape (..., 2)."""
        forces: _Array = self.array[..., by_stop(steady_response.FORCE)]
        return forces

    @property
    def peak_impulse(self) -> _Array:
        """Largest impulses on the right and the left rigid stop per unit mass (m/s), (..., 2)."""
        impulses: _Array = self.array[..., by_stop(steady_response.IMPULSE)]
        return impulses

    @property
    def transmitted_min(self) -> _Array:
        """Smallest force of isolator and stops on the base per unit mass (m/s²)."""
        return self.array[..., steady_response.T_LEAST]

    @property
    def transmitted_max(self) -> _Array:
        """Largest force of isolator and stops on the base per unit mass (m/s²)."""
        return self.array[..., steady_response.T_MOST]

    @property
    def transmitted_excursion(self) -> _Array:
        """Largest less smallest force on the base per unit mass (m/s²)."""
        excursion: _Array = self.transmitted_max - self.transmitted_min
        return excursion

    @property
    def period(self) -> NDArray[np.int64]:
        """Period in forcing cycles; 0 where the motion did not settle."""
        return self.array[..., steady_response.PERIOD].astype(np.int64)

    @property
    def cycles(self) -> NDArray[np.int64]:
        """Forcing cycles used."""
        return self.array[..., steady_response.CYCLES].astype(np.int64)

    @property
    def status(self) -> _Array:
        """How the hold ended, a `Status`; a view, to be changed in place."""
        return self.array[..., steady_response.OUTCOME]

    @property
    def settled(self) -> NDArray[np.bool_]:
        """Whether the motion became periodic."""
        is_settled: NDArray[np.bool_] = (self.status == Status.DONE) & (self.period > 0)
        return is_settled


def results_of(vector: _Array) -> int:
    """Return how many numbers the engine writes of a hold of a rig."""
    if vector[FORCING] != MASSES:
        return steady_response.RESULTS
    masses, parts, links = vector[[layout.MASSES, layout.STOPS, layout.LINKS]].astype(int)
    return steady_response.MEASURED + measures.count(masses, parts - links)


def sweep_holds(
    vector: _Array,
    amplitudes: _Array,
    frequencies: _Array,
    phase: float,
    state: _Array,
    settling: Settling,
    tally: Tally | None = None,
    transient: float = PATIENT,
) -> tuple[HoldRows, _Array]:
    """Hold one frequency after the other, each from the state at which the last one ended.

    Parameters
    ----------
    phase
        Of the section (rad).
    state
        The state at which the first hold begins, as the engine's vector. It is not changed.
    tally
        Counts the holds that are done and stops them. Default: none.
    transient
        Time (s) after which a motion that is plainly chaotic is no longer waited for.

    Returns
    -------
    rows : HoldRows
        What was measured, a row for each hold.
    states : ndarray, shape (hold, component)
        The state at the end of each hold.
    """
    count = len(frequencies)
    rows = HoldRows(np.empty((count, results_of(vector))))
    states = np.zeros((count, len(state)))
    batch.sweep(
        vector,
        np.ascontiguousarray(amplitudes),
        np.ascontiguousarray(frequencies),
        phase,
        state.copy(),
        *settling,
        transient,
        rows.array,
        states,
        np.zeros(2, dtype=np.int64) if tally is None else tally,
    )
    return rows, states
