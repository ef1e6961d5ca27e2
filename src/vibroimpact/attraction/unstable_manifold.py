"""Unstable manifolds of saddles: the images of a short piece beside the saddle."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from vibroimpact.attraction.adaptive_curve import (
    IMAGES,
    Allowance,
    Curve,
    CurveMetric,
    broken,
    refined,
)
from vibroimpact.attraction.label_states import SectionSetup, images
from vibroimpact.attraction.saddles import Saddle
from vibroimpact.tasks.threads import Workers

_Array = NDArray[np.float64]

_SHORT = 1e-4
"""Of the window: the far end of the piece with which a curve begins; its own bend is its square."""
_ARRIVED = 0.02
"""Of the spacing: an image as short as this ends where it is."""


def unstable_curve(
    stage: SectionSetup,
    saddle: Saddle,
    side: int,
    measure: CurveMetric,
    workers: Workers,
    tell: Callable[[float], None],
) -> Curve:
    """One side of a saddle's unstable curve, image by image.

    A point has the parameter k + s: the k-th image of that at the distance short · |λ|^(s − 1) from
    the saddle in the direction that grows. `tell` is called with the share of the work that is done
    at least.
    """
    allowance = Allowance(measure)
    piece = _Images(stage, saddle, side, measure, workers, allowance)
    parts: list[_Array] = [saddle.point[None]]
    total = last = 0.0
    ended = ""
    for level in range(measure.images):
        if level:
            piece.advance()
        points, ended = refined(
            piece.at, float(level), float(level + 1), measure, measure.longest - total, allowance
        )
        length = measure.length(points)
        total += length
        parts.append(points if ended else points[:-1])
        if not ended and length < min(last, _ARRIVED * measure.spacing):
            ended = "the curve ends at a steady motion"
        if ended:
            break
        last = length
        tell(max(total / measure.longest, allowance.used / allowance.all))
    return Curve(broken(np.vstack(parts), measure), ended or IMAGES)


class _Images:
    """Images of the first piece. Those of one level are kept: they lead to the next level."""

    def __init__(
        self,
        stage: SectionSetup,
        saddle: Saddle,
        side: int,
        measure: CurveMetric,
        workers: Workers,
        allowance: Allowance,
    ) -> None:
        twice = 2 if saddle.growing < 0.0 else 1
        self.stage, self.workers, self.allowance = stage, workers, allowance
        self.origin, self.factor = saddle.point, abs(saddle.growing) ** twice
        self.cycles = saddle.orbit.section.count * twice
        self.way = saddle.unstable / np.linalg.norm(measure.scaled(saddle.unstable)) * side
        self.level = 0
        self.before: dict[float, _Array] = {}
        self.here: dict[float, _Array] = {}

    def advance(self) -> None:
        """Go on to the next level."""
        self.level, self.before, self.here = self.level + 1, self.here, {}

    def at(self, parameters: _Array) -> _Array:
        """Displacement and velocity of points of this level; NaN if they were given up."""
        shares = parameters - self.level
        within = shares < 1.0
        points = np.empty((len(parameters), 2))
        points[within] = self._states(shares[within])[:, :2]
        if not within.all():  # where the next level begins
            points[~within] = self._mapped(self.here[0.0][None], 1)[:, :2]
        return points

    def _states(self, shares: _Array) -> _Array:
        states = np.empty((len(shares), 5))
        known = np.array([share in self.before for share in shares], dtype=bool)
        if known.any():
            states[known] = self._mapped(np.array([self.before[s] for s in shares[known]]), 1)
        if not known.all():
            states[~known] = self._mapped(self._seeds(shares[~known]), self.level)
        self.here.update(zip(shares.tolist(), states, strict=True))
        return states

    def _seeds(self, shares: _Array) -> _Array:
        begun = np.zeros((len(shares), 5))
        away = _SHORT * self.factor ** (shares - 1.0)
        begun[:, :2] = self.origin + away[:, None] * self.way
        return begun

    def _mapped(self, states: _Array, times: int) -> _Array:
        end_states = states.copy()
        mapped = ~np.isnan(states).any(axis=1)
        if times and mapped.any():
            went, known = images(self.stage, states[mapped], self.cycles * times, self.workers)
            end_states[mapped] = np.where(known[:, None], went, np.nan)
            self.allowance.use(self.cycles * times * int(mapped.sum()))
        return end_states
