"""An assembly as the engine sees it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import steady_response
from vibroimpact.engine.assembly import measures
from vibroimpact.engine.assembly import record as several
from vibroimpact.engine.assembly.curved.layout import NEW
from vibroimpact.engine.assembly.layout import SYMMETRIC
from vibroimpact.engine.observers.phases import Layout
from vibroimpact.engine.state import FIRST, FRESH, MODE
from vibroimpact.model import Assembly, Record, Repeated, equilibrium
from vibroimpact.response import assembly_rig
from vibroimpact.response.any_system import AnyState, AnySystem, Dims
from vibroimpact.response.assembly_rows import range_variables
from vibroimpact.response.assembly_state import (
    as_assembly_state,
    assembly_state_from,
    assembly_vector,
    component_names,
    state_components,
)
from vibroimpact.response.history_variables import (
    EngineRecord,
    busiest_by_mass,
    doubts_by_mass,
    listed_by_mass,
    sampled_by_mass,
)

if TYPE_CHECKING:
    from vibroimpact.engine.assembly.plan import Drift

_Array: TypeAlias = NDArray[np.float64]


class SeveralMasses(AnySystem):
    """An assembly, as the engine sees it."""

    system: Assembly

    @property
    def memories(self) -> int:
        """One number for each curved part of a link."""
        return len(assembly_rig.link_parts(self.system))

    @property
    def partners(self) -> list[int]:
        """Of each stop the one that is its mirror image, −1 if there is none."""
        return assembly_rig.assembly_partners(self.system)

    @property
    def layout(self) -> Layout:
        """That of its masses, stops and links."""
        return Layout(self.masses, self.stops, len(self.system.links))

    @property
    def closing(self) -> _Array:
        """Matrix W with one row w per stop, for which u_left − u_right = w u."""
        rows = [self.system.closing(one) for one in self.system.stops.values()]
        return np.array(rows).reshape(self.stops, self.masses)

    @property
    def largest_mass(self) -> float:
        """The largest entry of the mass matrix (kg)."""
        return float(self.system.mass_matrix.max())

    @property
    def highest_frequency(self) -> float:
        """Highest undamped natural frequency without stops (Hz)."""
        return float(self.system.natural_frequencies.max())

    @property
    def has_dashpot(self) -> bool:
        """Whether a link, or the damping besides those of links, has a dashpot."""
        return bool(self.system.damping_matrix.any())

    def numbers(
        self,
        shaking: Repeated | Record,
        *,
        tables: bool | None = None,
        drifts: Sequence[Drift] | None = None,
    ) -> _Array:
        """Return the assembly and what shakes it as the engine's vector."""
        return assembly_rig.assembly_numbers(self.system, shaking, tables=tables, drifts=drifts)

    def section_numbers(self, shaking: Repeated) -> _Array:
        """Return `numbers` with the size and the frequency of the shaking."""
        return np.append(self.numbers(shaking), [shaking.amplitude, shaking.frequency])

    def is_symmetric(self, numbers: _Array) -> bool:
        """Return whether the assembly with these `numbers` is its own mirror image."""
        return bool(numbers[SYMMETRIC] == 1.0)

    def check_motion(self, shaking: Repeated | Record) -> None:
        """Raise an error if the assembly has more parts than a motion has room for."""
        assembly_rig.check_laws(self.system)

    def check_size(self) -> None:
        """Raise an error if the assembly has more parts than the engine's maps have room for."""
        assembly_rig.check_size(self.system)

    def near(self, state: Any) -> tuple[_Array, float]:
        """Return a point and a mode near a state."""
        vector = self.vector_of(state)
        return self.point(vector), float(vector[MODE])

    def read(self, start: AnyState | xr.DataArray | xr.Dataset | None) -> AnyState:
        """Return a start as a state; None is the static equilibrium."""
        return equilibrium(self.system) if start is None else as_assembly_state(start, self.system)

    def vector_of(self, state: Any) -> _Array:
        """Return a state as the engine's vector, absent values deduced."""
        return self.motion_vector(state)[: self.width]

    def motion_vector(self, state: Any) -> _Array:
        """Return `vector_of` with the clock."""
        return assembly_vector(self.system, state)

    def mirror_image(self, vector: _Array) -> _Array | None:
        """Return the mirror image of a vector; None if a stop has no partner."""
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
        image[FRESH] = self._begun(mode)
        return image

    @property
    def names(self) -> list[str]:
        """Names of the components of a state in a dataset."""
        return component_names(self.system)

    def components(self, vector: _Array, phase: float) -> _Array:
        """Return a vector, or vectors (last axis), as components of a dataset's state."""
        if vector.ndim > 1:
            return np.array([self.components(one, phase) for one in vector])
        return state_components(self.system, vector, phase)

    def state(self, vector: _Array, phase: float) -> AnyState:
        """Return a vector at a forcing phase as a state."""
        return assembly_state_from(self.system, vector, phase)

    def _begun(self, mode: float) -> float:
        return NEW if self.memories else 0.0

    @property
    def record_widths(self) -> tuple[int, int]:
        """Numbers of values of a sample and of an event."""
        return several.samples_of(self.masses, self.stops), several.event_width(self.masses)

    def histories(self, written: EngineRecord) -> dict[str, Any]:
        """Return samples and events as variables of a dataset."""
        force = written.force_on_mass
        on = None if force is None else force.on or self.system.names[0]
        return {
            **sampled_by_mass(written.out, self.system, written.values, on),
            written.forcing: ("time", written.values),
            **listed_by_mass(np.concatenate(written.events), written.interval, self.system),
        }

    def event_doubts(
        self, events: list[_Array], undecided: bool, section: str
    ) -> tuple[dict[str, Any], list[str]]:
        """Return a count of the impacts that were ordered by a rule, and notes about events."""
        rows = np.concatenate(events)
        count = {"simultaneous_impacts": int(rows[:, several.E_ORDERED].sum())}
        return count, doubts_by_mass(rows, undecided, section)

    def cause_of_events(self, events: list[_Array], section: int) -> str:
        """Describe which parts cause too many events in a section; may be empty."""
        return busiest_by_mass(np.concatenate(events), section, self.system)

    def measured(
        self, rows: _Array, dims: Dims, stops: NDArray[np.str_] | None = None
    ) -> dict[str, Any]:
        """Return extremes, forces and impacts as variables of a dataset, by mass and stop."""
        n = self.masses
        seen = rows[..., steady_response.MEASURED :]
        base = measures.OF_MASS * n
        masses = seen[..., :base].reshape(*seen.shape[:-1], n, measures.OF_MASS)
        carried = seen[..., base : base + measures.OF_BASE]
        of_stops = seen[..., base + measures.OF_BASE :].reshape(
            *seen.shape[:-1], self.stops, measures.OF_STOP
        )
        values: dict[str, tuple[tuple[str, ...], _Array]] = {}
        for name, low, high in (
            ("displacement", measures.U_LEAST, measures.U_MOST),
            ("acceleration", measures.A_LEAST, measures.A_MOST),
        ):
            values |= range_variables(name, masses[..., low], masses[..., high], (*dims, "mass"))
        least, most = carried[..., measures.T_LEAST], carried[..., measures.T_MOST]
        values |= range_variables("transmitted_force", least, most, dims)
        ordered = np.nan_to_num(carried[..., measures.ORDERED])
        values["simultaneous_impacts"] = (dims, ordered.astype(np.int64))
        values["eccentricity"] = (
            (*dims, "mass"),
            0.5 * (masses[..., measures.U_LEAST] + masses[..., measures.U_MOST]),
        )
        for name, column in (
            ("impacts", measures.HITS),
            ("peak_force", measures.PUSHED),
            ("peak_impulse", measures.STRUCK),
        ):
            values[name] = ((*dims, "stop"), of_stops[..., column])
        return values

    def doubts_of_rows(self, rows: _Array, what: str) -> list[str]:
        """Return notes about measured rows: what was decided by a rule, or was not decided."""
        base = steady_response.MEASURED + measures.OF_MASS * self.masses
        notes = []
        if count := int((rows[..., base + measures.ORDERED] > 0.0).sum()):
            notes.append(
                f"{count} {what} with impacts at the same instant as another impact or rest of the "
                "same mass (simultaneous_impacts); their order is that of the stops in the "
                "assembly, because restitution alone does not determine the result"
            )
        if count := int(np.nansum(rows[..., base + measures.UNDECIDED])):
            notes.append(
                f"the search for an event was given up {count} time{'s' if count > 1 else ''} and "
                "counted as no event; check the orders of magnitude of the input"
            )
        return notes

    def _deformed(self, deformations: _Array) -> _Array:
        return np.maximum(deformations, 0.0)
