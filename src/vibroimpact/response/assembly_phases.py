"""The phases of an assembly's motion: what the engine measures of it from event to event."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.assembly import layout
from vibroimpact.engine.observers import phases
from vibroimpact.engine.observers.phases import Layout
from vibroimpact.engine.observers.record import IMPACT
from vibroimpact.model import Assembly
from vibroimpact.model.assembly import numbers
from vibroimpact.response.motion_phases import Followed

_Array = NDArray[np.float64]
_Flags = NDArray[np.bool_]


class PartColumns:
    """Rows of phases by what vibrates, which `engine.assembly.stretches` measures."""

    rows: _Array
    layout: Layout

    def of_mass(self, column: int) -> _Array:
        """Return a column of each mass, shape (row, mass)."""
        of = self.layout
        return self.rows[:, of.mass(column) : of.mass(0, of.masses) : phases.MASS]

    def of_stop(self, column: int) -> _Array:
        """Return a column of each stop, shape (row, stop)."""
        of = self.layout
        return self.rows[:, of.stop(column, 0) : of.stop(0, of.stops) : phases.STOP]

    def of_drift(self, column: int) -> _Array:
        """Return a column of each drift, shape (row, drift)."""
        of = self.layout
        return self.rows[:, of.drift(column, 0) : of.drift(0, of.drifts) : phases.DRIFT]


class AssemblyPhases(PartColumns):
    """Phases of a motion, in the order of time.

    Parameters
    ----------
    assembly
        What vibrates.
    followed
        Its motion.
    begin, final : ndarray
        The engine's states at its begin and at its end.
    """

    def __init__(
        self, assembly: Assembly, followed: Followed, begin: _Array, final: _Array
    ) -> None:
        self.status, self.rows, self.bounds, self.angle = followed
        self.layout = phases_layout(assembly)
        self.begin, self.final = begin, final
        self.parts = AssemblyParts(assembly)

    @property
    def pressed(self) -> _Flags:
        """Which stops are touched, shape (phase, stop)."""
        bits = self.rows[:, phases.TOUCHED].astype(np.int64)[:, np.newaxis]
        touched = bits >> np.arange(self.layout.stops) & 1 > 0
        # At a single instant a stop is touched if it pushes.
        lasts = self.rows[:, phases.LENGTH] > 0.0
        found: _Flags = touched & (lasts[:, np.newaxis] | (self.of_stop(phases.FORCE) != 0.0))
        return found

    @property
    def impacts(self) -> NDArray[np.int64]:
        """Phases that end in an impact on a rigid stop."""
        return np.flatnonzero(self.rows[:, phases.KIND] == IMPACT)

    def stored(self) -> float:
        """Return by how much kinetic and potential energy have grown (J)."""
        return self.parts.energy(self.final) - self.parts.energy(self.begin)


class AssemblyParts:
    """The numbers of an assembly that its energies need."""

    def __init__(self, assembly: Assembly) -> None:
        of = numbers(assembly)
        self.mass, self.stiffness, self.constant = of.mass, of.stiffness, of.force
        stops = assembly.stops.values()
        closing = [assembly.closing(stop) for stop in stops]
        self.closing = np.array(closing) if closing else np.empty((0, len(of.mass)))
        pairs = [one.stop.spring_and_dashpot for one in stops]
        self.springs = np.array([0.0 if pair is None else pair[0] for pair in pairs])
        self.rigid = np.array([one.stop.rigid for one in stops], dtype=bool)
        self.curved = np.array(
            [not link.law.linear for link in assembly.links.values()], dtype=bool
        )

    def energy(self, state: _Array) -> float:
        """Return kinetic and potential energy; of curved links it is not known (NaN)."""
        if self.curved.any():
            return math.nan
        n, count = len(self.mass), len(self.springs)
        u, v, d = np.split(state[layout.PARTS :][: 2 * n + count], [n, 2 * n])
        springs = float(u @ self.stiffness @ u) + float(self.springs @ (d * d))
        return 0.5 * (float(v @ self.mass @ v) + springs) - float(self.constant @ u)


def phases_layout(assembly: Assembly) -> Layout:
    """Return where in a row of a phase of an assembly the columns are."""
    return Layout(len(assembly.names), len(assembly.stops), len(assembly.links))
