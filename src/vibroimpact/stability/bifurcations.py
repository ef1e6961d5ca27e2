"""Bifurcations on a followed branch: found by test functions, located to rounding.

=====================  =====================================================================
fold                   the tangent's component along the parameter changes its sign
symmetry breaking      of a motion that is its own mirror image: an eigenvalue of its map over
                       half a cycle and the mirror passes −1, det(H + I) changes its sign
period doubling        a multiplier passes −1: det(M + I) changes its sign
Neimark–Sacker         a complex pair passes the unit circle
grazing                the contacts change (`trace`)
=====================  =====================================================================
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import section_map
from vibroimpact.engine.status import Status
from vibroimpact.stability.orbits import SEEN, Orbit, Section, corrected, evaluated
from vibroimpact.stability.trace import Station, Trace, bisect

_Array = NDArray[np.float64]

FOLD = "fold"
BREAKING = "symmetry breaking"
DOUBLING = "period doubling"
NEIMARK = "Neimark-Sacker"
GRAZING = "grazing"

_NEAR = 1e-2
"""Scaled distance from its own mirror image below which an orbit may be next to a breaking."""
_OFF = (1e-3, 3e-4, 1e-4, 3e-3, 1e-2)
"""Scaled distances from a bifurcation at which the branch that is born there is sought."""


class Bifurcation(NamedTuple):
    """An orbit at which something changes."""

    kind: str
    orbit: Orbit
    arclength: float
    """Along the branch on which it was found."""
    turns: bool
    """Whether the branch turns back here."""
    contacts_behind: tuple[int, int]
    """Contacts on each side per period beyond it; the orbit's own but for a grazing."""


def half_plus(orbit: Orbit) -> float:
    """det(M + I) of an orbit's map: zero where an eigenvalue is −1."""
    return float(np.linalg.det(orbit.columns + np.eye(4)))


def spiral(orbit: Orbit) -> float:
    """Logarithm of the largest modulus among complex multipliers; −1 if there is none."""
    values = orbit.map_multipliers
    complex_ones = np.abs(values[np.abs(values.imag) > 1e-9 * np.abs(values)])
    return math.log(complex_ones.max()) if complex_ones.size else -1.0


def find(stations: list[Station]) -> Iterator[Bifurcation]:
    """Bifurcations on a branch, in its order; between stations of one smooth piece."""
    for here, there in itertools.pairwise(stations):
        if here.piece != there.piece:
            # Followed backwards, the grazing orbit comes second.
            exact, other = (here, there) if here.grazing else (there, here)
            yield Bifurcation(
                GRAZING,
                exact.orbit,
                exact.arclength,
                bool(here.tangent[4] * there.tangent[4] < 0.0),
                other.orbit.contacts,
            )
            continue
        for kind, function in _tests(here):
            first, second = function(here.orbit), function(there.orbit)
            # A zero at the end belongs to the next step.
            if not (first * second < 0.0 or (first == 0.0 and second != 0.0)):
                continue
            if kind == NEIMARK and -1.0 in (first, second):
                continue  # a real pair became complex, or the other way round
            located = _locate(here, there, function)
            if located is None:
                continue
            orbit, length = located
            turns = kind == FOLD
            if turns and (parent := _parent(orbit)) is not None:
                # The branch turns where it meets that of the motions which it left.
                kind, orbit = parent
            yield Bifurcation(kind, orbit, here.arclength + length, turns, orbit.contacts)


def _tests(here: Station) -> list[tuple[str, Callable[[Orbit], float]]]:
    along = here.tangent
    doubling = BREAKING if here.orbit.section.mirror else DOUBLING
    return [
        (FOLD, lambda orbit: float(orbit.tangent(along)[4])),
        (doubling, half_plus),
        (NEIMARK, spiral),
    ]


def _locate(
    here: Station, there: Station, function: Callable[[Orbit], float]
) -> tuple[Orbit, float] | None:
    scale = here.orbit.section.scale
    chord = (there.orbit.point - here.orbit.point) / scale * SEEN
    status, orbit, length = bisect(here, float(chord @ here.tangent), function)
    return (orbit, length) if status is Status.DONE else None


