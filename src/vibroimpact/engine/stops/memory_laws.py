"""The laws of stops with a memory, each three formulas in `LAWS`.

The memory z (m) is the deformation at which the face of a free stop stands. While the stop is
pressed, its force depends on z besides the deformation d (m) and its rate v (m/s). The engine runs
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
        Force (N) while the stop is pressed, of d, v and z. Bodies meet it at d = z, and part where
        its force falls to zero, which must be at d = z, too.
    rate
        z′ while the stop is pressed, of d, v and z; None if z is then d itself.
    free_rate
        z′ while the stop is free, of z; 0 at z = 0.
    """

    force: Callable[[Any, Any, Any, Any], Any]
    rate: Callable[[Any, Any, Any, Any], Any] | None
    free_rate: Callable[[Any, Any], Any]


ZENER = MemoryLaw(
    force=lambda of, d, v, z: (d - z) * (of[0] + of[1]),
    rate=lambda of, d, v, z: (d * (of[1] / (of[0] + of[1])) - z) * (of[1] / of[2]),
    free_rate=lambda of, z: z * (-of[0] * of[1] / ((of[0] + of[1]) * of[2])),
)
"""A spring beside a spring and a dashpot in series: k, k₁ and c.

The end of the dashpot is at z (k + k₁)/k₁.
"""

LAWS: dict[str, MemoryLaw] = {"zener": ZENER}
"""By the name that a `MemoryStop` has."""


def written(stop: MemoryStop) -> list[float]:
    """Return how a stop stands in a vector: which law, and its numbers."""
    if len(stop.numbers) > NUMBERS:
        raise ValueError(f"{len(stop.numbers)} numbers of a stop; at most {NUMBERS} are possible")
    if stop.law not in LAWS:
        raise ValueError(f"{stop.law!r} is not a law with a memory; {', '.join(LAWS)} are")
    numbers = [*stop.numbers, *[0.0] * (NUMBERS - len(stop.numbers))]
    return [float(list(LAWS).index(stop.law)), *numbers]
