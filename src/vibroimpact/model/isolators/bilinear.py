"""Bilinear isolator, such as a lead-rubber bearing: elastic, then yielding."""

from __future__ import annotations

from typing import ClassVar, Self

from vibroimpact.law_numbers import IsolatorNumbers
from vibroimpact.model.isolators.law import YieldingLaw
from vibroimpact.model.validation import takes_fields


class BilinearIsolator(YieldingLaw):
    """A bilinear isolator: two stiffnesses, a yield force, kinematic hardening, and a dashpot.

    A spring k_p is parallel to an elastic, perfectly plastic element of stiffness k_e - k_p, which
    yields at the displacement u_y = F_y/k_e. The force is k_p u + (k_e - k_p) z. The deformation z
    of the plastic element follows the mass (z' = v) while ``|z| < u_y``, and while v reduces
    ``|z|``. While the element yields, z' = 0. A motion starts with z = 0.

    In a study file, its ``kind`` is ``"bilinear"``.

    Parameters
    ----------
    elastic_stiffness
        Elastic stiffness k_e in N/m, greater than 0; or a string such as ``"500 kN/m"``.
    post_yield_stiffness
        Post-yield stiffness k_p in N/m, from 0 to k_e.
    yield_force
        Yield force F_y in N, greater than 0; or a string such as ``"1 kN"``. It is the force at the
        first yield.
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

    kind: ClassVar[str] = "bilinear"

    @takes_fields
    def __init__(
        self,
        elastic_stiffness: float | str,
        post_yield_stiffness: float | str,
        yield_force: float | str,
        damping: float | str,
        damping_exponent: float | str = 1.0,
    ) -> None: ...

    @classmethod
    def like(cls, stiffness: float, damping: float, displacement: float) -> Self:
        """Return such an isolator."""
        return cls(1.6 * stiffness, 0.9 * stiffness, 0.18 * stiffness * displacement, 0.5 * damping)

    def engine_numbers(self) -> tuple[float, float, IsolatorNumbers]:
        """Return the numbers by which the engine follows the law."""
        law = IsolatorNumbers(
            hysteretic=self.hysteretic_stiffness,
            limit=self.yield_displacement,
            drag=self.damping_exponent,
        )
        return self.post_yield_stiffness, self.damping, law

    def _moved_on(self, z: float, step: float) -> float:
        return max(-self.yield_displacement, min(self.yield_displacement, z + step))

    def _loaded(self, displacement: float) -> float:
        limit = self.yield_displacement
        return max(-limit, min(limit, displacement))

    @property
    def strongest(self) -> float:
        """Largest static force (N): ∞, or F_y if the post-yield stiffness is 0."""
        return super().strongest if self.post_yield_stiffness else self.yield_force
