"""Points along a curve of the plane, no farther apart than required."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]

_FINEST = 1e-11
"""Of the parameter: two points as close as this are neighbours however far they are apart."""
LONGEST = "the curve reaches the maximum length"
CYCLES = "the curve used its share of the forcing cycles"
IMAGES = "the curve grows too slowly to be continued further"
LOST = "the computation of a state on the curve was given up"
CONTINUES = (LONGEST, CYCLES, IMAGES)
"""Reasons for an end beyond which the curve continues."""
_BOW = 0.02
"""Of the spacing: how far a line between two neighbours may lie beside the curve. Tight spirals,
which wind up to a motion with turns that are not much longer than the spacing, stay round."""


class Curve(NamedTuple):
    """Points of a curve in their order, and why it ends."""

    points: _Array
    ended: str


class CurveMetric(NamedTuple):
    """How curves are measured: lengths are in windows, whose sides count 1 each."""

    low: _Array
    high: _Array
    """Corners of the window."""
    spacing: float
    """Largest distance of two neighbours within it."""
    longest: float
    images: int
    cycles: int
    """Forcing cycles that may be simulated for one curve."""

    def scaled(self, difference: NDArray[np.floating[Any]]) -> _Array:
        """A difference of points over the window's sides."""
        return difference / (self.high - self.low)

    def length(self, points: _Array) -> float:
        """Of the line through points."""
        return float(np.linalg.norm(self.scaled(np.diff(points, axis=0)), axis=1).sum())

    def within(self, points: _Array, room: float) -> NDArray[np.bool_]:
        """Which points lie in the window with room on each side."""
        wide = room * (self.high - self.low)
        inside: NDArray[np.bool_] = np.all(
            (points >= self.low - wide) & (points <= self.high + wide), axis=1
        )
        return inside


def broken(points: _Array, measure: CurveMetric) -> _Array:
    """The points with a row of NaN between neighbours that are farther apart than they may be.

    So it is at a rigid stop: a state about to strike it is one with the state that has struck it.
    """
    gaps = np.linalg.norm(measure.scaled(np.diff(points, axis=0)), axis=1)
    return np.insert(points, np.flatnonzero(gaps > 1.01 * measure.spacing) + 1, np.nan, 0)


class Allowance:
    """Forcing cycles that may still be simulated for a curve."""

    def __init__(self, measure: CurveMetric) -> None:
        self.all, self.used = measure.cycles, 0

    def use(self, cycles: int) -> None:
        """Count cycles that are simulated."""
        self.used += cycles

    @property
    def spent(self) -> bool:
        """Whether nothing is left."""
        return self.used >= self.all


def refined(
    at: Callable[[_Array], _Array],
    begin: float,
    end: float,
    measure: CurveMetric,
    longest: float,
    allowance: Allowance,
) -> tuple[_Array, str]:
    """Points between two parameters, neighbours in the window closer than its spacing.

    Where the curve turns, they are as close as the line through them requires. Only the part up to
    the length `longest` is refined, so that the number of points does not grow with the stretching
    of the map.

    Returns
    -------
    points, ended
        The part up to where the curve ends, and the reason; "" if it is complete.
    """
    parameters = np.linspace(begin, end, 17)
    points = at(parameters)
    while True:
        steps = measure.scaled(np.diff(points, axis=0))
        gaps = np.linalg.norm(steps, axis=1)
        seen = measure.within(points, 0.5)
        wide = ~(gaps <= measure.spacing) | (_bows(steps, gaps) > _BOW * measure.spacing)
        wide &= seen[1:] | seen[:-1]
        wide &= np.diff(parameters) > _FINEST * max(end, 1.0)
        lost = np.flatnonzero(np.isnan(points).any(axis=1))
        wide[lost[0] if len(lost) else len(wide) :] = False
        # A line through few points is shorter than the curve: what lies beyond it does so finally.
        lengths = np.cumsum(np.nan_to_num(gaps))
        wide[1:] &= lengths[:-1] <= longest
        if not wide.any():
            break
        if allowance.spent:
            return points[: int(wide.argmax()) + 1], CYCLES
        middle = 0.5 * (parameters[1:] + parameters[:-1])[wide]
        parameters = np.concatenate([parameters, middle])
        points = np.vstack([points, at(middle)])
        order = np.argsort(parameters, kind="stable")
        parameters, points = parameters[order], points[order]
    beyond = np.flatnonzero(lengths > longest)
    if len(beyond) and not (len(lost) and lost[0] <= beyond[0] + 1):
        return points[: beyond[0] + 2], LONGEST
    if len(lost):
        return points[: lost[0]], LOST
    return points, ""


def _bows(steps: _Array, gaps: _Array) -> _Array:
    """How far the curve bows out beside each step, from the angles to the steps next to it."""
    ahead, behind = steps[1:], steps[:-1]
    cross = behind[:, 0] * ahead[:, 1] - behind[:, 1] * ahead[:, 0]
    angles = np.abs(np.arctan2(cross, (behind * ahead).sum(axis=1)))
    padded = np.concatenate([[0.0], np.nan_to_num(angles), [0.0]])
    bows: _Array = gaps * np.maximum(padded[1:], padded[:-1]) / 8.0
    return bows
