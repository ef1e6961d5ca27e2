"""The exponential hysteretic model of Vaiana and others."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Annotated, ClassVar, Self

from pydantic import model_validator

from vibroimpact.errors import InputError
from vibroimpact.law_numbers import IsolatorNumbers
from vibroimpact.model.integral import integral_of
from vibroimpact.model.isolators.law import IsolatorLaw
from vibroimpact.model.quantities import DECAY, FORCE, STIFFNESS
from vibroimpact.model.units import pretty
from vibroimpact.model.validation import Accepts, takes_fields

_LARGEST = 300.0
"""Largest |β| u for which the hyperbolic sine does not overflow."""


class ExponentialIsolator(IsolatorLaw):
    """A hysteretic isolator whose stiffness decays after each reversal, with a dashpot.

    With s = sgn v, the force is

        Q (e^{βu} - e^{-βu} - 2 βu) + k_b u + s f̄ - s (k_a - k_b)/α e^{-α(s u - u_j)},

    where f̄ = (k_a - k_b)/(2 α). At each reversal of the motion, u_j is chosen so that the force is
    continuous (Vaiana, Sessa, Marmo and Rosati, Nonlinear Dynamics 93 (2018) 1647, doi
    10.1007/s11071-018-4282-2; in that paper Q is 1 in the unit of force). A motion starts with zero
    force at u = 0.

    In a study file, its ``kind`` is ``"exponential"``.

    Parameters
    ----------
    reversal_stiffness
        Reversal stiffness k_a in N/m, greater than 0; or a string such as ``"500 kN/m"``. It is the
        tangent stiffness at u = 0 just after a reversal in a large loop.
    final_stiffness
        Final stiffness k_b in N/m, from 0 to k_a. It is the tangent stiffness at u = 0 long after a
        reversal.
    decay
        Rate α of the transition from k_a to k_b, in 1/m, greater than 0.
    damping
        Damping coefficient C in N s/m, at least 0; or a string such as ``"1.1 kN s/m"``.
    hardening
        Rate β of hardening at large displacements, in 1/m. A negative β means softening. At 0 the
        law neither hardens nor softens. Default: 0.
    hardening_force
        Force Q of the hardening, in N, at least 0. Default: 1.
    damping_exponent
        Exponent α of the viscous force ``C |v|^α sgn v``, greater than 0. The unit of C is N
        (s/m)^α. Default: 1.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "exponential"

    reversal_stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    final_stiffness: Annotated[float, Accepts(STIFFNESS, minimum=0.0)]
    decay: Annotated[float, Accepts(DECAY, above=0.0)]
    hardening: Annotated[float, Accepts(DECAY)] = 0.0
    hardening_force: Annotated[float, Accepts(FORCE, minimum=0.0)] = 1.0

    @takes_fields
    def __init__(
        self,
        reversal_stiffness: float | str,
        final_stiffness: float | str,
        decay: float | str,
        damping: float | str,
        hardening: float | str = 0.0,
        hardening_force: float | str = 1.0,
        damping_exponent: float | str = 1.0,
    ) -> None: ...

    @model_validator(mode="after")
    def _fades(self) -> Self:
        if self.final_stiffness > self.reversal_stiffness:
            raise InputError(
                f"final_stiffness: {pretty(self.final_stiffness, STIFFNESS)} is greater than "
                f"reversal_stiffness, {pretty(self.reversal_stiffness, STIFFNESS)}; reduce "
                "final_stiffness, or increase reversal_stiffness"
            )
        if not self.hysteretic_force < math.inf:
            raise InputError(
                f"decay: {pretty(self.decay, DECAY)} makes the hysteresis loop infinitely high; "
                "increase decay"
            )
        return self

    @property
    def hysteretic_force(self) -> float:
        """Half the height of a large loop, f̄ = (k_a - k_b)/(2 α), in N."""
        return 0.5 * (self.reversal_stiffness - self.final_stiffness) / self.decay

    @property
    def initial_stiffness(self) -> float:
        """Tangent stiffness at the start of a motion, (k_a + k_b)/2 (N/m)."""
        return 0.5 * (self.reversal_stiffness + self.final_stiffness)

    @classmethod
    def like(cls, stiffness: float, damping: float, displacement: float) -> Self:
        """Return such an isolator."""
        return cls(2.4 * stiffness, 0.83 * stiffness, 3.5 / displacement, 0.3 * damping)

    def engine_numbers(self) -> tuple[float, float, IsolatorNumbers]:
        """Return the numbers by which the engine follows the law.

        z is the hysteretic force over k_a - k_b, with ``z' = u'/2 - α |u'| z``.
        """
        force, rate = self.hardening_force, self.hardening
        law = IsolatorNumbers(
            sinh=force if rate else 0.0,
            sinh_rate=rate,
            hysteretic=self.reversal_stiffness - self.final_stiffness,
            slope=0.5,
            turning=self.decay,
            drag=self.damping_exponent,
        )
        return self.final_stiffness - 2.0 * force * rate, self.damping, law

    def _restoring(self, displacement: list[float], sign: list[float]) -> Iterator[float]:
        z = last = 0.0
        for u in displacement:
            step, last = u - last, u
            bound = math.copysign(self.hysteretic_force, step)
            z = bound + (z - bound) * math.exp(-self.decay * abs(step))
            yield self.elastic_force(u) + z

    def elastic_force(self, displacement: float) -> float:
        """Return the elastic force Q (2 sinh βu - 2 βu) + k_b u (N) at a displacement (m)."""
        # From |βu| = 300 on it stands still, which no rig lives to see.
        x = max(-_LARGEST, min(_LARGEST, self.hardening * displacement))
        return 2.0 * self.hardening_force * _sinh_rest(x) + self.final_stiffness * displacement

    def static_force(self, displacement: float) -> float:
        """Return the force (N) of a first loading to a displacement (m)."""
        faded = -math.expm1(-self.decay * abs(displacement))
        return self.elastic_force(displacement) + math.copysign(
            self.hysteretic_force * faded, displacement
        )

    def stored_energy(self, displacement: float, memory: float = 0.0) -> float:
        """Return the energy (J) of the elastic force and of the memory z."""
        yielding = (self.reversal_stiffness - self.final_stiffness) * memory**2
        return integral_of(self.elastic_force, displacement) + yielding

    @property
    def remembers(self) -> bool:
        """Whether the law has a hysteretic part."""
        return self.reversal_stiffness > self.final_stiffness

    def remembered(self, displacement: float) -> float:
        """Return the memory z (m) after a first loading to a displacement (m)."""
        spring = self.reversal_stiffness - self.final_stiffness
        held = self.static_force(displacement) - self.elastic_force(displacement)
        return held / spring if spring else 0.0

    @property
    def linear_and_bounded(self) -> tuple[float, float] | None:
        """The pair (k_b, f̄) without hardening; otherwise None."""
        hardens = self.hardening * self.hardening_force != 0.0
        return None if hardens else (self.final_stiffness, self.hysteretic_force)

    @property
    def reach(self) -> float:
        """Displacement (m) of the largest static force if the law softens; ∞ if it does not."""

        def tangent(u: float) -> float:
            bent = 2.0 * math.sinh(0.5 * self.hardening * u) ** 2  # cosh βu - 1
            faded = 0.5 * (self.reversal_stiffness - self.final_stiffness)
            return (
                2.0 * self.hardening_force * self.hardening * bent
                + self.final_stiffness
                + faded * math.exp(-self.decay * u)
            )

        return self._falling_zero(tangent)

    @property
    def strongest(self) -> float:
        """Largest static force within the reach (N)."""
        flat = self.final_stiffness == 0.0 and not self.hardening * self.hardening_force
        return self.hysteretic_force if flat else super().strongest

    @property
    def restoring_reach(self) -> float:
        """Displacement (m) at which the elastic force of a softening law changes its sign."""
        return self._falling_zero(lambda u: self.elastic_force(u) / u if u else 0.0)

    def _falling_zero(self, falling: Callable[[float], float]) -> float:
        """Return where a function of u > 0 falls to zero, if the law softens."""
        if not self.hardening * self.hardening_force < 0.0:
            return math.inf
        from scipy.optimize import brentq

        far = _LARGEST / -self.hardening
        small = math.ldexp(far, -60)
        if falling(small) <= 0.0:
            return 0.0
        if falling(far) > 0.0:
            return math.inf
        return float(brentq(falling, small, far, xtol=1e-300, rtol=1e-15))


def _sinh_rest(x: float) -> float:
    """Return sinh x - x without cancellation for small x."""
    if abs(x) > 1.0:
        return math.sinh(x) - x
    square, term, total = x * x, x, 0.0
    for k in range(3, 22, 2):
        term *= square / (k * (k - 1))
        total += term
    return total
