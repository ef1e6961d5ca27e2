"""Pounding of structures: a Hertz contact that takes energy while it closes."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Self

from pydantic import model_validator

from vibroimpact.errors import InputError
from vibroimpact.model.law_registry import Named
from vibroimpact.model.quantities import DIMENSIONLESS, LENGTH, MASS, power_stiffness
from vibroimpact.model.validation import Accepts, constructor


class JankowskiBumper(Named):
    """A stop without mass and memory that takes energy while the mass comes and none while it goes.

    F = k δ^1.5 + 2 ξ √(m k √δ) δ' while δ' > 0, and k δ^1.5 after that, with δ the depth to which
    the mass has gone into it (Jankowski, Earthquake Eng. Struct. Dyn. 34 (2005) 595; ξ of 35
    (2006) 517).

    Its kind in a table is ``"jankowski"``.

    Parameters
    ----------
    stiffness
        k in N/m^1.5, greater than 0; or text such as ``"2 GN/m^1.5"``.
    gap
        Distance in m from the mass at u = 0 to the stop at rest; or text such as ``"7.5 mm"``.
        Below 0 it is preloaded.
    restitution
        e, greater than 0 and at most 1: what an impact of the mass m returns, nearly.
    mass
        m in kg, greater than 0: the mass that hits it, m₁ m₂/(m₁ + m₂) of two; or text such as
        ``"550 kg"``.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "jankowski"
    exponent: ClassVar[float] = 1.5

    stiffness: Annotated[float, Accepts(power_stiffness(1.5), above=0.0)]
    gap: Annotated[float, Accepts(LENGTH)]
    restitution: Annotated[float, Accepts(DIMENSIONLESS, above=0.0, maximum=1.0)]
    mass: Annotated[float, Accepts(MASS, above=0.0)]

    @constructor
    def __init__(
        self,
        stiffness: float | str,
        gap: float | str,
        restitution: float | str,
        mass: float | str,
    ) -> None:
        super().__init__(stiffness=stiffness, gap=gap, restitution=restitution, mass=mass)

    @model_validator(mode="after")
    def _damped_finitely(self) -> Self:
        if not self.damping_ratio < math.inf:
            raise InputError(
                f"restitution: {self.restitution:g} needs a damping without bound; a larger "
                "restitution is accepted"
            )
        return self

    @property
    def damping_ratio(self) -> float:
        """The ξ = (9√5/2) (1 - e²)/{e [e (9π - 16) + 16]} of its damping."""
        e = self.restitution
        below = e * (e * (9.0 * math.pi - 16.0) + 16.0)
        lost = 4.5 * math.sqrt(5.0) * (1.0 - e) * (1.0 + e)
        return lost / below if below else math.inf

    @property
    def linear(self) -> bool:
        """Whether its force is K_j d + C_j d'."""
        return False

    def static_force(self, deformation: float) -> float:
        """Force in N of a stop that is slowly pressed by a deformation in m, k δ^1.5."""
        return float(self.stiffness * max(deformation, 0.0) ** 1.5)
