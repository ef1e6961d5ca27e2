"""How the states of a system stand in the engine's vectors, and in points of a section.

A vector is the mode, what has just happened, the parts of the state, and the age of the mode; a
point has the parts alone, of an oscillator with the deformation of the left stop negative.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import COMPONENTS
from vibroimpact.datasets.stops import SIDES
from vibroimpact.engine.assembly.curved.layout import NEW
from vibroimpact.engine.one_mass.table import mirror_image
from vibroimpact.engine.state import FIRST, FRESH, MODE, ONE_MASS, Parts
from vibroimpact.model import Assembly, AssemblyState, Oscillator, State, Stop, equilibrium
from vibroimpact.response.assembly_rig import assembly_partners, link_parts
from vibroimpact.response.assembly_state import (
    as_assembly_state,
    assembly_state_from,
    assembly_vector,
    component_names,
    state_components,
)
from vibroimpact.response.engine_input import (
    CONTACTS,
    as_state,
    components,
    engine_state,
    state_from,
)

_Array = NDArray[np.float64]


class SectionStates(NamedTuple):
    """The states of an oscillator or an assembly."""

    system: Oscillator | Assembly

    @property
    def masses(self) -> int:
        """Number of masses."""
        return len(self.system.names) if isinstance(self.system, Assembly) else ONE_MASS.masses

    @property
    def stops(self) -> int:
        """Number of stops that the engine counts; an oscillator may lack some of its two."""
        return len(self.system.stops) if isinstance(self.system, Assembly) else ONE_MASS.stops

    @property
    def places(self) -> Parts:
        """Where the parts stand: displacements, velocities, deformations, memories of links."""
        if isinstance(self.system, Assembly):
            return Parts(self.masses, self.stops, len(link_parts(self.system)))
        return ONE_MASS

    @property
    def partners(self) -> list[int]:
        """Of each stop the one that is its mirror image, if the system is its own."""
        if isinstance(self.system, Assembly):
            return assembly_partners(self.system)
        return [1, 0]

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
        signs = np.ones(self.parts)
        if isinstance(self.system, Oscillator):
            signs[self.places.of_point.deformation(1)] = -1.0
        return signs

    @property
    def laws(self) -> list[Stop]:
        """The laws of the stops that there are."""
        if isinstance(self.system, Assembly):
            return [one.stop for one in self.system.stops.values()]
        return list(self.system.stops)

    def near(self, state: State | AssemblyState) -> tuple[_Array, float]:
        """Return a point and a mode near a state that need not be possible."""
        if isinstance(state, AssemblyState):
            vector = self.vector_of(state)
            return self.point(vector), float(vector[MODE])
        right, left = (state.deformation.get(side, 0.0) for side in SIDES)
        parts = np.array([state.displacement, state.velocity, right, -left, state.isolator])
        return parts, float(CONTACTS.index(state.contact or 0))

    def point(self, vector: _Array) -> _Array:
        """Return the parts of a vector."""
        found: _Array = vector[FIRST : FIRST + self.parts] * self.signs
        return found

    def vector(self, parts: _Array, mode: float) -> _Array:
        """Return the vector of a point's parts, in a mode."""
        vector = np.zeros(self.width)
        vector[MODE] = mode
        if isinstance(self.system, Oscillator):
            vector[FRESH] = mode
        elif link_parts(self.system):
            vector[FRESH] = NEW
        vector[FIRST : FIRST + self.parts] = parts * self.signs
        return vector

    def mirror_image(self, vector: _Array) -> _Array | None:
        """Return the mirror image of a vector; None if a stop has no partner."""
        if isinstance(self.system, Oscillator):
            return mirror_image(vector)
        partners = self.partners
        if -1 in partners:
            return None
        places, mode = self.places, int(vector[MODE])
        image, moving = np.zeros(places.width), slice(FIRST, places.deformation(0))
        deformations = slice(places.deformation(0), places.memory())
        memories = slice(places.memory(), places.age)
        image[MODE] = sum(1 << partners[f] for f in range(places.stops) if mode >> f & 1)
        image[moving], image[memories] = -vector[moving], -vector[memories]
        image[deformations] = vector[deformations][partners]
        if link_parts(self.system):
            image[FRESH] = NEW
        return image

    def velocities(self) -> NDArray[np.bool_]:
        """Which parts are velocities."""
        places = self.places.of_point
        found = np.zeros(places.total, dtype=bool)
        found[places.velocity() : places.deformation(0)] = True
        return found

    @property
    def names(self) -> list[str]:
        """Names of the components of a state in a dataset."""
        if isinstance(self.system, Assembly):
            return component_names(self.system)
        return COMPONENTS

    def components(self, vector: _Array, phase: float) -> _Array:
        """Return a vector, or an oscillator's vectors, as components of a dataset's state."""
        if isinstance(self.system, Assembly):
            if vector.ndim > 1:
                return np.array([self.components(one, phase) for one in vector])
            return state_components(self.system, vector, phase)
        return components(vector, phase)

    def state(self, vector: _Array, phase: float) -> State | AssemblyState:
        """Return a vector at a forcing phase as a state."""
        if isinstance(self.system, Assembly):
            return assembly_state_from(self.system, vector, phase)
        return state_from(vector, phase)

    def read(
        self, start: State | AssemblyState | xr.DataArray | xr.Dataset | None
    ) -> State | AssemblyState:
        """Return a start as a state; None is the static equilibrium.

        Raises
        ------
        InputError
            If it is not a state of this system.
        """
        if isinstance(self.system, Assembly):
            return (
                equilibrium(self.system) if start is None else as_assembly_state(start, self.system)
            )
        return equilibrium(self.system) if start is None else as_state(start)

    def vector_of(self, state: State | AssemblyState) -> _Array:
        """Return a state as the engine's vector, absent values deduced.

        Raises
        ------
        InputError
            If there can be no such state.
        """
        given: Any = state
        if isinstance(self.system, Assembly):
            return assembly_vector(self.system, given)[: self.width]
        return engine_state(self.system, given)
