"""Where a branch meets that of the simpler motions which its own left.

Orbits of twice the period, or without the symmetry, are born in a period doubling or a symmetry
breaking. There their branch turns, and goes on as their images under the simpler map. At a grazing
of the simpler orbit, whose multiplier jumps past −1, the branch has a corner instead: it shrinks
onto the orbit that grazes, in proportion to the distance of the parameter.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import section_map
from vibroimpact.engine.status import Status
from vibroimpact.stability.fixed_points import (
    SEEN,
    Orbit,
    Section,
    corrected,
    evaluated,
    is_fixed,
    margin_of,
)

_Array = NDArray[np.float64]

_SLID = 1e-7
_REACH = 0.02
"""Of the parameter's range, within which the parent of a branch is sought."""
_HALVINGS = 8
"""Of the distance from a grazing, by which a branch must shrink onto the orbit that grazes."""
_SHRINKS = (0.2, 0.8)
"""How much of its distance a branch may keep in one of them."""


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
    first, second = _miss(simpler, here), _miss(simpler, there)
    if first is None or second is None or first @ second >= 0.0:
        return None
    nearer, miss = min(
        ((here, first), (there, second)), key=lambda pair: float(np.linalg.norm(pair[1]))
    )
    return _zero(simpler, nearer, miss, half_plus)


def shrinks_onto(last: Orbit) -> Orbit | None:
    """The simpler orbit in whose grazing the branch of an orbit ends, if it does."""
    simpler = last.section.parent()
    miss = None if simpler is None else _miss(simpler, last)
    if simpler is None or miss is None:
        return None
    grazing = _zero(simpler, last, miss, margin_of)
    if grazing is None:
        return None
    here = last
    for _ in range(_HALVINGS):
        middle = 0.5 * (here.point + grazing.point)
        status, nearer = corrected(here.section, middle, here.facts[section_map.MODE])
        now = _miss(simpler, nearer) if status is Status.DONE else None
        if now is None:
            return None
        share = float(np.linalg.norm(now) / np.linalg.norm(miss))
        if not _SHRINKS[0] <= share <= _SHRINKS[1]:
            return None
        here, miss = nearer, now
    return grazing


def _miss(simpler: Section, orbit: Orbit) -> _Array | None:
    """From an orbit to its image under a simpler map, scaled."""
    status, other, image = evaluated(simpler, orbit.point, orbit.facts[section_map.MODE])
    if status is not Status.DONE:
        return None
    miss: _Array = (image - other.point) / simpler.scale * SEEN
    return miss


def _zero(
    section: Section, near: Orbit, miss: _Array, test: Callable[[Orbit], float]
) -> Orbit | None:
    """The orbit of a simpler map near another at which a test function is zero: by secants."""
    guess = near.point + 0.5 * miss * section.scale
    mode = float(near.facts[section_map.MODE])
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
        tests.append(test(found))
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
