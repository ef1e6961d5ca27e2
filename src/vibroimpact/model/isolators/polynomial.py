"""Duffing's spring, which hardens or softens."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Self

from vibroimpact.law_numbers import IsolatorNumbers
from vibroimpact.model.isolators.law import SpringLaw
from vibroimpact.model.quantities import power_stiffness
from vibroimpact.model.validation import Accepts, takes_fields


class PolynomialIsolator(SpringLaw):
    """A nonlinear spring with the force K u + k₃ u³ + k₅ u⁵ (Duffing), and a dashpot.

    In a study file, its ``kind`` is ``"polynomial"``.

    Parameters
    ----------
    stiffness
        Stiffness K in N/m, at least 0; or a string such as ``"26.8 kN/m"``.
    damping
        Damping coefficient C in N s/m, at least 0; or a string such as ``"1.1 kN s/m"``.
    cubic
        Coefficient k₃ in N/m³; or a string such as ``"5 MN/m^3"``. A negative value makes the
        spring soften. Default: 0.
    quintic
        Coefficient k₅ in N/m⁵; or a string such as ``"5 MN/m^5"``. Default: 0.
    damping_exponent
        Exponent α of the viscous force ``C |v|^α sgn v``, greater than 0. The unit of C is N
        (s/m)^α. Default: 1.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "polynomial"

    cubic: Annotated[float, Accepts(power_stiffness(3.0), meaning="cubic stiffness")] = 0.0
    quintic: Annotated[float, Accepts(power_stiffness(5.0), meaning="quintic stiffness")] = 0.0

    @takes_fields
    def __init__(
        self,
        stiffness: float | str,
        damping: float | str,
        cubic: float | str = 0.0,
        quintic: float | str = 0.0,
        damping_exponent: float | str = 1.0,
    ) -> None: ...

    @classmethod
    def like(cls, stiffness: float, damping: float, displacement: float) -> Self:
        """Return such an isolator."""
        return cls(stiffness, damping, 0.3 * stiffness / displacement**2, 0.0)

    def engine_numbers(self) -> tuple[float, float, IsolatorNumbers]:
        """Return the numbers by which the engine follows the law."""
        law = IsolatorNumbers(self.cubic, self.quintic, drag=self.damping_exponent)
        return self.stiffness, self.damping, law

    def static_force(self, displacement: float) -> float:
        """Return K u + k₃ u³ + k₅ u⁵ (N) at a displacement (m)."""
        square = displacement * displacement
        return displacement * (self.stiffness + square * (self.cubic + square * self.quintic))

    def stored_energy(self, displacement: float, memory: float = 0.0) -> float:
        """Return the energy K u²/2 + k_3 u⁴/4 + k_5 u⁶/6 (J) at a displacement (m)."""
        square = displacement**2
        rest = square * (self.cubic / 4.0 + square * self.quintic / 6.0)
        return square * (0.5 * self.stiffness + rest)

    @property
    def linear_and_bounded(self) -> tuple[float, float] | None:
        """The pair (K, 0) if k₃ and k₅ are 0; otherwise None."""
        return None if self.cubic or self.quintic else (self.stiffness, 0.0)

    @property
    def reach(self) -> float:
        """Least u > 0 with K + 3 k₃ u² + 5 k₅ u⁴ = 0 (m); ∞ if there is none."""
        return _first_zero(self.stiffness, 3.0 * self.cubic, 5.0 * self.quintic)

    @property
    def strongest(self) -> float:
        """Largest static force within the reach (N); 0 if there is no spring."""
        if not (self.stiffness or self.cubic or self.quintic):
            return 0.0
        return super().strongest

    @property
    def restoring_reach(self) -> float:
        """Least u > 0 with K + k₃ u² + k₅ u⁴ = 0 (m); ∞ if there is none."""
        return _first_zero(self.stiffness, self.cubic, self.quintic)


def _first_zero(k: float, c: float, q: float) -> float:
    """Return the least x > 0 from which k + c x² + q x⁴ is negative (k ≥ 0); ∞ if none."""
    if k == 0.0 and (c < 0.0 or (c == 0.0 and q < 0.0)):
        return 0.0
    if k == 0.0:
        return math.sqrt(-c / q) if q < 0.0 else math.inf
    inside = c * c - 4.0 * q * k
    if inside <= 0.0:
        # Where it only touches zero, it rises again behind.
        return math.inf
    # 2 k/(√(c² - 4 q k) - c) does not lose digits for a small q.
    root = math.sqrt(inside) - c
    return math.sqrt(2.0 * k / root) if root > 0.0 and (c < 0.0 or q < 0.0) else math.inf
