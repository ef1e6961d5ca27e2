"""Other rigs that fit as well: ends of other starts, and the mirror image of the rig.

A sine shakes a rig and its mirror image alike, half a period later, so that their excursions are
the same: such tests do not distinguish right from left.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vibroimpact.identification.global_search import Ended, local
from vibroimpact.identification.least_squares import Array, Problem
from vibroimpact.identification.robust_loss import moments

_MIRRORED = {"stops.right": "stops.left", "stops.left": "stops.right"}
_MOST = 3
"""Ends of other starts that are refined."""
_HOPELESS = 100.0
"""Rise of the deviance, over its limit, from which on an end is not refined."""
_EQUAL = 0.01
"""Difference of the deviance that counts as none."""
_APART = 0.05
"""Difference of a parameter, as a share of it, up to which two ends are one."""


class Rival(NamedTuple):
    """Another place that fits as well."""

    x: Array
    rise: float
    """Of the deviance, over that of the fit."""
    mirrored: bool
    """Whether it is the mirror image of the fit, or began there."""


def rivals(
    problem: Problem, x: Array, others: Sequence[Ended], limit: float
) -> tuple[Array, list[Rival]]:
    """Find what fits as well as a fit.

    Return the best place, which is the fit unless another one is better, and the others.

    Parameters
    ----------
    limit
        Rise of the deviance up to which a place fits as well.
    """
    factor = 2.0 * moments(problem.tail).deviance
    here = problem.cost(x)
    known = [(here, x)]
    for end in others[:_MOST]:
        if factor * (problem.cost(end.x) - here) < _HOPELESS * limit:
            refined = local(problem, end.x, precise=True)
            known.append((refined.cost, refined.x))
    known.sort(key=lambda one: one[0])
    least, best = known[0]
    if factor * (here - least) < _EQUAL:
        least, best = here, x
    candidates = []
    image = mirror_image(problem, best)
    if image is not None:
        rise = factor * (problem.cost(image) - least)
        if _EQUAL < rise < _HOPELESS * limit:
            refined = local(problem, image, precise=True)
            image, rise = refined.x, factor * (refined.cost - least)
        candidates.append(Rival(image, rise, mirrored=True))
    count = len(problem.free)
    for cost, place in known:
        if all(far(place, one, count) > _APART for one in (best, *(r.x for r in candidates))):
            candidates.append(Rival(place, factor * (cost - least), mirrored=False))
    return best, [one for one in candidates if one.rise < limit]


def mirror_image(problem: Problem, x: Array) -> Array | None:
    """What is free in the mirror image of a rig; None where the tests fix the sides, or it is x.

    Parameters of one side change places with those of the other if both are free and all their
    tests see both sides alike.
    """
    blind = {test.name for test in problem.tests if test.blind}
    names = {test.name for test in problem.tests}
    image = x.copy()
    scale = problem.scale
    column = {(one.name, one.test): number for number, one in enumerate(problem.free)}
    for (name, test), number in column.items():
        if not ({test} if test else names) <= blind:
            continue
        if name == "force":
            image[number] = -x[number]
        owner, _, field = name.rpartition(".")
        other = column.get((f"{_MIRRORED.get(owner, '')}.{field}", test))
        if other is not None:
            image[number] = x[other] * scale[other] / scale[number]
    image = np.clip(image, problem.low, problem.high)
    return None if np.allclose(image, x, rtol=1e-9, atol=1e-12) else image


def far(place: Array, other: Array, count: int) -> float:
    """Largest difference of the parameters of two places, as a share of the second's."""
    size = np.maximum(np.abs(other[:count]), 1e-3)
    return float(np.max(np.abs(place[:count] - other[:count]) / size))


def outside(values: Array, interval: Array) -> bool:
    """Whether any of some values lies outside its interval."""
    return bool(np.any((values < interval[:, 0]) | (values > interval[:, 1])))


def came_to(ends: Sequence[Array], x: Array, others: Sequence[Array], count: int) -> int:
    """How many ends of a search lie nearer to a fit than to what fits as well."""
    return sum(all(far(end, x, count) <= far(end, one, count) for one in others) for end in ends)
