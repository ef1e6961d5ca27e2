"""Pseudo-arclength steps along a curve of solutions in n unknowns.

From a point with unit tangent t a step of length h predicts y + h t and corrects on the plane
normal to t. It is taken if the tangent has hardly turned; the next one may then be longer, and is
shorter otherwise. What is solved, and where the curve ends, a `Path` says.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FIRST, LEAST, MOST = 0.01, 1e-9, 0.05
"""Length of the first step, of the least and of the largest one, in scaled components."""
AGAIN = 1e-3
"""Length of the first step behind a corner, or in other coordinates."""
_LARGE = 10.0
"""Distance from the first point beyond which the largest step grows in proportion to it."""
TURN = 0.97
"""Cosine of the largest turn of the tangent in a step."""
_GENTLE = 0.997  # below this turn the step may grow
_GROWN, _SHRUNK = 1.6, 0.25
_SHORT = 1e-4  # where so short a step fails there may be a corner
_SMOOTH = 1e-5  # below this length other coordinates are tried
_MISS = 0.4  # of a step, by which a solution may miss the prediction
_CREEP, _CREPT = 100, 0.01  # points without a corner that lie within this arclength lead nowhere


class Point(Protocol):
    """A solution on the curve."""

    @property
    def y(self) -> Array:
        """The n unknowns."""

    @property
    def tangent(self) -> Array:
        """Unit tangent in scaled components."""

    @property
    def arclength(self) -> float:
        """From the first point, in scaled components."""


P = TypeVar("P", bound=Point)


class Path(Protocol[P]):
    """What is followed: provide these, and everything else works."""

    @property
    def scale(self) -> Array:
        """Sizes of the unknowns."""

    @property
    def seen(self) -> Array:
        """Which scaled components lengths and angles are measured by: 1, or 0 for the others."""

    def step(self, here: P, length: float) -> tuple[P | None, bool]:
        """Predict and correct: the point, if it is usable; and whether a corner lies before it."""

    def corner(self, here: P, length: float) -> list[P]:
        """The points at, and just after, a corner within a step; none if there is none."""

    def in_other_coordinates(self, here: P) -> P | None:
        """The same solution in other coordinates, in which the curve may be smooth."""

    def end(self, here: P, there: P) -> tuple[list[P], str] | None:
        """The last points, and why, if the curve ends between here and there."""

    def lost(self, here: P) -> str:
        """Why nothing is found beyond a point."""


class Trace(NamedTuple, Generic[P]):
    """One direction of a curve."""

    points: list[P]
    ended: str
    """Why it was not followed further."""
    is_complete: bool = True
    """Whether it was followed until something ended it, not until its points were used up."""


def follow(
    path: Path[P],
    start: P,
    most_points: int,
    progress: Callable[[P], None] | None = None,
) -> Trace[P]:
    """Follow a curve from a point along its tangent.

    Parameters
    ----------
    most_points
        Points after which it is given up.
    """
    points = [start]
    here = start
    behind_corner = 0  # of the points, the first one behind the last corner
    length = FIRST
    while len(points) < most_points:
        there, corner = path.step(here, length)
        turn = 0.0 if there is None else float((there.tangent * path.seen) @ here.tangent)
        if there is not None and turn >= TURN:
            if (last := path.end(here, there)) is not None:
                return Trace([*points, *last[0]], last[1])
            points.append(there)
            here = there
            if progress:
                progress(here)
            followed = len(points) - behind_corner
            if followed > _CREEP and here.arclength - points[-_CREEP].arclength < _CREPT:
                return Trace(points, path.lost(here))
            if turn > _GENTLE:
                away = distance(path, here.y, start.y)
                length = min(_GROWN * length, MOST * max(1.0, away / _LARGE))
            continue
        if (corner or length <= _SHORT) and (behind := path.corner(here, length)):
            if (last := path.end(here, behind[0])) is not None:
                return Trace([*points, *last[0]], last[1])
            points += behind
            here = behind[-1]
            behind_corner = len(points) - 1
            length = AGAIN
            continue
        length *= _SHRUNK
        if length < _SMOOTH and (same := path.in_other_coordinates(here)) is not None:
            points.append(same)
            here = same
            length = AGAIN
            continue
        if length < LEAST:
            return Trace(points, path.lost(here))
    return Trace(points, f"{most_points} points were reached", is_complete=False)


def predicted(path: Path[P], here: P, length: float) -> Array:
    """Where a step along the tangent leads."""
    return here.y + length * here.tangent * path.scale


def is_other_curve(path: Path[P], solution: Array, aim: Array, length: float) -> bool:
    """Whether a solution is so far from the prediction that it lies on another curve."""
    return distance(path, solution, aim) > _MISS * length + 1e-9


def distance(path: Path[P], one: Array, other: Array) -> float:
    """Distance of two points in scaled components."""
    return _length((one - other) / path.scale * path.seen)


def _length(vector: Array) -> float:
    """As `np.linalg.norm`, which takes longer to be called."""
    return math.sqrt(vector @ vector)


def unit_tangent(jacobian: Array, along: Array, seen: Array) -> Array:
    """Unit tangent (by `seen`) where n − 1 equations in n unknowns hold, in the sense of `along`.

    Parameters
    ----------
    jacobian
        In scaled components, shape (n − 1, n).
    along
        A tangent nearby, or any direction that the tangent has a part in.
    seen
        See `Path.seen`.
    """
    matrix = np.empty((len(along), len(along)))
    matrix[:-1], matrix[-1] = jacobian, along * seen
    held: NDArray[Any] = np.zeros(len(along))
    held[-1] = 1.0
    try:
        tangent: Array = np.linalg.solve(matrix, held)
    except np.linalg.LinAlgError:
        last: Array = np.linalg.svd(jacobian)[2][-1]
        tangent = last if last @ (along * seen) >= 0.0 else -last
    return tangent / _length(tangent * seen)
