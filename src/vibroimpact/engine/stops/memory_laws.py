"""The laws of stops with a memory, each four formulas in `LAWS`.

A memory z (m) is what the deformation d (m) and its rate v (m/s) do not determine. The engine runs
the formulas with symbols (`assembly.curved.tape`), so that nothing is compiled for a new one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from vibroimpact.law_numbers import MemoryStop

NUMBERS = 4
"""Numbers of a law, at most."""


class MemoryLaw(NamedTuple):
    """Formulas of numbers or series; their first argument are the numbers of the law.

    Attributes
    ----------
    force
        Force (N) while the stop is pressed, of d, v and z; where it falls to zero, the bodies part.
    rate
        z′ while the stop is pressed, of d, v and z.
    face
        d of the free stop, of z: where the bodies meet it.
    free_rate
        z′ while the stop is free, of z; 0 at z = 0, where the face is at rest, too.
    """

    force: Callable[[Any, Any, Any, Any], Any]
    rate: Callable[[Any, Any, Any, Any], Any]
    face: Callable[[Any, Any], Any]
    free_rate: Callable[[Any, Any], Any]


SOLID = MemoryLaw(
    force=lambda of, d, v, z: d * of[0] + (d - z) * of[1],
    rate=lambda of, d, v, z: (d - z) * (of[1] / of[2]),
    face=lambda of, z: z * (of[1] / (of[0] + of[1])),
    free_rate=lambda of, z: z * (-of[0] * of[1] / ((of[0] + of[1]) * of[2])),
)
"""A spring beside a spring and a dashpot in series: k, k₁ and c; z is the end of the dashpot."""

LAWS: dict[str, MemoryLaw] = {"solid": SOLID}
"""By the name that a `MemoryStop` has."""


def written(stop: MemoryStop) -> list[float]:
    """Return how a stop stands in a vector: which law, and its numbers."""
    if len(stop.numbers) > NUMBERS:
        raise ValueError(f"{len(stop.numbers)} numbers of a stop; at most {NUMBERS} are possible")
    if stop.law not in LAWS:
        raise ValueError(f"{stop.law!r} is not a law with a memory; {', '.join(LAWS)} are")
    numbers = [*stop.numbers, *[0.0] * (NUMBERS - len(stop.numbers))]
    return [float(list(LAWS).index(stop.law)), *numbers]
