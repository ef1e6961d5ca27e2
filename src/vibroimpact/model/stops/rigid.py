"""A rigid wall."""

from __future__ import annotations

from typing import Annotated, ClassVar

from vibroimpact.model.law_registry import Named
from vibroimpact.model.quantities import DIMENSIONLESS, LENGTH
from vibroimpact.model.validation import Accepts, constructor


class RigidStop(Named):
    """A rigid wall. The mass rebounds from it at once, or comes to rest on it.

    If the mass reaches the wall with the velocity v, it leaves the wall with the velocity -e v. If
    a force presses the mass against the wall and e < 1, the mass chatters: infinitely many impacts
    occur in a finite time. After that the mass rests on the wall until the pressing force vanishes.

    Parameters
    ----------
    restitution
        Coefficient of restitution e, from 0 to 1: rebound velocity divided by impact velocity.
    gap
        Distance from the mass at u = 0 to the wall, in m; or text such as ``"7.5 mm"``. If the gap
        is negative, the mass rests on the wall, away from u = 0, until the shaking lifts it off.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "rigid"

    restitution: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0, maximum=1.0)]
    gap: Annotated[float, Accepts(LENGTH)]

    @constructor
    def __init__(self, restitution: float | str, gap: float | str) -> None:
        super().__init__(restitution=restitution, gap=gap)

    @property
    def linear(self) -> bool:
        """Whether the motion between impacts stays linear: always true for a rigid wall."""
        return True
