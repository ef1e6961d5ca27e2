"""Saddles: orbits whose disturbances grow in one direction and die out in the other.

Those on a border between basins are found from the border: of two states close to each other that
lead to different motions, the middle is followed. It stays on the border as long as bisection has
located the border, passes near the saddle there, and Newton's method does the rest.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.attraction.find_attractors import Search
from vibroimpact.attraction.label_states import IN_PLANE, NO_TRAPS, SectionSetup, follow
from vibroimpact.attraction.section_coordinates import met
from vibroimpact.attraction.state_grid import lattice
from vibroimpact.attraction.state_window import Window
from vibroimpact.errors import InputError
from vibroimpact.model import State
from vibroimpact.response.engine_input import state_from
from vibroimpact.stability.fixed_points import Orbit, evaluated
from vibroimpact.stability.initial_orbit import first_orbit
from vibroimpact.stability.parameter_family import family
from vibroimpact.tasks.threads import Progress

_Array = NDArray[np.float64]

_LATTICE = 40
"""States along each axis among which borders are sought."""
_TRIED = 6
"""Places of each border from which it is followed."""
_ALL_TRIED = 36
"""Places of all borders: the six borders of four basins in full."""
_HALVINGS = 48
_SHADOWED = 40
"""Cycles that the border is followed."""
_MOST = 4
"""Saddles, those of least period."""
_LONGEST = 8
"""Period of a saddle, in cycles."""
_SAME = 1e-7
"""Of the window: two points that are one."""


class Saddle(NamedTuple):
    """One point of a saddle orbit at the section, and the map over its period there."""

    orbit: Orbit
    point: _Array
    """u and u̇."""
    growing: float
    """The multiplier beyond 1 in size, and its direction."""
    unstable: _Array
    dying: float
    stable: _Array


def saddle_points(orbit: Orbit, where: str) -> list[Saddle]:
    """The points of a saddle orbit, a cycle apart.

    If the orbit is not a saddle, an error is raised whose message begins with `where`.
    """
    full = orbit.section.with_map(orbit.section.count, mirror=False)
    one = full.with_map(1, mirror=False)
    point, saddles = orbit.point, []
    for _ in range(orbit.section.count):
        status, here, _ = evaluated(full, relaxed(point), 0.0)
        values, vectors = np.linalg.eig(here.map_derivative[:2, :2])
        order = np.argsort(-np.abs(values))
        values, vectors = values[order], vectors[:, order]
        saddle = abs(values[0]) > 1.0 > abs(values[1]) and not np.iscomplex(values).any()
        if status or not saddle:
            raise InputError(
                f"{where}: this orbit is not a saddle, because the absolute values of its "
                f"multipliers are {abs(values[0]):.4g} and {abs(values[1]):.4g}; pass an orbit "
                "with one of them above 1 and the other below 1"
            )
        real, ways = values.real, vectors.real
        saddles.append(Saddle(here, point[:2].copy(), real[0], ways[:, 0], real[1], ways[:, 1]))
        _, _, point = evaluated(one, point, here.mode)
    return saddles


def check_flies(stage: SectionSetup, orbit: Orbit) -> None:
    """Check that no point of an orbit has more to it than the plane shows.

    It must not press a stop whose force depends on the speed at which it was met.
    """
    one = orbit.section.with_map(1, mirror=False)
    point = orbit.point
    for _ in range(orbit.section.count):
        if met(stage, point).any():
            raise InputError(
                f"excitation.phase: at {stage.excitation.phase:.6g} rad, the mass on the saddle "
                f"orbit (at {point[0]:.6g} m) touches a stop whose force depends on the impact "
                "speed, so the manifolds of the saddle do not lie in a plane; choose a phase at "
                "which the mass touches no stop"
            )
        _, _, point = evaluated(one, point, orbit.mode)


def relaxed(point: _Array) -> _Array:
    """A point of the section map with relaxed bumpers."""
    relaxed_point = point.copy()
    relaxed_point[2:4] = 0.0
    return relaxed_point


def given_saddle(stage: SectionSetup, orbit: xr.Dataset | State, period: int, where: str) -> Orbit:
    """A saddle from a dataset of `orbit`, or near a state."""
    fam = family(stage.rig, "frequency")
    start = orbit
    if isinstance(orbit, xr.Dataset):
        if "monodromy" not in orbit or "final_state" not in orbit:
            raise InputError(
                f"{where}: this dataset is not an orbit; pass the result of orbit, or a State near "
                "the saddle"
            )
        period = int(orbit["period"])
        phase = float(orbit["final_state"].sel(component="phase"))
        if abs(np.sin(0.5 * (phase - stage.excitation.phase))) > 1e-9:
            raise InputError(
                f"{where}: the phase of this orbit is {phase:.6g} rad, but the phase of the "
                f"excitation is {stage.excitation.phase:.6g} rad; compute the orbit again with the "
                "phase of the excitation"
            )
    saddle = first_orbit(fam, (0.0, 1.0), start, period, symmetric=False)
    check_flies(stage, saddle)
    return saddle


class BorderSaddles(NamedTuple):
    """Saddles on the borders between basins, each once."""

    orbits: list[Orbit]
    left_out: list[str]
    """What was not searched or is not among the orbits, in words."""


def border_saddles(
    search: Search, window: Window, progress: Progress | None = None
) -> BorderSaddles:
    """The saddles that the borders between basins lead to.

    Progress counts states of a lattice, and then places of the borders.
    """
    shape = (_LATTICE, _LATTICE)
    points = np.array(lattice(*window, shape))
    labels = search.label(points, progress).owner.reshape(shape)
    span = np.ptp(np.array(window), axis=1)
    orbits: list[Orbit] = []
    known: list[_Array] = []
    places, borders = _places(labels)
    for number, (inside, outside) in enumerate(places):
        if progress:
            progress(number, len(places))
        edge = _edge(search, points[inside], points[outside])
        orbit = _near(search, edge, span)
        if orbit is None:
            continue
        if any((np.abs(orbit.point[:2] - one) <= _SAME * span).all() for one in known):
            continue
        check_flies(search.stage, orbit)
        try:
            cycle = saddle_points(orbit, "saddles")
        except InputError:
            continue
        orbits.append(orbit)
        known += [one.point for one in cycle]
    if progress and places:
        progress(len(places), len(places))
    left_out = []
    if borders > _ALL_TRIED:
        left_out.append(
            f"{borders - _ALL_TRIED} of {borders} borders between two basins were not searched for "
            "saddles; narrow the window to search them"
        )
    if len(orbits) > _MOST:
        left_out.append(
            f"{len(orbits)} saddle orbits were found; only the {_MOST} of the shortest period have "
            "curves; pass others as saddles"
        )
    return BorderSaddles(sorted(orbits, key=lambda one: one.section.count)[:_MOST], left_out)


def _places(labels: NDArray[np.int8]) -> tuple[list[tuple[int, int]], int]:
    """Neighbours that lead to different motions, some on each border; and the number of borders.

    All borders come once before any comes again.
    """
    kinds: dict[tuple[int, int], list[tuple[int, int]]] = {}
    index = np.arange(labels.size).reshape(labels.shape)
    for a, b in ((index[:, :-1], index[:, 1:]), (index[:-1], index[1:])):
        one, other = labels.ravel()[a.ravel()], labels.ravel()[b.ravel()]
        for k in np.flatnonzero((one != other) & (one >= 0) & (other >= 0)):
            kind = (min(one[k], other[k]), max(one[k], other[k]))
            kinds.setdefault(kind, []).append((int(a.ravel()[k]), int(b.ravel()[k])))
    every = []
    for number in range(_TRIED):
        for pairs in kinds.values():
            pick = np.linspace(0, len(pairs) - 1, min(_TRIED, len(pairs))).astype(int)
            every += [pairs[k] for k in pick[number : number + 1]]
    return every[:_ALL_TRIED], len(kinds)


def _edge(search: Search, one: _Array, other: _Array) -> _Array:
    """A state on the border between two, as near as numbers allow."""
    stage, traps = search.stage, search.traps
    label = follow(stage, one[None], None, traps, search.max_cycles).owner[0]
    for _ in range(_HALVINGS):
        middle = 0.5 * (one + other)
        if follow(stage, middle[None], None, traps, search.max_cycles).owner[0] == label:
            one = middle
        else:
            other = middle
    return 0.5 * (one + other)


def _near(search: Search, edge: _Array, span: _Array) -> Orbit | None:
    """The orbit that a state on a border comes nearest to, before it leaves for a motion."""
    stage = search.stage
    went = follow(stage, edge[None], None, NO_TRAPS, 0)
    states: list[_Array] = []
    while len(states) < _SHADOWED and len(went.states):
        states.append(went.states[0])
        went = follow(stage, None, went.states, search.traps, 0)
        went = follow(stage, None, went.states, NO_TRAPS, 1)
    if not states:
        return None
    way = np.array(states)[:, IN_PLANE] / span
    fam = family(stage.rig, "frequency")
    closest = {
        period: np.linalg.norm(way[period:] - way[:-period], axis=1)
        for period in range(1, min(_LONGEST, len(way) - 1) + 1)
    }
    for period in sorted(closest, key=lambda n: float(closest[n].min())):
        at = int(closest[period].argmin())
        try:
            start = state_from(states[at], stage.excitation.phase)
            orbit = first_orbit(fam, (0.0, 1.0), start, period, symmetric=False)
        except InputError:
            continue
        near = np.linalg.norm((orbit.point[:2] - states[at][IN_PLANE]) / span) < 0.02
        if near and not orbit.stable:
            return orbit
    return None
