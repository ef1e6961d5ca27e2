"""A wall that does not give way."""

from __future__ import annotations

from typing import Annotated, ClassVar

from vibroimpact.model.law_registry import Named
from vibroimpact.model.quantities import DIMENSIONLESS, LENGTH
from vibroimpact.model.validation import Accepts, constructor


class RigidStop(Named):
    """A wall that does not give way: the mass rebounds at once, and may come to rest on it.

    The mass that reaches the wall with velocity v towards it leaves with -e v. Where the wall
    is pressed, e < 1 lets the mass fall ever faster on it again, infinitely often in a finite
    time; then it rests on the wall until nothing presses it any more.

    Parameters
    ----------
    restitution
        e, from 0 to 1: velocity of return over velocity of impact.
    gap
        Distance in m from the mass at u = 0 to the wall; or text such as ``"7.5 mm"``. Below 0
        the mass rests on the wall, away from u = 0, until it is shaken off.

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
        """Whether the motion between its impacts is as linear as without it."""
        return True
