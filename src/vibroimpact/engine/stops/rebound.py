"""The laws by which rigid walls return what hits them, each a function in `LAWS`.

All that the engine knows of a rebound is in what such a function returns: flights and rests of one
mass and of several, saltation, records and measures ask `rebound`. See `stops` for how to add one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.law_numbers import StopNumbers, Wall

NUMBERS = 4
"""Numbers of a law, at most."""
WIDTH = 1 + NUMBERS
"""In a rig's vector, the place of the law in `LAWS` stands before its numbers."""


class Rebound(NamedTuple):
    """What a wall makes of a closing speed w (m/s), at least 0, which it returns with e w.

    Attributes
    ----------
    restitution
        e, from 0 to 1. The impact takes ½ (1 − e²) m w².
    order
        d ln(e w) / d ln w, greater than 0: 1 where e is constant. The slope that saltation needs is
        this times e.
    onward
        The restitution of all impacts with this speed or less, with which the duration of a chatter
        is a geometric series; 1 if they differ, so that the next impact is followed by itself.
    """

    restitution: float
    order: float
    onward: float


def constant(numbers: Vector, at: int, speed: float) -> Rebound:
    """The same e at any speed: the first number."""
    e = numbers[at]
    return Rebound(e, 1.0, e)


LAWS: dict[str, Callable[[Any, int, float], Rebound]] = {"constant": constant}
"""By the name that a `Wall` has. The numbers of a law begin at a place of a vector. Newton's method
may look somewhat beyond the bounds of a number."""


def written(stop: StopNumbers) -> list[float]:
    """Return how a wall stands in a vector: which law, and its numbers."""
    wall = stop if isinstance(stop, Wall) else Wall("constant", stop[:1], stop[1])
    if len(wall.numbers) > NUMBERS:
        raise ValueError(f"{len(wall.numbers)} numbers of a wall; at most {NUMBERS} are possible")
    if wall.law not in LAWS:
        raise ValueError(f"{wall.law!r} is not a law of rebound; {', '.join(LAWS)} are")
    numbers = [*wall.numbers, *[0.0] * (NUMBERS - len(wall.numbers))]
    return [float(list(LAWS).index(wall.law)), *numbers]


def restitutions(stop: StopNumbers, speeds: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return e of a wall at closing speeds (m/s)."""
    which, *numbers = written(stop)
    law, flat = list(LAWS.values())[int(which)], np.ravel(speeds)
    values = [law(np.array(numbers), 0, float(speed)).restitution for speed in flat]
    return np.reshape(np.array(values, dtype=float), np.shape(speeds))


def choice(laws: dict[str, Callable[[Any, int, float], Rebound]]) -> Any:
    """Make the function that finds the law of a wall in its vector, and asks it."""
    *others, last = laws.values()
    ask = _asking(kernel(last))
    for code in range(len(others) - 1, -1, -1):
        ask = _either(float(code), kernel(others[code]), ask)
    return ask


def _asking(law: Any) -> Any:
    def ask(plan: Vector, at: int, speed: float) -> Rebound:
        return law(plan, at + 1, speed)  # type: ignore[no-any-return]

    return kernel(ask)


def _either(code: float, law: Any, other: Any) -> Any:
    def ask(plan: Vector, at: int, speed: float) -> Rebound:
        if plan[at] == code:
            return law(plan, at + 1, speed)  # type: ignore[no-any-return]
        return other(plan, at, speed)  # type: ignore[no-any-return]

    return kernel(ask)


rebound = choice(LAWS)
"""The `Rebound` at a closing speed by the law that stands at a place of a plan."""