def _parent(orbit: Orbit) -> tuple[str, Orbit] | None:
    """The symmetry breaking or period doubling that an orbit lies next to, if any.

    There the orbit's own map is singular in a way that its fold function resolves poorly; the map
    over half a cycle and the mirror, or over half the period, is not.
    """
    section = orbit.section
    if section.mirror:
        return None
    candidates = []
    if section.count % 2 == 0:
        half_period = Section(section.family, section.count // 2, False, section.scale)
        candidates.append((DOUBLING, half_period))
    elif section.family.symmetric:
        half_cycles = Section(section.family, section.count, True, section.scale)
        candidates.append((BREAKING, half_cycles))
    for kind, simpler in candidates:
        if is_fixed(simpler, orbit, _NEAR) and (found := _zero(simpler, orbit)) is not None:
            return kind, found
    return None


def _zero(section: Section, orbit: Orbit) -> Orbit | None:
    """The orbit of a simpler map near another one at which an eigenvalue is −1: by secants."""
    values = [orbit.value, orbit.value + 1e-6 * section.scale[4]]
    tests: list[float] = []
    point, mode = orbit.point.copy(), float(orbit.facts[section_map.MODE])
    for _ in range(20):
        point[section_map.PARAMETER] = values[len(tests)]
        status, found = corrected(section, point, mode)
        if status is not Status.DONE:
            return None
        point = found.point.copy()
        tests.append(half_plus(found))
        if len(tests) < 2:
            continue
        rise = tests[-1] - tests[-2]
        step = -tests[-1] * (values[-1] - values[-2]) / rise if rise else 0.0
        if abs(step) <= 1e-15 * abs(values[-1]):
            return found
        if abs(values[-1] + step - orbit.value) > 0.01 * section.scale[4]:
            return None
        values.append(values[-1] + step)
    return found


def is_fixed(section: Section, orbit: Orbit, tolerance: float) -> bool:
    """Whether an orbit is fixed under another map, to a scaled tolerance."""
    status, image, _ = evaluated(section, orbit.point, orbit.facts[section_map.MODE])
    return status is Status.DONE and bool(image.facts[section_map.RESIDUAL] <= tolerance)


def own_mirror(orbit: Orbit, tolerance: float) -> bool:
    """Whether an orbit is its own mirror image, half a period later."""
    section = orbit.section
    if not section.family.symmetric or section.count % 2 == 0:
        return False
    return is_fixed(Section(section.family, section.count, True, section.scale), orbit, tolerance)


def born(found: Bifurcation) -> Iterator[Station]:
    """Orbits on the branches that a symmetry breaking or a period doubling gives birth to.

    One station of each pair: the other is its mirror image, or itself a period later.
    """
    section = found.orbit.section
    if found.kind == BREAKING and section.mirror:
        target = section.full()
    elif found.kind == DOUBLING:
        target = section.times(2)
    else:
        return
    values, vectors = np.linalg.eig(found.orbit.columns.T)
    vector = np.real(vectors[:, np.argmin(np.abs(values + 1.0))]) / section.scale[:4]
    normal = np.append(vector, 0.0)
    normal /= np.linalg.norm(normal * SEEN)
    for distance in _OFF:
        point = found.orbit.point + distance * normal * section.scale
        status, orbit = corrected(target, point, found.orbit.facts[section_map.MODE], normal)
        if status is not Status.DONE:
            continue
        away = (orbit.point - found.orbit.point) / section.scale * SEEN
        # It must not have slid back to the orbit that was there before.
        if 0.3 * distance <= np.linalg.norm(away) <= 30.0 * distance:
            yield Station(orbit, orbit.tangent(normal), 0.0, 0)
            return


def with_critical(stations: list[Station], found: list[Bifurcation]) -> list[Station]:
    """A branch with the orbits of its bifurcations among the others, where they belong."""
    added = [
        Station(b.orbit, np.zeros(5), b.arclength, -1, critical=True)
        for b in found
        if b.kind != GRAZING
    ]
    merged = sorted([*stations, *added], key=lambda station: station.arclength)
    piece = stations[0].piece
    whole = []
    for station in merged:
        piece = piece if station.critical else station.piece
        whole.append(replace(station, piece=piece))
    return whole


def joined(backward: Trace, forward: Trace) -> list[Station]:
    """Both directions of a branch from one orbit as one list, in the sense of the second."""
    turned = [
        Station(s.orbit, -s.tangent, -s.arclength, -s.piece, s.grazing)
        for s in reversed(backward.stations)
    ]
    return turned[:-1] + forward.stations
