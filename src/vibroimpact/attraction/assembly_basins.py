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
from vibroimpact.attraction.find_attractors import MOST
from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import MORE_CYCLES, Status
from vibroimpact.errors import InputError, shown
from vibroimpact.grids.refinement import UNKNOWN, Nodes
from vibroimpact.model import Assembly
from vibroimpact.model.quantities import LENGTH, VELOCITY, Quantity
from vibroimpact.model.quantity_lists import read_span
from vibroimpact.model.rig import Rig
from vibroimpact.response.assembly_rows import coordinates
from vibroimpact.response.hold_rows import Settling
from vibroimpact.response.prepared_rig import PreparedRig, prepare
from vibroimpact.stability.equivalence import ALIKE, SAME, distance
from vibroimpact.stability.nearest_state import nearest_state
from vibroimpact.stability.settled_motion import Settled, approach, later, reach
from vibroimpact.stability.steady import describe_motion
from vibroimpact.tasks.threads import Progress, Workers, each

_Array = NDArray[np.float64]
_Labels = NDArray[np.int16]

UNDECIDED, NOWHERE = -1, -2
"""Number of a state that was given up, and of a state beyond a rigid stop."""
_TOLERANCE = 1e-9
"""Of the states that are compared: finer than `SAME`."""
_VISITS = 1000
"""Cycles by which a motion that does not repeat itself is known."""
_SAMPLES, _WINDOW, _EXPONENTS = 64, 200, 20_000
_LOSES = 1e-9
"""Least share of a volume that dies out in a cycle."""
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

    state: _Array
    period: int
    cycles: int
    status: Status
    visited: _Array
    """Displacements of the first mass at the section, sorted; of a motion that does not repeat."""


