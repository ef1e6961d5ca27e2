"""Peaks of a pair of resonance curves: the primary resonance and the secondary ones."""

from __future__ import annotations

from itertools import takewhile
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from vibroimpact.response.curve_pair import Array, Direction, Swept

PROMINENCE = 0.02
"""Least prominence of a peak, as a share of its height.

Smaller ripples would be lost in any measurement, and unsettled motions make them by chance.
"""

PRIMARY_HEIGHT = 0.5
"""Least height of the primary resonance, as a share of the curve's maximum."""

Curve: TypeAlias = Literal["eta_a", "eta_d"]

CURVES: tuple[Curve, ...] = ("eta_a", "eta_d")


class Peak(NamedTuple):
    """A local maximum of one curve, or its end where the curve is highest."""

    direction: Direction
    curve: Curve
    frequency: float
    """In Hz, one of those held."""
    value: float
    prominence: float
    """Height above the higher one of the valleys that part it from higher ground."""
    primary: bool
    """The primary resonance: the peak at the highest frequency that has at least
    `PRIMARY_HEIGHT` of the curve's maximum and a period of one forcing cycle. A secondary
    resonance of the backward sweep can be higher than what is left of the primary one, but
    it lies below it."""
    at_end: bool
    """The curve still rises at the end of the range: the resonance lies beyond it."""


def peaks(both: Swept, *, prominence: float = PROMINENCE) -> tuple[Peak, ...]:
    """Find the maxima of η_a and η_d of each direction, by frequency.

    The highest point of each curve is always among them. For `prominence`, see `PROMINENCE`.
    """
    maxima: list[Peak] = []
    for k, direction in enumerate(both.directions):
        for name in CURVES:
            curve: Array = getattr(both, name)[k]
            known = np.isfinite(curve).nonzero()[0]
            if not len(known):
                continue
            y = curve[known]
            top = int(y.argmax())
            above = _prominences(y, top)
            places = [i for i, height in above.items() if i == top or height > prominence * y[i]]
            high = [i for i in places if y[i] >= PRIMARY_HEIGHT * y[top]]
            primary = max((i for i in high if both.period[k, known[i]] <= 1), default=top)
            maxima += [
                Peak(
                    direction,
                    name,
                    float(both.frequency[known[i]]),
                    float(y[i]),
                    above[i],
                    i == primary,
                    i in (0, len(y) - 1),
                )
                for i in places
            ]
    return tuple(maxima)


def _prominences(y: Array, top: int) -> dict[int, float]:
    """Of the highest point and of each local maximum within; of a plateau, its first point's.

    Only where the curve turns can a valley or what parts it from higher ground be.
    """
    steps = y[1:] - y[:-1]
    change = steps.nonzero()[0]
    rises = steps[change] > 0.0
    turns = change[:-1][rises[:-1] != rises[1:]] + 1
    end = len(y) - 1
    places = sorted({0, top, end, *turns.tolist()})
    heights = y[places].tolist()
    return {
        i: _prominence(heights, n)
        for n, i in enumerate(places)
        if i == top or (0 < i < end and heights[n - 1] < heights[n] > heights[n + 1])
    }


def _prominence(heights: list[float], n: int) -> float:
    """Of one height above the higher one of the valleys beside it; an end has one valley."""
    height, valleys = heights[n], []
    for side in (heights[n::-1], heights[n:]):
        stretch = list(takewhile(height.__ge__, side))  # up to what is higher
        if len(stretch) > 1:
            valleys.append(min(stretch))
    return height - max(valleys, default=height)
