"""The kinetic and potential energy of an assembly, and which links lose energy unmeasured."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.state import FIRST, MODE
from vibroimpact.model import Assembly, Link
from vibroimpact.model.assembly import numbers
from vibroimpact.response.assembly_state import memory_places

_Array = NDArray[np.float64]


class StoredEnergy:
    """The numbers of an assembly that its energies need."""

    def __init__(self, assembly: Assembly) -> None:
        of = numbers(assembly)
        self._mass, self._stiffness, self._constant = of.mass, of.stiffness, of.force
        stops = [one.stop for one in assembly.stops.values()]
        links = {one.name: one.law for one in of.links}
        self._closing = _rows(assembly, assembly.stops.values())
        self.lossy: NDArray[np.bool_] = np.array(
            [name in links and _loses_elsewhere(links[name]) for name in assembly.links], dtype=bool
        )
        """Which links lose energy otherwise than in a linear dashpot."""
        self._curved = [assembly.links[name].isolator for name in links]
        self._drifts = -_rows(assembly, [assembly.links[name] for name in links])
        memories = memory_places(assembly)
        self._memories = [memories.get(name) for name in links]
        pairs = [one.spring_and_dashpot for one in stops]
        self._springs = np.array([0.0 if pair is None else pair[0] for pair in pairs])
        self._curved_stops = {
            f: one
            for f, (one, pair) in enumerate(zip(stops, pairs, strict=True))
            if pair is None and not one.rigid
        }

    def of(self, state: _Array) -> float:
        """Return kinetic and potential energy (J) of an engine's state."""
        n, count = len(self._mass), len(self._springs)
        u, v, d = np.split(state[FIRST:][: 2 * n + count], [n, 2 * n])
        springs = float(u @ self._stiffness @ u) + float(self._springs @ (d * d))
        linear = 0.5 * (float(v @ self._mass @ v) + springs) - float(self._constant @ u)
        curved = sum(
            law.stored_energy(float(s), 0.0 if place is None else float(state[place]))
            for law, s, place in zip(self._curved, self._drifts @ u, self._memories, strict=True)
        )
        return linear + curved + float(self.of_curved(state).sum())

    def of_curved(self, state: _Array) -> _Array:
        """Return the energy (J) of each stop without a linear spring; 0 of the others."""
        energies, mode = np.zeros(len(self._springs)), int(state[MODE])
        n = len(self._mass)
        u, memories = state[FIRST:][:n], state[FIRST:][2 * n :]
        for f, law in self._curved_stops.items():
            pressed = mode >> f & 1
            depth = max(float(self._closing[f] @ u) - law.gap, 0.0)
            if law.remembers:
                memory = float(memories[f])
                energies[f] = law.stored_energy(depth if pressed else memory, memory)
            elif pressed:
                energies[f] = law.stored_energy(depth)
        return energies


def _loses_elsewhere(law: Any) -> bool:
    _, damping, does = law.engine_numbers()
    drags = damping > 0.0 and does.drag != 1.0
    return bool(does.hysteretic or does.friction or drags or does.own)


def _rows(assembly: Assembly, links: Iterable[Link]) -> _Array:
    """Return the rows of closing displacements, shape (link, mass)."""
    return np.array([assembly.closing(one) for one in links]).reshape(-1, len(assembly.names))
