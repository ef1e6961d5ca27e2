"""Unstable manifolds of saddles: the images of a short piece beside the saddle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.attraction.adaptive_curve import Curve, Measure, broken, refined
from vibroimpact.attraction.label_states import Stage, images
from vibroimpact.attraction.saddles import Saddle
from vibroimpact.tasks.threads import Workers

_Array = NDArray[np.float64]

_SHORT = 1e-4
"""Of the window: the far end of the piece with which a curve begins; its own bend is its square."""
_ARRIVED = 0.02
"""Of the spacing: an image as short as this ends where it is."""


def unstable_curve(
    stage: Stage, saddle: Saddle, side: int, measure: Measure, workers: Workers
) -> Curve:
    """One side of a saddle's unstable curve, image by image.

    A point has the parameter k + s: the k-th image of that at the distance short · |λ|^(s − 1) from
    the saddle in the direction that grows.
    """
    twice = 2 if saddle.growing < 0.0 else 1
    factor = abs(saddle.growing) ** twice
    cycles = saddle.orbit.section.count * twice
    way = saddle.unstable / np.linalg.norm(measure.scaled(saddle.unstable)) * side

    def at(parameters: _Array) -> _Array:
        found = np.empty((len(parameters), 2))
        levels = np.floor(parameters).astype(int)
        for level in np.unique(levels):
            mine = levels == level
            begun = np.zeros((int(mine.sum()), 5))
            share = factor ** (parameters[mine] - level - 1.0)
            begun[:, :2] = saddle.point + _SHORT * share[:, None] * way
            went, known = images(stage, begun, cycles * int(level), workers)
            found[mine] = np.where(known[:, None], went[:, :2], np.nan)
        return found

    parts: list[_Array] = [saddle.point[None]]
    total = last = 0.0
    for level in range(measure.images):
        piece, ended = refined(at, float(level), float(level + 1), measure)
        length = measure.length(piece)
        total += length
        parts.append(piece[:-1])
        if ended:
            return Curve(broken(np.vstack(parts), measure), ended)
        if length < min(last, _ARRIVED * measure.spacing):
            return Curve(broken(np.vstack(parts), measure), "the curve ends at a steady motion")
        last = length
        if total > measure.longest:
            return Curve(broken(np.vstack(parts), measure), "the curve reaches the maximum length")
    return Curve(broken(np.vstack(parts), measure), "the requested number of images was computed")
