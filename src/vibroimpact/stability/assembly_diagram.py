"""Bifurcation diagrams of assemblies: states at each value, and their dataset."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import hold
from vibroimpact.engine.assembly import measures
from vibroimpact.engine.state import FIRST
from vibroimpact.engine.status import Status
from vibroimpact.model import Assembly, AssemblyState
from vibroimpact.model.rig import Rig
from vibroimpact.response.assembly_rows import measured_variables, names_of_parts, notes_on
from vibroimpact.response.section_states import SectionStates
from vibroimpact.response.sections import section_variables
from vibroimpact.stability.settled_motion import reach_at_rest

if TYPE_CHECKING:
    from vibroimpact.stability.diagram_point import Seen
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


def assembly_diagram(
    assembly: Assembly,
    name: str,
    values: _Array,
    found: Mapping[str, list[Seen]],
    phase: float,
) -> tuple[xr.Dataset, list[str]]:
    """Return a diagram with its names, and what was doubted of it."""
    states = SectionStates(assembly)
    seen = list(itertools.chain.from_iterable(found.values()))
    shape, dims = (len(found), len(values)), ("start", name)
    most = max((len(one.points) for one in seen), default=0)
    points: _Array = np.full((len(seen), most, states.parts), np.nan)
    for row, one in zip(points, seen, strict=True):
        row[: len(one.points)] = one.points
    points = points.reshape(*shape, most, states.parts)
    measured = np.array([one.held.measured.array for one in seen])
    measured[[one.status not in (Status.DONE, Status.NOT_SETTLED) for one in seen]] = np.nan
    measured = measured.reshape(*shape, -1)
    frequency = np.array([[one.held.found.excitation.frequency] for one in seen])
    rates = {
        "exponents": frequency * np.array([one.kind.exponents[:2] for one in seen]),
        "exponents_uncertainty": frequency * np.array([one.kind.uncertainty[:2] for one in seen]),
    }
    scalars = {
        "motion": np.array([one.kind.motion for one in seen]),
        "period": np.array([one.kind.period for one in seen], dtype=np.int64),
        "cycles": np.array([one.held.found.cycles for one in seen], dtype=np.int64),
        "status": np.array([int(one.status) for one in seen], dtype=np.int64),
    }
    ends = np.array([states.components(one.held.found.state, phase) for one in seen])
    variables: dict[str, Any] = {
        **measured_variables(assembly, measured, dims),
        **{key: (dims, value.reshape(shape)) for key, value in scalars.items()},
        **{key: ((*dims, "exponent"), v.reshape(*shape, 2)) for key, v in rates.items()},
        **section_variables(assembly, points, (*dims, "section_point")),
        "section": ((*dims, "component"), ends.reshape(*shape, -1)),
    }
    data = xr.Dataset(
        variables,
        {
            "start": list(found),
            name: values,
            "component": states.names,
            **names_of_parts(assembly),
        },
    )
    return data, notes_on(assembly, measured, "motions")
