"""Basins of attraction of an assembly on a plane through one of its states.

Two coordinates of the state are varied, and all others are fixed. No trap is known in so many
dimensions: each motion is followed until it repeats itself, and then compared with those that are
known.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import check_mapping
from vibroimpact.attraction.attractor_variables import (
    basin_variables,
    lattice_words,
    ranked,
    renamed,
)
from vibroimpact.attraction.attractors import check_loses, described
from vibroimpact.attraction.find_attractors import MOST
from vibroimpact.attraction.node_labels import NOWHERE, UNDECIDED, NodeLabels, label_nodes
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import MORE_CYCLES, Status
from vibroimpact.errors import InputError, shown, unknown
from vibroimpact.grids.refinement import Nodes
from vibroimpact.model import Assembly
from vibroimpact.model.quantities import LENGTH, VELOCITY, Quantity
from vibroimpact.model.quantity_lists import read_span
from vibroimpact.model.rig import Rig
from vibroimpact.response.hold_rows import Settling
from vibroimpact.response.prepared_rig import PreparedRig, prepare
from vibroimpact.stability.equivalence import ALIKE, distance, same
from vibroimpact.stability.nearest_state import nearest_state
from vibroimpact.stability.settled_motion import Settled, approach
from vibroimpact.tasks.threads import Progress, Workers, each

_Array = NDArray[np.float64]
_TOLERANCE = 1e-9
"""Of the states that are compared: finer than `SAME`."""
_VISITS = 1000
"""Cycles by which a motion that does not repeat itself is known."""
_KEPT = ("displacement_excursion", "acceleration_excursion", "eccentricity", "impacts")


class Coordinate(NamedTuple):
    """A coordinate of the plane."""

    name: str
    """As a component of a state, such as ``displacement.base``."""
    low: float
    high: float
    quantity: Quantity

    @property
    def units(self) -> str:
        """As they are written in datasets."""
        return "m s-1" if self.quantity is VELOCITY else "m"

    @property
    def long_name(self) -> str:
        """Its meaning."""
        part, _, of = self.name.partition(".")
        return f"initial {part} of {of}"


class _End(NamedTuple):
    """Where a motion went."""

    motion: Settled
    visited: _Array
    """Displacements of the first mass at the section, sorted; of a motion that does not repeat."""


class _Known(NamedTuple):
    """A motion that is known."""

    end: _End
    motion: xr.Dataset


def read_plane(plane: object, assembly: Assembly) -> tuple[Coordinate, Coordinate]:
    """Read the two coordinates of the plane and their ranges.

    Raises
    ------
    InputError
        If they are not two components of a state with their lowest and highest value.
    """
    of = {
        **{f"displacement.{name}": LENGTH for name in assembly.names},
        **{f"velocity.{name}": VELOCITY for name in assembly.names},
    }
    first = assembly.names[0]
    what = (
        "a dict of two coordinates with their ranges, such as "
        f'{{"displacement.{first}": (-0.02, 0.02), "velocity.{first}": (-1.0, 1.0)}}'
    )
    spans = check_mapping(plane, "plane", what)
    if len(spans) != 2:
        raise InputError(f"plane: {', '.join(map(shown, spans)) or 'empty'}; pass {what}")
    axes = []
    for name, span in spans.items():
        if name not in of:
            raise InputError(f"plane: {unknown(name, of)}")
        field = f"plane[{name!r}]"
        low, high = read_span(span, of[name], field)
        axes.append(Coordinate(name, low, high, of[name]))
    return axes[0], axes[1]


def assembly_basins(
    rig: Rig,
    plane: tuple[Coordinate, Coordinate],
    start: Any,
    plan: Nodes,
    max_cycles: int,
    max_events: int,
    workers: Workers,
    progress: Progress | None,
) -> xr.Dataset:
    """Return basins on a plane; rows are along the second coordinate.

    `start` fixes the other coordinates; None is the equilibrium.
    """
    search = _Search(rig, start, plane, max_cycles, max_events)
    counts = plan.shape[::-1]
    axes = [np.linspace(one.low, one.high, n) for one, n in zip(plane, counts, strict=True)]

    def label(at: slice | NDArray[np.int64]) -> tuple[NDArray[np.int8], NDArray[np.int32]]:
        chosen = np.arange(plan.shape[0] * plan.shape[1])[at]
        rows, columns = np.divmod(chosen, plan.shape[1])
        starts = {
            k: state
            for k, (i, j) in enumerate(zip(rows, columns, strict=True))
            if (state := search.at(axes[0][j], axes[1][i])) is not None
        }
        ends = each(
            lambda state, _: search.follow(state),
            list(starts.values()),
            threads=workers,
            progress=progress,
        )
        owner = np.full(len(chosen), NOWHERE, dtype=np.int8)
        cycles = np.full(len(chosen), -1, dtype=np.int32)
        for k, end in zip(starts, ends, strict=True):
            owner[k], cycles[k] = search.number(end), end.motion.cycles
        return owner, cycles

    return _dataset(search, plane, axes, plan, label_nodes(plan, label))


class _Search:
    """The motions that are known so far."""

    def __init__(
        self,
        rig: Rig,
        start: Any,
        plane: tuple[Coordinate, Coordinate],
        max_cycles: int,
        max_events: int,
    ) -> None:
        self.rig = rig
        self.engine: PreparedRig = prepare(rig)
        self.states = states = self.engine.states
        self.max_cycles, self.max_events = max_cycles, max_events
        self.base = states.point(states.vector_of(states.read(start)))
        self.places = [states.names.index(one.name) for one in plane]
        laws = rig.system.stop_laws.values()
        self.closing = states.closing
        self.gaps = np.array([one.gap for one in laws])
        self.rigid = np.array([one.rigid for one in laws], dtype=bool)
        self.known: list[_Known] = []

    def at(self, first: float, second: float) -> _Array | None:
        """Return the state at a place of the plane; None beyond a rigid stop."""
        parts = self.base.copy()
        parts[self.places] = first, second
        reaches = self.closing @ parts[: self.states.masses] - self.gaps
        if (reaches[self.rigid] > 0.0).any():
            return None
        deformation = parts[2 * self.states.masses :]
        vector = self.states.vector(parts, 0.0)
        if (reaches < deformation[: len(reaches)]).all() and not deformation.any():
            return vector
        return nearest_state(self.rig, vector)

    def follow(self, state: _Array) -> _End:
        """Follow a motion until it repeats itself."""
        settling = Settling(_TOLERANCE, self.max_cycles, 1, self.max_events)
        row, reached = self.engine.dwell(state, settling)
        status, visited = Status(int(row.status)), np.empty(0)
        if status is Status.NOT_SETTLED or (status is Status.DONE and not int(row.period)):
            status, rows = self.engine.sections(reached.copy(), _VISITS, self.max_events)
            visited = np.sort(rows[:, lyapunov.SECTION])
        motion = Settled(self.engine, reached, int(row.period), int(row.cycles), status)
        return _End(motion, visited)

    def number(self, end: _End) -> int:
        """Return the number of the motion at which one ends, which is added if it is new."""
        if end.motion.status is not Status.DONE:
            return UNDECIDED
        for number, one in enumerate(self.known):
            if one.end.motion.period == end.motion.period and self._is(one.end, end):
                return number
        state = end.motion.state.copy()
        steady_motion = approach(
            self.rig, state, max_cycles=self.max_cycles, max_events=self.max_events
        )
        if steady_motion.status not in (Status.DONE, Status.NOT_SETTLED):
            return UNDECIDED
        motion = described(steady_motion, self.max_events)
        check_loses(motion, steady_motion, "rig: a motion", "add damping to the links")
        if len(self.known) == MOST:
            raise InputError(
                f"rig: more than {MOST} motions were found, so perhaps every state has its own "
                f"motion; add damping, narrow the plane, or raise {MORE_CYCLES}"
            )
        self.known.append(_Known(_End(steady_motion, end.visited), motion))
        return len(self.known) - 1

    def _is(self, one: _End, other: _End) -> bool:
        if other.motion.period:
            return same(one.motion, other.motion, self.max_events)
        return distance(one.visited, other.visited) <= ALIKE


def _dataset(
    search: _Search,
    plane: tuple[Coordinate, Coordinate],
    axes: list[_Array],
    plan: Nodes,
    nodes: NodeLabels,
) -> xr.Dataset:
    order = ranked([one.motion for one in search.known])
    known = [search.known[number].motion for number in order]
    dims = (plane[1].name, plane[0].name)
    nodes = nodes._replace(motion=renamed(nodes.motion, order))
    variables = basin_variables(nodes, plan, dims, known)
    for name in _KEPT if known else ():
        columns = np.array([one[name].values for one in known])
        variables[name] = (("attractor", *known[0][name].dims), columns)
    if known:
        final = np.array([one["final_state"].values for one in known])
        variables["final_state"] = (("attractor", "component"), final)
    of_parts: Mapping[str, Any] = search.rig.system.part_names
    data = xr.Dataset(
        variables,
        {
            dims[0]: axes[1],
            dims[1]: axes[0],
            "attractor": np.arange(len(known)),
            "mass": of_parts["mass"],
            "stop": of_parts["stop"],
            "component": search.states.names,
        },
    )
    data.attrs["lattice"] = lattice_words(plan)
    return data
