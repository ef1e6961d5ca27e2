"""The linear spring and dashpot."""

from __future__ import annotations

from typing import ClassVar, Self

from vibroimpact.law_numbers import IsolatorNumbers
from vibroimpact.model.isolators.law import SpringLaw
from vibroimpact.model.quantities import DAMPING, STIFFNESS
from vibroimpact.model.units import pretty
from vibroimpact.model.validation import takes_fields


class Isolator(SpringLaw):
    """A linear spring and a dashpot that carry the mass (the paper's damper D).

    In a study file, its ``kind`` is ``"linear"``, which may be omitted.

    Parameters
    ----------
    stiffness
        Stiffness K in N/m, at least 0; or a string such as ``"26.8 kN/m"``.
    damping
        Damping coefficient C in N s/m, at least 0; or a string such as ``"1.1 kN s/m"``.
    damping_exponent
        Exponent α of the viscous force ``C |v|^α sgn v``, greater than 0. The unit of C is N
        (s/m)^α. Default: 1.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "linear"
    usual: ClassVar[bool] = True

    @takes_fields
    def __init__(
        self,
        stiffness: float | str,
        damping: float | str,
        damping_exponent: float | str = 1.0,
    ) -> None: ...

    @classmethod
    def like(cls, stiffness: float, damping: float, displacement: float) -> Self:
        """Return such an isolator."""
        return cls(stiffness, damping)

    def engine_numbers(self) -> tuple[float, float, IsolatorNumbers]:
        """Return the numbers by which the engine follows the law."""
        return self.stiffness, self.damping, IsolatorNumbers(drag=self.damping_exponent)

    def summary(self) -> str:
        """Return the law in one line, with its numbers."""
        if not self.linear:
            return super().summary()
        k, c = pretty(self.stiffness, STIFFNESS), pretty(self.damping, DAMPING)
        return f"K = {k}, C = {c}" if self.stiffness or self.damping else "none"

    @property
    def linear_and_bounded(self) -> tuple[float, float]:
        """The pair (K, 0)."""
        return self.stiffness, 0.0

    @property
    def linear(self) -> bool:
        """Whether the force is K u + C v."""
        return self.damping_exponent == 1.0

    def static_force(self, displacement: float) -> float:
        """Return K u (N) at a displacement (m)."""
        return self.stiffness * displacement

    @property
    def strongest(self) -> float:
        """Largest static force (N): ∞, or 0 without a spring."""
        return super().strongest if self.stiffness else 0.0
