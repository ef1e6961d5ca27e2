"""Motions matched from one value of a parameter to the next, so that each keeps its number.

A motion goes on as the one that its states lead to at the next value, if that is near it; where
two lead to the same, the nearer one goes on (the continuation of Attractors.jl, G. Datseris,
K. L. Rossi and A. Wagemakers, Chaos 33, 073151, 2023).
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

_Array = NDArray[np.float64]

NEAR = 0.3
"""Of the window: motions whose points are farther apart are not one that has moved."""


def point_distance(one: _Array, other: _Array) -> float:
    """The larger of the mean distances of the points of either set from the other."""
    there, _ = scipy.spatial.KDTree(other).query(one)
    back, _ = scipy.spatial.KDTree(one).query(other)
    return float(max(there.mean(), back.mean()))


def matched(
    before: dict[int, _Array], here: list[_Array], leads: dict[int, int], first_free: int
) -> list[int]:
    """Numbers of the motions at a value.

    Parameters
    ----------
    before
        Points of the motions at the value before by their numbers, over the window's sides.
    here
        Points of the motions at this value.
    leads
        Which of these the states of those lead to.
    first_free
        The first number that no motion has had.
    """
    pairs = sorted(
        (distance, number, now)
        for number, now in leads.items()
        if (distance := point_distance(before[number], here[now])) <= NEAR
    )
    number_of: dict[int, int] = {}
    for _, number, now in pairs:
        number_of.setdefault(now, number)
    numbers = []
    for now in range(len(here)):
        if now not in number_of:
            number_of[now] = first_free
            first_free += 1
        numbers.append(number_of[now])
    return numbers
