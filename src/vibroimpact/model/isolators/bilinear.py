"""Elastic until it yields, then less stiff: lead-rubber bearings."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from pydantic import model_validator

from vibroimpact.model.isolators.law import IsolatorLaw, check_yielding
from vibroimpact.model.quantities import FORCE, STIFFNESS
from vibroimpact.model.validation import Accepts, constructor


class BilinearIsolator(IsolatorLaw):
    """Two stiffnesses and a yield force, with kinematic hardening, and a dashpot.

    A spring k_p stands beside an elastic, perfectly plastic element of stiffness k_e - k_p that
    yields at ±u_y = F_y/k_e: k_p u + (k_e - k_p) z, where z' = v while |z| < u_y, or where v takes
    it back from there, and else 0. It starts with z = 0.

    Its kind in a table is ``"bilinear"``.

    Parameters
    ----------
    elastic_stiffness
        k_e in N/m, greater than 0; or text such as ``"500 kN/m"``.
    post_yield_stiffness
        k_p in N/m, from 0 to k_e.
    yield_force
        F_y in N, greater than 0: the force where it first yields; or text such as ``"1 kN"``.
    damping
        C in N s/m, at least 0; or text such as ``"1.1 kN s/m"``.
    damping_exponent
        α of the viscous force C |v|^α sgn v, greater than 0; the unit of C is then N (s/m)^α.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "bilinear"

    elastic_stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    post_yield_stiffness: Annotated[float, Accepts(STIFFNESS, minimum=0.0)]
    yield_force: Annotated[float, Accepts(FORCE, above=0.0)]

    @constructor
    def __init__(
        self,
        elastic_stiffness: float | str,
        post_yield_stiffness: float | str,
        yield_force: float | str,
        damping: float | str,
        damping_exponent: float | str = 1.0,
    ) -> None:
        super().__init__(
            elastic_stiffness=elastic_stiffness,
            post_yield_stiffness=post_yield_stiffness,
            yield_force=yield_force,
            damping=damping,
            damping_exponent=damping_exponent,
        )

    @model_validator(mode="after")
    def _yields(self) -> Self:
        check_yielding(self)
        return self

    @property
    def yield_displacement(self) -> float:
        """u_y = F_y/k_e in m."""
        return self.yield_force / self.elastic_stiffness

    @property
    def initial_stiffness(self) -> float:
        """k_e, N/m."""
        return self.elastic_stiffness

    def static_force(self, displacement: float) -> float:
        """Force in N of a first loading to a displacement in m: k_p u + (k_e - k_p) z."""
        limit = self.yield_displacement
        z = max(-limit, min(limit, displacement))
        plastic = self.elastic_stiffness - self.post_yield_stiffness
        return self.post_yield_stiffness * displacement + plastic * z

    def remembered(self, displacement: float) -> float:
        """Its memory z (m) after a first loading to a displacement (m)."""
        spring = self.elastic_stiffness - self.post_yield_stiffness
        held = self.static_force(displacement) - self.post_yield_stiffness * displacement
        return held / spring if spring else 0.0

    @property
    def strongest(self) -> float:
        """∞, or F_y without a post-yield stiffness."""
        return super().strongest if self.post_yield_stiffness else self.yield_force
