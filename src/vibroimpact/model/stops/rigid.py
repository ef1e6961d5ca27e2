"""A rigid wall."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from vibroimpact.model.quantities import DIMENSIONLESS, LENGTH
from vibroimpact.model.stops.law import WallLaw
from vibroimpact.model.units import plain, pretty
from vibroimpact.model.validation import Accepts, takes_fields


class RigidStop(WallLaw):
    """A rigid wall. The mass rebounds from it at once, or comes to rest on it.

    If the mass reaches the wall with the velocity v, it leaves the wall with the velocity -e v. If
    a force presses the mass against the wall and e < 1, the mass chatters: infinitely many impacts
    occur in a finite time. After that the mass rests on the wall until the pressing force vanishes.

    Parameters
    ----------
    restitution
        Coefficient of restitution e, from 0 to 1: rebound velocity divided by impact velocity.
    gap
        Distance from the mass at u = 0 to the wall, in m; or a string such as ``"7.5 mm"``. If the
        gap is negative, the mass rests on the wall, away from u = 0, until the shaking lifts it
        off.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "rigid"

    restitution: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0, maximum=1.0)]
    gap: Annotated[float, Accepts(LENGTH)]

    @takes_fields
    def __init__(self, restitution: float | str, gap: float | str) -> None: ...

    @classmethod
    def like(
        cls, force: float, depth: float, gap: float, restitution: float, omega: float, mass: float
    ) -> Self:
        """Return such a stop."""
        return cls(restitution, gap)

    def engine_numbers(self) -> tuple[float, float]:
        """Return e and the gap (m)."""
        return self.restitution, self.gap

    def summary(self) -> str:
        """Return the law in one line, with its numbers."""
        return f"rigid, e = {plain(self.restitution, 4)}, gap {pretty(self.gap, LENGTH)}"
