"""Where a branch meets that of the simpler motions which its own left.

Orbits of twice the period, or without the symmetry, are born in a period doubling or a symmetry
breaking. There their branch turns, and goes on as their images under the simpler map. At a grazing
of the simpler orbit, whose multiplier jumps past −1, the branch has a corner instead: it shrinks
onto the orbit that grazes, in proportion to the distance of the parameter.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.status import Status
from vibroimpact.stability.fixed_points import (
    VALUE,
    Orbit,
    corrected,
    evaluated,
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
        return float(np.linalg.det(orbit.carried + np.eye(len(orbit.carried))))


def is_of_simpler_map(orbit: Orbit) -> bool:
    """Whether an orbit has become one of a simpler map: its own mirror image, or half as long."""
    return orbit.missed is not None and orbit.missed[0] <= _SLID


def simplest(orbit: Orbit) -> Orbit:
    """An orbit as that of the simplest map whose fixed point it is."""
    while is_of_simpler_map(orbit) and (section := orbit.section.parent()) is not None:
        _, orbit, _ = evaluated(section, orbit.point, orbit.mode)
    return orbit


def parent(here: Orbit, there: Orbit) -> Orbit | None:
    """The simpler orbit that a branch goes through between two of its own, if any.

    On its two sides the orbits are each other's images under the simpler map, whose fixed point
    lies between an orbit and its image.
    """
    if here.missed is None or there.missed is None or here.missed[1] @ there.missed[1] >= 0.0:
        return None
    nearer = min(here, there, key=_miss)
    orbit = _zero(nearer, half_plus)
    if orbit is None:
        return None
    # From afar the images may have changed sides elsewhere.
    step = np.linalg.norm(here.section.scaled(there.point - here.point))
    away = np.linalg.norm(here.section.scaled(orbit.point - nearer.point))
    return orbit if away <= step else None


def shrinks_onto(last: Orbit) -> Orbit | None:
    """The simpler orbit in whose grazing the branch of an orbit ends, if it does."""
    grazing = None if last.missed is None else _zero(last, margin_of)
    if grazing is None:
        return None
    here = last
    for _ in range(_HALVINGS):
        middle = 0.5 * (here.point + grazing.point)
        status, nearer = corrected(here.section, middle, here.mode)
        if status is not Status.DONE or nearer.missed is None:
            return None
        if not _SHRINKS[0] <= _miss(nearer) / _miss(here) <= _SHRINKS[1]:
            return None
        here = nearer
    return grazing


def _miss(orbit: Orbit) -> float:
    """Distance of an orbit from its image under the simpler map, scaled."""
    return math.inf if orbit.missed is None else float(np.linalg.norm(orbit.missed[1]))


def _zero(near: Orbit, test: Callable[[Orbit], float]) -> Orbit | None:
    """The orbit of the simpler map near another at which a test function is zero: by secants."""
    section = near.section.parent()
    if section is None or near.missed is None:
        return None
    guess = near.point + 0.5 * near.missed[1] * section.scale
    mode = near.mode
    first = float(guess[VALUE])
    values = [first, first + 1e-6 * section.scale[VALUE]]
    tests: list[float] = []
    point = guess.copy()
    for _ in range(30):
        point[VALUE] = values[len(tests)]
        status, orbit = corrected(section, point, mode)
        if status is not Status.DONE:
            return None
        point = orbit.point.copy()
        tests.append(test(orbit))
        if len(tests) < 2:
            continue
        rise = tests[-1] - tests[-2]
        step = -tests[-1] * (values[-1] - values[-2]) / rise if rise else 0.0
        if abs(step) <= 1e-15 * abs(values[-1]):
            return orbit
        if abs(values[-1] + step - first) > _REACH * section.scale[VALUE]:
            return None
        values.append(values[-1] + step)
    return orbit
