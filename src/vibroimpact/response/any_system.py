"""What the engine's views of one mass and of several masses have in common.

A vector is the mode, what has just happened, the parts of the state, and the age of the mode; a
point has the parts alone, of an oscillator with the deformation of the left stop negative.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact.datasets.stops import by_stop
from vibroimpact.engine.state import FIRST, FRESH, MODE, Parts
from vibroimpact.engine.status import Status
from vibroimpact.model import AssemblyState, State
from vibroimpact.model.rig import Rig
from vibroimpact.model.system import System

_Array: TypeAlias = NDArray[np.float64]
AnyState: TypeAlias = State | AssemblyState
Dims: TypeAlias = tuple[str, ...]


@dataclass(frozen=True)
class AnySystem(ABC):
    """An oscillator or an assembly, as the engine sees it: see `engine_system.EngineSystem`."""

    system: System

    @property
    def masses(self) -> int:
        """Number of masses."""
        return len(self.system.names)

    @property
    def stops(self) -> int:
        """Number of stops that the engine counts; an oscillator may lack some of its two."""
        return len(self.system.counted_stops)

    @property
    @abstractmethod
    def memories(self) -> int:
        """Number of memories of isolators or links that a state has."""

    @property
    def places(self) -> Parts:
        """Where the parts stand: displacements, velocities, deformations, memories of links."""
        return Parts(self.masses, self.stops, self.memories)

    @property
    def parts(self) -> int:
        """Number of parts."""
        return self.places.total

    @property
    def width(self) -> int:
        """Length of a vector, without the clock."""
        return self.places.width

    @property
    def signs(self) -> _Array:
        """Signs of the parts of a point: its left deformation is negative when compressed."""
        return np.ones(self.parts)

    def check_size(self) -> None:  # noqa: B027
        """Raise an error if the system has more parts than the engine's maps have room for."""

    def check_bounded(self, rig: Rig, field: str = "frequency") -> None:  # noqa: B027
        """Raise an error if a rig with this system is undamped, without stops and at resonance."""

    @abstractmethod
    def vector_of(self, state: Any) -> _Array:
        """Return a state as the engine's vector, absent values deduced.

        Raises
        ------
        InputError
            If there can be no such state.
        """

    def motion_vector(self, state: Any) -> _Array:
        """Return `vector_of` with the clock, from which the engine writes a motion down."""
        return self.vector_of(state)

    @abstractmethod
    def _begun(self, mode: float) -> float:
        """Return what has just happened, of a vector in a mode that begins."""

    def point(self, vector: _Array) -> _Array:
        """Return the parts of a vector."""
        parts: _Array = vector[FIRST : FIRST + self.parts] * self.signs
        return parts

    def vector(self, parts: _Array, mode: float) -> _Array:
        """Return the vector of a point's parts, in a mode."""
        vector = np.zeros(self.width)
        vector[MODE], vector[FRESH] = mode, self._begun(mode)
        vector[FIRST : FIRST + self.parts] = parts * self.signs
        return vector

    def velocities(self) -> NDArray[np.bool_]:
        """Which parts are velocities."""
        places = self.places.of_point
        is_velocity = np.zeros(places.total, dtype=bool)
        is_velocity[places.velocity() : places.deformation(0)] = True
        return is_velocity

    def event_doubts(
        self, events: list[_Array], undecided: bool, section: str
    ) -> tuple[dict[str, Any], list[str]]:
        """Return a count of the impacts that were ordered by a rule, and notes about events."""
        return {}, []

    def cause_of_events(self, events: list[_Array], section: int) -> str:
        """Describe which parts cause too many events in a section; may be empty."""
        return ""

    def doubts_of_rows(self, rows: _Array, what: str) -> list[str]:
        """Return notes about measured rows: what was decided by a rule, or was not decided."""
        return []

    def judged(self, outcome: ArrayLike, farthest: ArrayLike) -> NDArray[np.int64]:
        """Return how computations ended, as `softening_limit.judged`."""
        return np.asarray(outcome).astype(np.int64)

    def ended(self, status: Status, out: _Array, vector: _Array) -> Status:
        """Return how a motion with these samples and this initial state ended."""
        return status

    def of_masses(self, dims: Dims, values: NDArray[Any]) -> tuple[Dims, NDArray[Any]]:
        """Return values, with the masses as last axis, and their dims, as datasets have them."""
        return (*dims, "mass"), values

    def section_variables(self, points: _Array, dims: Dims) -> dict[str, Any]:
        """Return points of a section, shape (*dims, part), as variables."""
        places = self.places.of_point
        bounds = [places.velocity(), places.deformation(0), places.memory()]
        u, v, d, _ = np.split(points[..., : places.total] * self.signs, bounds, axis=-1)
        d = self._deformed(d)
        return {
            "section_displacement": self.of_masses(dims, u),
            "section_velocity": self.of_masses(dims, v),
            "section_deformation": ((*dims, "stop"), by_stop(self.system, d)),
        }

    def _deformed(self, deformations: _Array) -> _Array:
        """Return deformations without negative zeros."""
        return deformations + 0.0

    def phase_rows(self, rows: _Array) -> _Array:
        """Return the rows of phases in SI units."""
        return rows
