"""Where a branch meets that of the simpler motions which its own left.

Orbits of twice the period, or without the symmetry, are born in a period doubling or a symmetry
breaking. There their branch turns, and goes on as their images under the simpler map.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import section_map
from vibroimpact.engine.status import Status
from vibroimpact.stability.fixed_points import SEEN, Orbit, Section, corrected, evaluated, is_fixed

_Array = NDArray[np.float64]

_SLID = 1e-7
_REACH = 0.02
"""Of the parameter's range, within which the parent of a branch is sought."""


def half_plus(orbit: Orbit) -> float:
    """det(M + I) of an orbit's map: zero where an eigenvalue is −1."""
    with np.errstate(all="ignore"):  # far from any orbit it may overflow
        return float(np.linalg.det(orbit.carried + np.eye(4)))


def slid(found: Orbit) -> bool:
    """Whether an orbit has become one of a simpler map: its own mirror image, or half as long."""
    simpler = found.section.parent()
    return simpler is not None and is_fixed(simpler, found, _SLID)


def parent(here: Orbit, there: Orbit) -> Orbit | None:
    """The simpler orbit that a branch goes through between two of its own, if any.

    On its two sides the orbits are each other's images under the simpler map, whose fixed point
    lies between an orbit and its image.
    """
    section = here.section
    simpler = section.parent()
    if simpler is None:
        return None
    misses = []
    for orbit in (here, there):
        status, other, image = evaluated(simpler, orbit.point, orbit.facts[section_map.MODE])
        if status is not Status.DONE:
            return None
        misses.append((image - other.point) / section.scale * SEEN)
    if misses[0] @ misses[1] >= 0.0:
        return None
    nearer, miss = min(
        zip((here, there), misses, strict=True), key=lambda pair: float(np.linalg.norm(pair[1]))
    )
    guess = nearer.point + 0.5 * miss * section.scale
    return _zero(simpler, guess, float(nearer.facts[section_map.MODE]))


def _zero(section: Section, guess: _Array, mode: float) -> Orbit | None:
    """The orbit of a map near a point at which an eigenvalue is −1: by secants."""
    first = float(guess[section_map.PARAMETER])
    values = [first, first + 1e-6 * section.scale[4]]
    tests: list[float] = []
    point = guess.copy()
    for _ in range(30):
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
        if abs(values[-1] + step - first) > _REACH * section.scale[4]:
            return None
        values.append(values[-1] + step)
    return found
