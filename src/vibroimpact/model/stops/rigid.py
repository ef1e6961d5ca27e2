"""A wall that does not give way."""

from __future__ import annotations

from typing import Annotated, ClassVar

from vibroimpact.model.law_registry import Named
from vibroimpact.model.quantities import DIMENSIONLESS, LENGTH
from vibroimpact.model.validation import Accepts, constructor


class RigidStop(Named):
    """A rigid wall from which the mass rebounds at once; the mass may come to rest on it.

    If the mass reaches the wall with velocity v, it leaves with -e v. If a force presses it against
    the wall and e < 1, it chatters: infinitely many impacts occur in a finite time. Then it rests
    on the wall until the pressing force vanishes.

    Parameters
    ----------
    restitution
        Coefficient of restitution e, from 0 to 1: rebound velocity divided by impact velocity.
    gap
        Distance in m from the mass at u = 0 to the wall; or text such as ``"7.5 mm"``. With a
        negative gap the mass rests on the wall, away from u = 0, until it is shaken off.

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
        """Whether the wall keeps the motion between impacts linear."""
        return True
