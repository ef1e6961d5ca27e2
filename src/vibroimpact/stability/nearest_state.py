"""States from which motions begin: the nearest one that a rig can have, and random ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import parameters as par
from vibroimpact.engine.state import FIRST, ONE_MASS
from vibroimpact.model import Assembly, AssemblyState, State
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.engine_system import engine_rig, engine_system

_Array = NDArray[np.float64]

_RANDOM_SIZE = 1.5
_TRIES = 100
"""Times that all rigid stops are gone through to move bodies apart."""


def random_state(rig: Rig, generator: np.random.Generator, size: float, omega: float) -> _Array:
    """Return a random vector of the engine: displacements, and velocities over ω, up to 1.5 sizes.

    It need not be possible: see `nearest_state`.
    """
    states = engine_system(rig.system)
    n = states.masses
    drawn = generator.uniform(-_RANDOM_SIZE, _RANDOM_SIZE, 2 * n) * size
    state = np.zeros(states.width)
    state[FIRST : FIRST + n], state[FIRST + n : FIRST + 2 * n] = drawn[:n], drawn[n:] * omega
    return state


def nearest_state(rig: Rig, state: _Array) -> _Array:
    """Return the nearest state that a rig can have, as the engine's vector.

    No mass is inside a stop, and no memory of an oscillator's isolator beyond its bounds.
    """
    if rig.system.by_mass:
        return _of_assembly(rig.assembly, state)
    oscillator = rig.oscillator
    u, v = float(state[ONE_MASS.displacement()]), float(state[ONE_MASS.velocity()])
    if oscillator.right is not None and oscillator.right.rigid:
        u = min(u, oscillator.right.gap)
    if oscillator.left is not None and oscillator.left.rigid:
        u = max(u, -oscillator.left.gap)
    deformation = {
        side: max(float(state[ONE_MASS.deformation(number)]), sign * u - stop.gap, 0.0)
        for number, (side, sign) in enumerate((("right", 1.0), ("left", -1.0)))
        if (stop := getattr(oscillator, side)) is not None and stop.spring_and_dashpot is not None
    }
    most = engine_rig(rig)[par.YIELD]
    memory = min(max(float(state[ONE_MASS.memory()]), -most), most)
    return engine_state(oscillator, State(u, v, deformation, isolator=memory))


def _of_assembly(assembly: Assembly, state: _Array) -> _Array:
    """Return the nearest state of an assembly.

    A rigid stop that is passed moves its bodies apart, in the ratio of their inertias; a bumper is
    deformed at least as far as its bodies reach.
    """
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
    return engine_system(assembly).vector_of(made)
