"""Stable manifolds of saddles: what the map takes to a short piece beside the saddle.

The map forgets, and so cannot be followed back in time; each point is that whose image is the point
before it, by Newton's method with the map's derivative, begun at its neighbour on the curve. Where
that derivative grows without bound, at the grazing of a rigid stop, the curve ends.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from vibroimpact.attraction.adaptive_curve import (
    CYCLES,
    IMAGES,
    LONGEST,
    Allowance,
    Curve,
    CurveMetric,
)
from vibroimpact.attraction.label_states import SectionSetup
from vibroimpact.attraction.saddles import Saddle
from vibroimpact.attraction.section_coordinates import met
from vibroimpact.engine.status import Status
from vibroimpact.stability.fixed_points import Section, evaluated
from vibroimpact.tasks.threads import stop_if_unwanted

_Array = NDArray[np.float64]

_SHORT = 1e-4
"""Of the window: the far end of the piece with which a curve begins."""
_FIRST = 9
"""Points of it."""
_ROOM = 1.0
"""Windows beside the window in which a curve is still followed."""
_STEPS = 12
_EXACT = 1e-12
"""Of the window: how well an image is met."""
_FINEST = 1e-9
"""Of the parameter: where neighbours as close as this do not meet, the curve ends."""


def stable_curve(
    saddle: Saddle, side: int, measure: CurveMetric, tell: Callable[[float], None]
) -> Curve:
    """One side of a saddle's stable curve, preimage by preimage.

    A point has the parameter s in [0, 1] and the level k: its k-th image lies at the distance
    short · |λ|^(1 − s) from the saddle in the direction that dies out. `tell` is called with the
    share of the work that is done at least.
    """
    twice = 2 if saddle.dying < 0.0 else 1
    section = saddle.orbit.section.with_map(saddle.orbit.section.count * twice, mirror=False)
    chains = _Chains(saddle, section, side, measure, abs(saddle.dying) ** twice, tell)
    parts = [saddle.point[None], chains.level(0)]
    total = measure.length(parts[1])
    for level in range(1, measure.images + 1):
        ended = chains.extend(level, total)
        points = chains.level(level)
        parts.append(points[1:])
        total += measure.length(points)
        if ended:
            return Curve(np.vstack(parts), ended)
    return Curve(np.vstack(parts), IMAGES)


class _Chains:
    """Points of the first piece, each with its preimages."""

    def __init__(
        self,
        saddle: Saddle,
        section: Section,
        side: int,
        measure: CurveMetric,
        factor: float,
        tell: Callable[[float], None],
    ) -> None:
        self.section, self.measure, self.factor = section, measure, factor
        self.allowance, self.tell = Allowance(measure), tell
        self.value = saddle.orbit.value
        along = section.family
        # Where an image presses such a stop it has more to it than the plane of its preimages.
        self.hidden = met(SectionSetup(along.rig), np.ones(5))
        self.origin = saddle.point
        self.way = side * saddle.stable / np.linalg.norm(measure.scaled(saddle.stable))
        self.parameters = list(np.linspace(0.0, 1.0, _FIRST))
        self.chains = [[self._first(s)] for s in self.parameters]

    def level(self, number: int) -> _Array:
        """The points that have so many preimages before them."""
        return np.array([chain[number] for chain in self.chains if len(chain) > number])

    def extend(self, level: int, total: float) -> str:
        """Find the preimages of the last level, in order; why they end, or "".

        `total` is the length of the curve up to there.
        """
        # The piece goes on where the last one ended.
        self.chains[0].append(self.chains[-1][level - 1])
        i = 1
        while i < len(self.chains):
            self.tell(max(total / self.measure.longest, self.allowance.used / self.allowance.all))
            if self.allowance.spent:
                self._truncate(i)
                return CYCLES
            before, here = self.chains[i - 1], self.chains[i]
            preimage = self._preimage(here[level - 1], before[level], before[level - 1])
            gap = 0.0
            if preimage is not None:
                gap = float(np.linalg.norm(self.measure.scaled(preimage - before[level])))
            if preimage is None or gap > self.measure.spacing:
                if not self._insert(i, level):
                    self._truncate(i)
                    return (
                        "the curve cannot be continued, because the stroboscopic map has a corner "
                        "or an edge there"
                    )
                continue
            here.append(preimage)
            total += gap
            if not self.measure.within(preimage[None], _ROOM)[0]:
                self._truncate(i + 1)
                return "the curve runs too far out of the window"
            if total > self.measure.longest:
                self._truncate(i + 1)
                return LONGEST
            i += 1
        return ""

    def _first(self, parameter: float) -> _Array:
        point: _Array = self.origin + _SHORT * self.factor ** (1.0 - parameter) * self.way
        return point

    def _insert(self, i: int, level: int) -> bool:
        """Put a point between two, with its preimages below the level."""
        one, other = self.parameters[i - 1], self.parameters[i]
        if other - one < _FINEST:
            return False
        middle = 0.5 * (one + other)
        chain = [self._first(middle)]
        for k in range(1, level):
            a, b = self.chains[i - 1], self.chains[i]
            guess = 0.5 * (a[k] + b[k])
            preimage = self._solve(chain[-1], guess)
            if preimage is None:
                preimage = self._preimage(chain[-1], a[k], a[k - 1])
            if preimage is None:
                return False
            chain.append(preimage)
        self.parameters.insert(i, middle)
        self.chains.insert(i, chain)
        return True

    def _truncate(self, i: int) -> None:
        del self.parameters[i:], self.chains[i:]

    def _preimage(self, image: _Array, near: _Array, its_image: _Array) -> _Array | None:
        """The point with an image, from a point nearby with its image."""
        mapped = self._map(near)
        if mapped is None:
            return None
        try:
            step = np.linalg.solve(mapped[1], image - its_image)
        except np.linalg.LinAlgError:
            return None
        length = float(np.linalg.norm(self.measure.scaled(step)))
        # A long step is found out by halving the way.
        return None if length > 4.0 * self.measure.spacing else self._solve(image, near + step)

    def _solve(self, image: _Array, guess: _Array) -> _Array | None:
        """Newton's method for the point whose image is given."""
        point, best, best_point = guess, np.inf, None
        for _ in range(_STEPS):
            mapped = self._map(point)
            if mapped is None:
                return None
            miss = mapped[0] - image
            size = float(np.abs(self.measure.scaled(miss)).max())
            if size < best:
                best, best_point = size, point
            if size <= _EXACT:
                return point
            try:
                step = np.linalg.solve(mapped[1], miss)
            except np.linalg.LinAlgError:
                return None
            length = float(np.linalg.norm(self.measure.scaled(step)))
            if length > 1.0:
                return None
            point = point - step
        # Where the map shrinks a lot, rounding of the image lets it come no closer.
        return best_point if best <= 1e3 * _EXACT else None

    def _map(self, point: _Array) -> tuple[_Array, _Array] | None:
        """Image and derivative; None if a limit is met, or the image lies beside the plane."""
        begun = np.array([point[0], point[1], 0.0, 0.0, 0.0, self.value])
        stop_if_unwanted()
        self.allowance.use(self.section.count)
        status, here, image = evaluated(self.section, begun, 0.0)
        if status is not Status.DONE or image[:5][self.hidden].any():
            return None
        return image[:2], here.map_derivative[:2, :2]
