"""The defining system of a curve of bifurcations, and Newton's method for it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.status import Status
from vibroimpact.stability.bifurcations import FOLD, GRAZING, NEIMARK, nearest_pair
from vibroimpact.stability.fixed_points import Orbit, Section, evaluated, margin_of
from vibroimpact.stability.parent_branches import half_plus
from vibroimpact.stability.two_parameters import ParameterPlane

_Array = NDArray[np.float64]

_FAR = 1e3  # scaled; Newton's method has lost its way
_STEEP, _WORST = 1e20, 1e100
"""Of the map's derivative and of the residual, above which no step leads back; so far the
determinant, its differences and their squares are numbers."""
_STEP = 1e-7
_NEWTON = 12
_GOOD = 1e-11
_ACCEPTED = 5e-9


class Spot(NamedTuple):
    """A point on a curve."""

    y: _Array
    """z, p, q."""
    orbit: Orbit
    residual: _Array
    """Of the defining system in scaled components, shape (part + 1,)."""
    jacobian: _Array
    """Of the defining system in scaled components, shape (part + 1, part + 2)."""


class Defining(NamedTuple):
    """The defining system of one curve."""

    plane: ParameterPlane
    kind: str
    cycles: int
    mirror: bool
    mode: float
    scale: _Array
    """Of z, p, q."""

    def section(self, q: float) -> Section:
        """The section's map at a value of q."""
        return Section(self.plane.at_vectors(q), self.cycles, self.mirror, self.scale[:-1])

    @property
    def seen(self) -> _Array:
        """Components of (z, p, q) by which lengths and angles are measured, as in `Section`."""
        mask = np.ones(len(self.scale))
        mask[2 * self.plane.family.layout.masses : -2] = 0.0
        return mask

    def value(self, y: _Array) -> tuple[Orbit, _Array] | None:
        """The orbit that y stands for, and the residual in scaled components."""
        if not (np.isfinite(y).all() and np.abs(y[:-2] / self.scale[:-2]).max() < _FAR):
            return None
        section = self.section(y[-1])
        status, orbit, image = evaluated(section, y[:-1], self.mode)
        if status is not Status.DONE or not np.abs(orbit.carried).max() < _STEEP:
            return None
        missed = (image[:-1] - orbit.point[:-1]) / self.scale[:-2]
        residual = np.append(missed, self.test(orbit))
        return (orbit, residual) if np.abs(residual).max() < _WORST else None

    def test(self, orbit: Orbit) -> float:
        """The condition φ."""
        if self.kind == FOLD:
            return float(np.linalg.det(orbit.carried - np.eye(len(orbit.carried))))
        if self.kind == NEIMARK:
            return nearest_pair(orbit)
        if self.kind == GRAZING:
            return margin_of(orbit)
        return half_plus(orbit)

    def spot(self, y: _Array) -> Spot | None:
        """A point with the derivative of the system there."""
        here = self.value(y)
        if here is None:
            return None
        orbit, residual = here
        jacobian = np.empty((len(y) - 1, len(y)))
        jacobian[:-1, :-1] = orbit.jacobian
        for j in range(len(y)):
            for step in (_STEP, -_STEP):
                beside = y.copy()
                beside[j] += step * self.scale[j]
                there = self.value(beside)
                if there is None:
                    return None
                change = (there[1] - residual) / step
                jacobian[-1, j] = change[-1]
                if j == len(y) - 1:
                    jacobian[:-1, j] = change[:-1]
                # The margin has a kink at grazing: its slope is that on the side of `here`.
                if self.kind != GRAZING or there[1][-1] * residual[-1] > 0.0:
                    break
        return Spot(y, orbit, residual, jacobian)


def solve(system: Defining, y: _Array, normal: _Array) -> Spot | None:
    """Newton's method on the plane through y normal to `normal`.

    Where differences across a kink steer it to and fro, the best that it came by is taken.
    """
    y, aim, plane = y.copy(), y.copy(), normal * system.seen
    best, spot = np.inf, None
    for _ in range(_NEWTON):
        now = system.spot(y)
        if now is None:
            return None
        size = float(np.abs(now.residual).max())
        if size < best or spot is None:
            best, spot = size, now
        if best <= _GOOD:
            return spot
        across = now.jacobian[-1] * system.seen
        across = across - (across @ plane) / (plane @ plane) * plane
        if system.kind == GRAZING and now.residual[-1] < 0.0 < across @ across:
            # Behind the grazing of a rigid stop P is a square root: go on from the clear side.
            y = y - 2.0 * now.residual[-1] * across / (across @ across) * system.scale
            continue
        matrix = np.vstack([now.jacobian, plane])
        right = np.append(-now.residual, -plane @ ((y - aim) / system.scale))
        try:
            change = np.linalg.solve(matrix, right)
        except np.linalg.LinAlgError:
            return None
        longest = np.abs(change).max()
        if not longest < np.inf:
            return None
        y = y + min(1.0, 0.3 / max(longest, 1e-300)) * change * system.scale
    return spot if best <= _ACCEPTED else None
