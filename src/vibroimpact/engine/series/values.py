"""What a mode's forces are made of, as values."""

from __future__ import annotations

from typing import NamedTuple


class Frame(NamedTuple):
    """u = sign (x + offset); x″ = load − stiffness x − damping x′ − laws − sign A_t."""

    sign: float
    offset: float
    stiffness: float
    damping: float
    load: float


class Branch(NamedTuple):
    """Which piece of the isolator's law holds: z′ = x′ (slope − bend zⁿ), sgn x′ and sgn u."""

    slope: float
    bend: float
    way: float
    side: float


class Push(NamedTuple):
    """What a pressed stop pushes with: stiffness δⁿ (1 + dissipation δ′) + viscous δ^¼ δ′."""

    stiffness: float
    exponent: float
    dissipation: float
    viscous: float


NO_PUSH = Push(0.0, 1.5, 0.0, 0.0)


class Laws(NamedTuple):
    """Which forces of a mode are not linear: stops that push, the isolator's branch, its drag.

    `push` belongs to the stop that the coordinate is of, `other` to one that is pressed besides,
    by minus the coordinate and `apart`. Where a force is nothing beside the others it is left
    out, for its power begins there: stiffness and drag are 0.
    """

    branch: Branch
    push: Push
    other: Push
    apart: float
    drag: float
