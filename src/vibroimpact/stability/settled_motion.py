"""Where a motion goes: it is followed until it repeats itself, and compared with others."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.status import Status
from vibroimpact.model import AssemblyState, Repeated, State
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_system import EngineSystem, engine_system
from vibroimpact.response.hold_rows import Settling
from vibroimpact.response.prepared_rig import PreparedRig, prepare
from vibroimpact.stability.fixed_points import Orbit, vector_of
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]


class Settled(NamedTuple):
    """Where a motion went."""

    engine: PreparedRig
    """The phase of its shaking is that of the section."""
    state: _Array
    """State at the section after the last cycle, as the engine's vector."""
    period: int
    """In forcing cycles; 0 if it did not settle."""
    cycles: int
    """Forcing cycles used."""
    status: Status

    @property
    def rig(self) -> Rig:
        """What vibrates and what shakes it."""
        return self.engine.rig

    @property
    def states(self) -> EngineSystem:
        """How states stand in vectors."""
        return self.engine.states

    @property
    def excitation(self) -> Repeated:
        """What shakes it."""
        return self.rig.periodic

    @property
    def symmetric(self) -> bool:
        """Whether its mirror image, half a cycle later, is a motion as well."""
        return self.states.is_symmetric(self.engine.vector) and self.excitation.half_wave


def approach(
    rig: Rig,
    start: State | AssemblyState | _Array,
    tolerance: float = 1e-12,
    max_cycles: int = 2000,
    max_events: int = 10_000,
    progress: Progress | None = None,
) -> Settled:
    """Follow a motion until its stroboscopic state repeats, or for `max_cycles`.

    The start may be the engine's vector at the excitation's phase. Progress counts the cycles.

    Raises
    ------
    InputError
        If the start cannot be, or an undamped mass that no bumper stops is at resonance.
    """
    engine_system(rig.system).check_bounded(rig)
    if not isinstance(start, np.ndarray):
        if start.phase is not None:
            rig = rig.with_parts(rig.system, rig.periodic.replace(phase=start.phase))
        start = engine_system(rig.system).vector_of(start)
    engine = prepare(rig)
    row, reached = engine.dwell(start, Settling(tolerance, max_cycles, 1, max_events), progress)
    return Settled(
        engine,
        reached if np.isfinite(reached).all() else start,
        int(row.period),
        int(row.cycles),
        Status(int(engine.states.judged(row.status, np.nan))),
    )


def section_sizes(engine: PreparedRig) -> _Array:
    """Return what the parts of a section are divided by: velocities by ω, to be displacements."""
    size = np.ones(engine.states.parts)
    size[engine.states.velocities()] = engine.shaking.angular_frequency
    return size


def state_distance(motion: Settled, one: _Array, other: _Array, size: float) -> float:
    """Largest difference of two states of the engine, as a displacement over `size`."""
    difference = np.abs(motion.states.point(one) - motion.states.point(other))
    return float((difference / section_sizes(motion.engine)).max() / size)


def reach(motion: Settled, state: _Array) -> float:
    """Size of a motion near a state, as a displacement (m); never zero."""
    states, omega = motion.states, motion.excitation.angular_frequency
    moved = np.abs(states.point(state)[: 2 * states.masses])
    moved[states.masses :] /= omega
    return max(float(moved.max()), 1e-3 * reach_at_rest(motion.rig), 1e-300)


def reach_at_rest(rig: Rig) -> float:
    """Displacement (m) of a mass that the peak of the shaking moves against the isolator alone.

    Without a spring, against its inertia. Of several masses, an estimate from the largest mass and
    the lowest natural frequency.
    """
    system, excitation = rig.system, rig.periodic
    omega = excitation.angular_frequency
    peak = float(np.sum(excitation.acceleration(engine_system(system).largest_mass, omega)))
    return peak / (system.angular_frequency or omega) ** 2


def settled_on(orbit: Orbit) -> Settled:
    """An orbit as a motion that has settled on it."""
    return Settled(prepare(orbit.rig), vector_of(orbit), orbit.section.count, 0, Status.DONE)
