"""Many states followed at once until each is caught.

A `Region` is all that its computation needs, and `follow_region` a pure function of it: regions may
be followed on threads, or wherever else they are sent.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vibroimpact.attraction.state_grid import Lattice
from vibroimpact.engine import absorption
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.engine.status import Status
from vibroimpact.model import Oscillator, Repeated
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_system import engine_rig
from vibroimpact.tasks.threads import Progress, Tally, Workers, each

_Array = NDArray[np.float64]
_Whole = NDArray[np.int64]
_Short = NDArray[np.int32]
_Tiny = NDArray[np.int8]

Points: TypeAlias = _Array | Lattice
"""States as arrays, or the nodes of a grid."""

_REGION = 2000
"""States that a thread follows at a time."""
_WORTH_IT = 16
"""Regions; fewer are followed here sooner than they travel to a cluster."""


class SectionSetup(NamedTuple):
    """A rig and its limit of events; the section is at the phase of the shaking."""

    rig: Rig
    max_events: int = 10_000

    @property
    def oscillator(self) -> Oscillator:
        """What vibrates."""
        return self.rig.oscillator

    @property
    def excitation(self) -> Repeated:
        """What shakes it."""
        return self.rig.periodic


class Traps(NamedTuple):
    """What catches states; see `engine.absorption`."""

    rows: _Array
    cells: _Whole
    grid: _Array


NO_TRAPS = Traps(
    np.empty((0, absorption.trap_width(ONE_MASS.total))),
    np.empty((0, 0), dtype=np.int64),
    np.zeros(absorption.GRID),
)


class Region(NamedTuple):
    """States to be followed, and how far."""

    stage: SectionSetup
    points: Points
    """u, u̇, u_R, u_L, z as the engine counts, where the motions begin; empty where they go on."""
    states: _Array
    """Of the engine, where they go on; empty where they begin."""
    traps: Traps
    cycles: int


class CaughtStates(NamedTuple):
    """Where states were caught."""

    states: _Array
    """Of the engine, of those that may go on: not settled, one after the other."""
    owner: _Tiny
    """Whose trap it was; -1 if none."""
    cycles: _Short
    outcome: _Tiny
    """`Status`: done where it was caught, not settled where it may yet be."""


def follow_region(region: Region, tally: Tally) -> CaughtStates:
    """Follow the states of one region."""
    stage, points, states, traps, cycles = region
    begun = len(points) > 0
    points = np.ascontiguousarray(points)
    states = (
        np.zeros((len(points), ONE_MASS.width)) if begun else np.ascontiguousarray(states).copy()
    )
    results = np.zeros((len(states), absorption.RESULT), dtype=np.int64)
    absorption.caught(
        engine_rig(stage.rig),
        stage.excitation.amplitude,
        stage.excitation.frequency,
        stage.excitation.phase,
        cycles,
        stage.max_events,
        begun,
        points,
        *traps,
        states,
        results,
        tally,
    )
    outcome = results[:, absorption.OUTCOME].astype(np.int8)
    return CaughtStates(
        states[outcome == Status.NOT_SETTLED],
        results[:, absorption.CAUGHT].astype(np.int8),
        results[:, absorption.CYCLES].astype(np.int32),
        outcome,
    )


def follow(
    stage: SectionSetup,
    points: Points | None,
    states: _Array | None,
    traps: Traps,
    cycles: int,
    threads: Workers = None,
    progress: Progress | None = None,
) -> CaughtStates:
    """Follow states in regions, over threads; no result depends on their number.

    Motions begin at the points, or go on from the states: one of the two is None.
    """
    begun: Points = np.empty((0, ONE_MASS.total)) if points is None else points
    held = np.empty((0, ONE_MASS.width)) if states is None else states
    number = max(len(begun), len(held))
    if not number:
        none = np.empty(0, dtype=np.int8)
        return CaughtStates(np.empty((0, ONE_MASS.width)), none, none.astype(np.int32), none)
    where = [slice(i, i + _REGION) for i in range(0, number, _REGION)]
    regions = [Region(stage, begun[part], held[part], traps, cycles) for part in where]
    absorption.caught.prepare(engine_rig(stage.rig))
    if len(regions) < _WORTH_IT and not isinstance(threads, int):
        threads = None
    pieces = each(follow_region, regions, steps=number, threads=threads, progress=progress)
    return CaughtStates(*(np.concatenate(column) for column in zip(*pieces, strict=True)))


def images(
    stage: SectionSetup, points: _Array, cycles: int = 1, threads: Workers = None
) -> tuple[_Array, NDArray[np.bool_]]:
    """Where points of the section are some cycles later (nan if unknown), and which are known.

    Points are u, u̇, u_R, u_L, z, the deformations away from the mass.
    """
    motions = follow(stage, points, None, NO_TRAPS, cycles, threads)
    known = motions.outcome == Status.NOT_SETTLED
    where = np.full(points.shape, np.nan)
    where[known] = parts(motions.states)
    return where, known


def parts(states: _Array) -> _Array:
    """u, u̇, u_R, u_L, z of states of the engine."""
    return states[:, PLACES]


PLACES = [*range(ONE_MASS.first, ONE_MASS.age)]
"""Where u, u̇, u_R, u_L and z stand in a state of the engine."""
IN_PLANE = [ONE_MASS.displacement(), ONE_MASS.velocity()]
"""Where u and u̇ do."""
