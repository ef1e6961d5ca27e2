"""When two motions are one: up to whole cycles, and for those that wander by what they visit."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import lyapunov
from vibroimpact.engine.status import Status
from vibroimpact.stability.settled_motion import Settled, reach, state_distance

SAME = 1e-6
"""Two orbits are one if their points agree to this share of their size."""
ALIKE = 0.1
"""Two motions that did not settle are one if the distributions of their displacements at the
section differ nowhere by more than this (the Kolmogorov–Smirnov distance)."""

_SEEN = 5000
"""Cycles over which motions that did not settle are compared."""


def image_of(motion: Settled, max_events: int) -> Settled | None:
    """The mirror image, half a cycle later; None if there is none, or a limit is met on the way."""
    status, state = motion.engine.propagate(motion.state, 0.5, max_events)
    image = motion.states.mirror_image(state) if status is Status.DONE else None
    return None if image is None else motion._replace(state=image)


def mirrors(one: Settled, other: Settled, max_events: int) -> bool:
    """Whether a motion is the mirror image of another."""
    image = image_of(other, max_events)
    return image is not None and same(one, image, max_events)


def same(one: Settled, other: Settled, max_events: int) -> bool:
    """Whether two motions are one, up to whole cycles."""
    if one.period:
        size = reach(one, one.state)
        state = other.state
        for _ in range(one.period):
            if state_distance(one, one.state, state, size) <= SAME:
                return True
            status, state = one.engine.propagate(state, 1.0, max_events)
            if status is not Status.DONE:
                return False
        return False
    mine, others = _displacements(one, max_events), _displacements(other, max_events)
    if not (len(mine) and len(others)):
        return False
    return distance(mine, others) <= ALIKE


def distance(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    """The Kolmogorov–Smirnov distance of two samples, each sorted."""
    at = np.concatenate([one, other])
    shares = [np.searchsorted(values, at, side="right") / len(values) for values in (one, other)]
    return float(np.abs(shares[0] - shares[1]).max())


def _displacements(motion: Settled, max_events: int) -> NDArray[np.float64]:
    """Displacements at the section over many cycles, sorted."""
    status, rows = motion.engine.sections(motion.state.copy(), _SEEN, max_events)
    # Fewer if it is given up: then it is another motion than one that goes on.
    return np.sort(rows[:, lyapunov.SECTION]) if status is Status.DONE else np.empty(0)
