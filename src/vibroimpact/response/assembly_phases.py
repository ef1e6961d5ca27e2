"""The phases of an assembly's motion: what the engine measures of it from event to event."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.assembly import layout
from vibroimpact.engine.observers import phases
from vibroimpact.engine.observers.phases import Layout
from vibroimpact.engine.observers.record import IMPACT
from vibroimpact.model import Assembly, Link
from vibroimpact.model.assembly import numbers
from vibroimpact.response.assembly_state import memory_places
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

    def held_by_stops(self) -> _Array:
        """Return by how much the energies of stops without memory have grown (J).

        The engine counts what such a stop takes up while it is touched, lost or not.
        """
        return self.parts.pressed_energies(self.final) - self.parts.pressed_energies(self.begin)


class AssemblyParts:
    """The numbers of an assembly that its energies need."""

    def __init__(self, assembly: Assembly) -> None:
        of = numbers(assembly)
        self.mass, self.stiffness, self.constant = of.mass, of.stiffness, of.force
        stops = [one.stop for one in assembly.stops.values()]
        links = {one.name: one.law for one in of.links}
        self.closing = _rows(assembly, assembly.stops.values())
        self.lossy = np.array(
            [name in links and loses_elsewhere(links[name]) for name in assembly.links], dtype=bool
        )
        self._curved = [assembly.links[name].isolator for name in links]
        self._drifts = -_rows(assembly, [assembly.links[name] for name in links])
        memories = memory_places(assembly)
        self._memories = [memories.get(name) for name in links]
        pairs = [one.spring_and_dashpot for one in stops]
        self.springs = np.array([0.0 if pair is None else pair[0] for pair in pairs])
        self.rigid = np.array([one.rigid for one in stops], dtype=bool)
        self._pressed = {
            f: one
            for f, (one, pair) in enumerate(zip(stops, pairs, strict=True))
            if pair is None and not one.rigid
        }

    def energy(self, state: _Array) -> float:
        """Return kinetic and potential energy (J)."""
        n, count = len(self.mass), len(self.springs)
        u, v, d = np.split(state[layout.PARTS :][: 2 * n + count], [n, 2 * n])
        springs = float(u @ self.stiffness @ u) + float(self.springs @ (d * d))
        linear = 0.5 * (float(v @ self.mass @ v) + springs) - float(self.constant @ u)
        curved = sum(
            law.stored_energy(float(s), 0.0 if place is None else float(state[place]))
            for law, s, place in zip(self._curved, self._drifts @ u, self._memories, strict=True)
        )
        return linear + curved + float(self.pressed_energies(state).sum())

    def pressed_energies(self, state: _Array) -> _Array:
        """Return the energy (J) of each stop without memory that is touched, 0 of the others."""
        found, mode = np.zeros(len(self.springs)), int(state[layout.STATE_MODE])
        u = state[layout.PARTS :][: len(self.mass)]
        for f, law in self._pressed.items():
            if mode >> f & 1:
                found[f] = law.stored_energy(max(float(self.closing[f] @ u) - law.gap, 0.0))
        return found


def loses_elsewhere(law: Any) -> bool:
    """Return whether a link loses energy otherwise than in a linear dashpot."""
    _, damping, does = law.engine_numbers()
    drags = damping > 0.0 and does.drag != 1.0
    return bool(does.hysteretic or does.friction or drags or does.own)


def _rows(assembly: Assembly, links: Iterable[Link]) -> _Array:
    """Return the rows of closing displacements, shape (link, mass)."""
    return np.array([assembly.closing(one) for one in links]).reshape(-1, len(assembly.names))


def phases_layout(assembly: Assembly) -> Layout:
    """Return where in a row of a phase of an assembly the columns are."""
    return Layout(len(assembly.names), len(assembly.stops), len(assembly.links))
