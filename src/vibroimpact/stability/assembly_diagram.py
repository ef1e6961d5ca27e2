"""States of assemblies from which bifurcation diagrams and basins begin."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import hold
from vibroimpact.engine.assembly import measures
from vibroimpact.engine.state import FIRST
from vibroimpact.engine.status import Status
from vibroimpact.model import Assembly, AssemblyState
from vibroimpact.model.rig import Rig
from vibroimpact.response.section_states import SectionStates
from vibroimpact.stability.settled_motion import reach_at_rest

if TYPE_CHECKING:
    from vibroimpact.stability.parameter_sweep import Held

_Array = NDArray[np.float64]

_RANDOM_SIZE = 1.5
_TRIES = 100
"""Times that all rigid stops are gone through to move bodies apart."""


def place_assembly(rig: Rig, state: _Array) -> _Array:
    """Return the nearest state that an assembly can have, as the engine's vector.

    A rigid stop that is passed moves its bodies apart, in the ratio of their inertias; a bumper is
    deformed at least as far as its bodies reach.
    """
    assembly = rig.system
    assert isinstance(assembly, Assembly)
    n, names = len(assembly.names), assembly.names
    parts = state[FIRST:]
    u, v, d = parts[:n].copy(), parts[n : 2 * n], parts[2 * n :]
    walls = [
        (assembly.closing(one), one.stop.gap) for one in assembly.stops.values() if one.stop.rigid
    ]
    for _ in range(_TRIES):
        apart = True
        for w, gap in walls:
            if (beyond := float(w @ u) - gap) > 0.0:
                moved = np.linalg.solve(assembly.mass_matrix, w)
                u, apart = u - moved * (beyond / float(w @ moved)), False
        if apart:
            break
    deformation = {
        name: max(float(d[f]), float(assembly.closing(one) @ u) - one.stop.gap, 0.0)
        for f, (name, one) in enumerate(assembly.stops.items())
        if not one.stop.rigid
    }
    made = AssemblyState(
        displacement=dict(zip(names, u.tolist(), strict=True)),
        velocity=dict(zip(names, v.tolist(), strict=True)),
        deformation=deformation,
    )
    return SectionStates(assembly).vector_of(made)


def random_assembly_states(
    met: Iterable[Held], every: Sequence[Rig], count: int, seed: int
) -> list[_Array]:
    """Return random states of an assembly, as `random_states` does of an oscillator."""
    states = SectionStates(every[0].system)
    n = states.masses
    sizes = [
        float(np.abs(_of_masses(one, n)).max())
        for one in met
        if one.found.status in (Status.DONE, Status.NOT_SETTLED)
    ]
    gaps = [law.gap for rig in every for law in SectionStates(rig.system).laws]
    size = max([0.0, *sizes, *gaps]) or max(reach_at_rest(one) for one in every)
    omega = float(np.median([rig.periodic.angular_frequency for rig in every]))
    generator = np.random.default_rng(seed)
    found = []
    for _ in range(count):
        drawn = generator.uniform(-_RANDOM_SIZE, _RANDOM_SIZE, 2 * n) * size
        state = np.zeros(states.width)
        state[FIRST : FIRST + n], state[FIRST + n : FIRST + 2 * n] = drawn[:n], drawn[n:] * omega
        found.append(state)
    return found


def _of_masses(held: Held, n: int) -> _Array:
    """Return the least and the largest displacement of each mass."""
    of_masses = held.measured.array[hold.MEASURED :][: measures.OF_MASS * n].reshape(n, -1)
    found: _Array = of_masses[:, [measures.U_LEAST, measures.U_MOST]]
    return found