class _Known(NamedTuple):
    """A motion that is known."""

    found: Settled
    motion: xr.Dataset
    points: _Array
    """Points of the section of one period."""
    size: float
    visited: _Array


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
    given = check_mapping(plane, "plane", what)
    if len(given) != 2:
        raise InputError(f"plane: {', '.join(map(shown, given)) or 'empty'}; pass {what}")
    found = []
    for name, span in given.items():
        if name not in of:
            raise InputError(f"plane: {shown(name)}; one of {', '.join(of)} is accepted")
        field = f"plane[{name!r}]"
        low, high = read_span(span, of[name], field)
        found.append(Coordinate(name, low, high, of[name]))
    return found[0], found[1]


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

    Parameters
    ----------
    plane
        The two coordinates.
    start
        A state, whose other coordinates are fixed; None for the equilibrium.
    plan
        The nodes, and how often they are refined.
    """
    assembly = rig.system
    assert isinstance(assembly, Assembly)
    search = _Search(rig, start, plane, max_cycles, max_events)
    counts = plan.shape[::-1]
    axes = [np.linspace(one.low, one.high, n) for one, n in zip(plane, counts, strict=True)]
    labels = np.full(plan.shape, UNKNOWN, dtype=np.int8)
    cycles = np.full(plan.shape, -1, dtype=np.int32)
    levels = np.full(plan.shape, -1, dtype=np.int8)
    outside = np.int8(127)
    for level in range(plan.refine + 1):
        chosen = np.flatnonzero(plan.nodes_to_compute(level, labels) & (labels == UNKNOWN))
        rows, columns = np.divmod(chosen, plan.shape[1])
        starts = {
            int(k): state
            for k, i, j in zip(chosen, rows, columns, strict=True)
            if (state := search.at(axes[0][j], axes[1][i])) is not None
        }
        ends = each(
            lambda state, _: search.follow(state),
            list(starts.values()),
            threads=workers,
            progress=progress,
        )
        flat = labels.ravel()
        flat[chosen] = outside
        for k, end in zip(starts, ends, strict=True):
            # One more than the number of the motion; 0 is given up.
            flat[k] = search.number(end) + 1
            cycles.ravel()[k] = end.cycles
        levels.ravel()[chosen] = level
        if level:
            plan.fill(level, labels)
    numbers = labels.astype(np.int16) - np.int16(1)
    numbers[labels == outside] = NOWHERE
    return _dataset(search, plane, axes, plan, numbers, cycles, levels)


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
        assembly = rig.system
        assert isinstance(assembly, Assembly)
        self.base = states.point(states.vector_of(states.read(start)))
        self.places = [states.names.index(one.name) for one in plane]
        stops = list(assembly.stops.values())
        self.closing = np.array([assembly.closing(one) for one in stops]).reshape(-1, states.masses)
        self.gaps = np.array([one.stop.gap for one in stops])
        self.rigid = np.array([one.stop.rigid for one in stops], dtype=bool)
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
        if (reaches < deformation).all() and not deformation.any():
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
        return _End(reached, int(row.period), int(row.cycles), status, visited)

    def number(self, end: _End) -> int:
        """Return the number of the motion at which one ends, which is added if it is new."""
        if end.status is not Status.DONE:
            return UNDECIDED
        for number, one in enumerate(self.known):
            if one.found.period == end.period and self._is(one, end):
                return number
        found = approach(
            self.rig, end.state.copy(), max_cycles=self.max_cycles, max_events=self.max_events
        )
        if found.status not in (Status.DONE, Status.NOT_SETTLED):
            return UNDECIDED
        motion = describe_motion(found, _SAMPLES, _WINDOW, _EXPONENTS, self.max_events)
        self._check_loses(motion)
        if len(self.known) == MOST:
            raise InputError(
                f"rig: more than {MOST} motions were found, so perhaps every state has its own "
                f"motion; add damping, narrow the plane, or raise {MORE_CYCLES}"
            )
        size = reach(found, found.state)
        self.known.append(_Known(found, motion, self._points(found), size, end.visited))
        return len(self.known) - 1

    def _is(self, one: _Known, end: _End) -> bool:
        if not end.period:
            return distance(one.visited, end.visited) <= ALIKE
        apart = np.abs(one.points - self._scaled(end.state)).max(axis=1)
        return bool((apart <= SAME * one.size).any())

    def _scaled(self, state: _Array) -> _Array:
        point = self.states.point(state).copy()
        point[self.states.velocities()] /= self.engine.shaking.angular_frequency
        return point

    def _points(self, found: Settled) -> _Array:
        points, state = [], found.state
        for _ in range(found.period):
            points.append(self._scaled(state))
            _, state = later(found, state, 1.0, self.max_events)
        return np.array(points).reshape(-1, self.states.parts)

    def _check_loses(self, motion: xr.Dataset) -> None:
        lost = float(motion["effective_damping"]) / self.engine.shaking.frequency
        if abs(lost) < _LOSES:
            raise InputError(
                "rig: a motion loses no energy, so neighbouring states do not lead to a common "
                "motion and there are no basins; add damping to the links"
            )


def _dataset(
    search: _Search,
    plane: tuple[Coordinate, Coordinate],
    axes: list[_Array],
    plan: Nodes,
    labels: _Labels,
    cycles: NDArray[np.int32],
    levels: NDArray[np.int8],
) -> xr.Dataset:
    order = ranked([one.motion for one in search.known])
    known = [search.known[number].motion for number in order]
    dims = (plane[1].name, plane[0].name)
    variables = basin_variables(renamed(labels, order), cycles, levels, plan, dims, known)
    for name in _KEPT if known else ():
        columns = np.array([one[name].values for one in known])
        variables[name] = (("attractor", *known[0][name].dims), columns)
    if known:
        final = np.array([one["final_state"].values for one in known])
        variables["final_state"] = (("attractor", "component"), final)
    assembly = search.rig.system
    assert isinstance(assembly, Assembly)
    of_parts: Mapping[str, Any] = coordinates(assembly)
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
