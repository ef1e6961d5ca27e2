"""Spring with dry friction, such as a friction pendulum bearing."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Self

from vibroimpact.errors import InputError
from vibroimpact.law_numbers import IsolatorNumbers
from vibroimpact.model.isolators.design import design
from vibroimpact.model.isolators.law import SpringLaw
from vibroimpact.model.quantities import FORCE, GRAVITY
from vibroimpact.model.validation import Accepts, takes_fields


class FrictionIsolator(SpringLaw):
    """A linear spring and a dashpot, in parallel with Coulomb friction.

    While the mass slides, the force is K u + C v + F_c sgn v. If the mass stops and the other
    forces on it do not exceed F_c, it sticks until they exceed F_c.

    In a study file, its ``kind`` is ``"friction"``.

    Parameters
    ----------
    stiffness
        Stiffness K in N/m, at least 0; or a string such as ``"26.8 kN/m"``.
    damping
        Damping coefficient C in N s/m, at least 0; or a string such as ``"1.1 kN s/m"``.
    friction
        Friction force F_c in N, at least 0; or a string such as ``"120 N"``. It is the same for
        sliding and for sticking.
    damping_exponent
        Exponent α of the viscous force ``C |v|^α sgn v``, greater than 0. The unit of C is N
        (s/m)^α. Default: 1.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "friction"
    designs: ClassVar[tuple[str, ...]] = ("from_period", "from_pendulum")

    friction: Annotated[float, Accepts(FORCE, minimum=0.0)]

    @takes_fields
    def __init__(
        self,
        stiffness: float | str,
        damping: float | str,
        friction: float | str,
        damping_exponent: float | str = 1.0,
    ) -> None: ...

    @classmethod
    def from_period(
        cls,
        mass: float | str,
        period: float | str,
        damping_ratio: float | str = 0.0,
        coefficient: float | str | None = None,
        **others: Any,
    ) -> Self:
        """Return the isolator that gives a mass a sliding period and a friction force.

        Parameters
        ----------
        mass
            Mass M on the isolator in kg, greater than 0; or a string such as ``"5000 t"``.
        period
            Natural period T of the mass on the spring while it slides, in s, greater than 0; or
            a string such as ``"2.5 s"``. A friction pendulum of radius R has T = 2π √(R/g) for any
            mass.
        damping_ratio
            Damping ratio ξ of the parallel dashpot, at least 0. Default: 0.
        coefficient
            Coefficient of friction μ, at least 0. The friction force is F_c = μ M g.
        **others
            Other fields of the isolator, such as ``friction``, the force F_c, instead of the
            coefficient.

        Returns
        -------
        FrictionIsolator
            Isolator with K = M (2π/T)² and C = 2 ξ M 2π/T.

        Raises
        ------
        InputError
            If a value is not finite, has a wrong unit or lies outside its bounds.
        """
        if coefficient is not None:
            if "friction" in others:
                raise InputError("friction: given together with coefficient; remove one of the two")
            m, mu = design(mass=mass, coefficient=coefficient)
            others["friction"] = mu * m * GRAVITY
        return super().from_period(mass, period, damping_ratio, **others)

    @classmethod
    def from_pendulum(
        cls,
        mass: float | str,
        radius: float | str,
        coefficient: float | str,
        damping: float | str = 0.0,
    ) -> Self:
        """Return the isolator of a friction pendulum bearing.

        Parameters
        ----------
        mass
            Mass M on the isolator in kg, greater than 0; or a string such as ``"550 kg"``.
        radius
            Effective radius R of the concave surface in m, greater than 0; or a string such as
            ``"2.5 m"``.
        coefficient
            Coefficient of friction μ, at least 0.
        damping
            Damping coefficient C in N s/m, at least 0. Default: 0.

        Returns
        -------
        FrictionIsolator
            Isolator with K = M g/R and F_c = μ M g. It is valid for displacements much smaller than
            R (Zayas, Low and Mahin, Earthquake Spectra 6 (1990) 317).

        Raises
        ------
        InputError
            If a value is not finite, has a wrong unit or lies outside its bounds.

        Examples
        --------
        >>> FrictionIsolator.from_pendulum("1000 kg", "9.80665 m", 0.05).stiffness
        1000.0
        """
        m, r, mu = design(mass=mass, radius=radius, coefficient=coefficient)
        weight = m * GRAVITY
        return cls(weight / r, damping, mu * weight)

    @classmethod
    def like(cls, stiffness: float, damping: float, displacement: float) -> Self:
        """Return such an isolator."""
        return cls(stiffness, damping, 0.1 * stiffness * displacement)

    @property
    def sticks(self) -> bool:
        """Whether the mass can come to rest away from the equilibrium: always true."""
        return True

    def engine_numbers(self) -> tuple[float, float, IsolatorNumbers]:
        """Return the numbers by which the engine follows the law."""
        law = IsolatorNumbers(friction=self.friction, drag=self.damping_exponent)
        return self.stiffness, self.damping, law

    def _restoring(self, displacement: list[float], sign: list[float]) -> Iterator[float]:
        for u, way in zip(displacement, sign, strict=True):
            yield self.stiffness * u + way * self.friction

    @property
    def linear_and_bounded(self) -> tuple[float, float]:
        """The pair (K, F_c)."""
        return self.stiffness, self.friction

    def static_force(self, displacement: float) -> float:
        """Return K u + F_c sgn u (N) at a displacement (m); at rest the force is within ±F_c."""
        friction = math.copysign(self.friction, displacement) if displacement else 0.0
        return self.stiffness * displacement + friction

    @property
    def strongest(self) -> float:
        """Largest static force (N): ∞, or F_c without a spring."""
        return super().strongest if self.stiffness else self.friction
