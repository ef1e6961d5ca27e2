"""An oscillator as the engine sees it."""

from __future__ import annotations

import math
from typing import Any, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from vibroimpact.datasets.description import COMPONENTS
from vibroimpact.datasets.stops import by_stop
from vibroimpact.engine.observers import phases
from vibroimpact.engine.observers.phases import Layout
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.one_mass.table import mirror_image
from vibroimpact.engine.state import FIRST
from vibroimpact.engine.status import Status
from vibroimpact.model import Oscillator, Record, Repeated, equilibrium
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.rig import Rig
from vibroimpact.response.analytic_free_response import check_bounded
from vibroimpact.response.any_system import AnyState, AnySystem, Dims
from vibroimpact.response.assembly_rows import range_variables
from vibroimpact.response.engine_input import (
    CONTACTS,
    as_state,
    components,
    engine_state,
    oscillator_numbers,
    section_numbers,
    state_from,
)
from vibroimpact.response.history_variables import EngineRecord, listed, sampled, transmitted
from vibroimpact.response.hold_rows import HoldRows
from vibroimpact.response.softening_limit import ended, judged

_Array: TypeAlias = NDArray[np.float64]


class OneMass(AnySystem):
    """An oscillator, as the engine sees it."""

    system: Oscillator

    @property
    def memories(self) -> int:
        """One number, whether the isolator remembers or not."""
        return 1

    @property
    def partners(self) -> list[int]:
        """Each stop has the other one."""
        return [1, 0]

    @property
    def layout(self) -> Layout:
        """That of one mass."""
        return phases.ONE_MASS

    @property
    def closing(self) -> _Array:
        """By how much a displacement of 1 closes the right and the left side."""
        return np.array([[1.0], [-1.0]])

    @property
    def largest_mass(self) -> float:
        """The mass (kg)."""
        return self.system.mass

    @property
    def highest_frequency(self) -> float:
        """The only natural frequency (Hz)."""
        return self.system.angular_frequency / math.tau

    @property
    def has_dashpot(self) -> bool:
        """Whether the isolator has a dashpot."""
        return self.system.isolator.damping > 0.0

    @property
    def signs(self) -> _Array:
        """Signs of the parts of a point."""
        signs = np.ones(self.parts)
        signs[self.places.of_point.deformation(1)] = -1.0
        return signs

    def numbers(self, shaking: Repeated | Record, **_: Any) -> _Array:
        """Return the oscillator and what shakes it as the engine's vector, without options."""
        return oscillator_numbers(self.system, shaking)

    def section_numbers(self, shaking: Repeated) -> _Array:
        """Return `numbers` with the size and the frequency of the shaking."""
        return section_numbers(self.system, shaking)

    def is_symmetric(self, numbers: _Array) -> bool:
        """Return whether the oscillator is its own mirror image."""
        return self.system.symmetric

    def check_motion(self, shaking: Repeated | Record) -> None:
        """Raise an error if the oscillator is undamped, without stops and at resonance."""
        if not isinstance(shaking, Record) and self.system.isolator.linear:
            check_bounded(Rig(self.system, shaking))  # in closed form about its steady motion

    def check_bounded(self, rig: Rig, field: str = "frequency") -> None:
        """Raise an error if a rig with this system is undamped, without stops and at resonance."""
        check_bounded(rig, field)

    def near(self, state: Any) -> tuple[_Array, float]:
        """Return a point and a mode near a state that need not be possible."""
        right, left = (state.deformation.get(side, 0.0) for side in SIDES)
        parts = np.array([state.displacement, state.velocity, right, left, state.isolator])
        return parts * self.signs, float(CONTACTS.index(state.contact or 0))

    def read(self, start: AnyState | xr.DataArray | xr.Dataset | None) -> AnyState:
        """Return a start as a state; None is the static equilibrium."""
        return equilibrium(self.system) if start is None else as_state(start)

    def vector_of(self, state: Any) -> _Array:
        """Return a state as the engine's vector, absent values deduced."""
        return engine_state(self.system, state)

    def mirror_image(self, vector: _Array) -> _Array | None:
        """Return the mirror image of a vector."""
        return mirror_image(vector)

    @property
    def names(self) -> list[str]:
        """Names of the components of a state in a dataset."""
        return COMPONENTS

    def components(self, vector: _Array, phase: float) -> _Array:
        """Return vectors (last axis) as components of a dataset's state."""
        return components(vector, phase)

    def state(self, vector: _Array, phase: float) -> AnyState:
        """Return a vector at a forcing phase as a state."""
        return state_from(vector, phase)

    def _begun(self, mode: float) -> float:
        return mode

    @property
    def record_widths(self) -> tuple[int, int]:
        """Numbers of values of a sample and of an event."""
        return record_layout.SAMPLE, record_layout.EVENT

    def histories(self, written: EngineRecord) -> dict[str, Any]:
        """Return samples and events as variables of a dataset."""
        samples = {
            **sampled(written.out, self.system),
            written.forcing: ("time", written.values),
            **listed(written.events, written.interval, self.system),
        }
        forces: tuple[_Array, ...] = ()
        if (force := written.force_on_mass) is not None:
            _, since = samples["event_cycle_time"]
            forces = written.values, force.at(force.angular_frequency * since + written.phase)
        return samples | transmitted(samples, self.system, *forces)

    def measured(
        self, rows: _Array, dims: Dims, stops: NDArray[np.str_] | None = None
    ) -> dict[str, Any]:
        """Return extremes, forces and impacts as variables of a dataset, by stop."""
        held, mass = HoldRows(rows), self.system.mass
        low, high = held.displacement_min, held.displacement_max
        carried = mass * held.transmitted_min, mass * held.transmitted_max
        values = {
            **range_variables("displacement", low, high, dims),
            **range_variables("acceleration", held.acceleration_min, held.acceleration_max, dims),
            **range_variables("transmitted_force", *carried, dims),
            "eccentricity": (dims, 0.5 * (high + low)),
        }
        for name, both in (
            ("impacts", held.impacts),
            ("peak_force", mass * held.peak_force),
            ("peak_impulse", mass * held.peak_impulse),
        ):
            values[name] = ((*dims, "stop"), by_stop(self.system, both, stops))
        return values

    def judged(self, outcome: ArrayLike, farthest: ArrayLike) -> NDArray[np.int64]:
        """Return how computations ended, `Status.REVERSED` where the isolator pushed away."""
        return judged(self.system, outcome, farthest)

    def ended(self, status: Status, out: _Array, vector: _Array) -> Status:
        """Return how a motion with these samples and this initial state ended."""
        return ended(self.system, status, out[record_layout.DISPLACEMENT], vector[FIRST])

    def of_masses(self, dims: Dims, values: NDArray[Any]) -> tuple[Dims, NDArray[Any]]:
        """Return the values of the only mass, without the dim ``mass``."""
        return dims, values[..., 0]

    def phase_rows(self, rows: _Array) -> _Array:
        """Return the rows of phases, which are per unit mass without constant force, in SI.

        The force on the base is F_0 − M (ü + A_t), F_0 the constant force and A_t the acceleration
        of the base, or what stands for a force on the mass.
        """
        mass, in_si = self.system.mass, rows.copy()
        of_stops = [
            phases.ONE_MASS.stop(column, number)
            for column in (phases.FORCE, phases.IMPULSE, phases.LOSES, phases.HIT)
            for number in range(phases.ONE_MASS.stops)
        ]
        in_si[:, [phases.LOST, phases.STRUCK, *of_stops]] *= mass
        in_si[:, phases.WORK] *= -mass
        carried = [phases.CARRIED_LEAST, phases.CARRIED_MOST]
        in_si[:, carried] = self.system.force - mass * rows[:, carried[::-1]]
        return in_si
