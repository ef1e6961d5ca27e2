"""Smooth yielding: the Bouc-Wen model."""

from __future__ import annotations

import math
from contextlib import suppress
from numbers import Integral
from typing import Annotated, Any, ClassVar, Self

from pydantic import BeforeValidator, model_validator

from vibroimpact.errors import InputError, shown
from vibroimpact.law_numbers import IsolatorNumbers
from vibroimpact.model.isolators.law import YieldingLaw
from vibroimpact.model.quantities import DIMENSIONLESS
from vibroimpact.model.units import read
from vibroimpact.model.validation import Accepts, takes_fields

_SETTLED = 40.0
"""Value of n (x - 1) above which y is 1 to the last digit, because 1 - yⁿ < exp(-n (x - 1))."""


_DIGITS = 290.0
_STEPS = 8
"""Number of Runge-Kutta steps between two points of a path."""


def _whole(value: Any) -> int:
    """Read an integer exponent; 2.0 and ``"2"`` count as 2."""
    number: Any = value if isinstance(value, Integral | float) else math.nan
    if isinstance(value, str):
        with suppress(InputError):
            number = read(value, DIMENSIONLESS)
    if isinstance(value, bool) or not 1 <= number <= 100 or not float(number).is_integer():
        raise InputError(f"{shown(value)}; use a whole number from 1 to 100, such as 1")
    return int(number)


class BoucWenIsolator(YieldingLaw):
    """The smooth hysteretic isolator of Bouc and Wen, with a dashpot.

    The force is k_p u + (k_e - k_p) z, with ``z' = v [1 - |z/u_y|ⁿ (γ + β sgn(v z))]`` and u_y =
    F_y/k_e (Wen, J. Eng. Mech. Div. 102 (1976) 249). A motion starts with z = 0, and ``|z|`` stays
    below u_y/(β + γ)^(1/n). If β + γ = 1 and n increases, the model approaches the
    `BilinearIsolator` with the same stiffnesses and the same yield force.

    In a study file, its ``kind`` is ``"bouc-wen"``.

    Parameters
    ----------
    elastic_stiffness
        Elastic stiffness k_e in N/m, greater than 0; or a string such as ``"500 kN/m"``.
    post_yield_stiffness
        Post-yield stiffness k_p in N/m, from 0 to k_e.
    yield_force
        Yield force F_y in N, greater than 0; or a string such as ``"1 kN"``.
    damping
        Damping coefficient C in N s/m, at least 0; or a string such as ``"1.1 kN s/m"``.
    exponent
        Exponent n, a whole number from 1 to 100. The larger it is, the sharper is the transition to
        yielding. Default: 1.
    beta
        Parameter β of the hysteretic dissipation, at least 0. If it is 0, the law is a nonlinear
        elastic spring. Default: 0.5.
    gamma
        Parameter γ. The sum β + γ must be greater than 0. If γ = β, the isolator unloads with the
        elastic stiffness. Default: 0.5.
    damping_exponent
        Exponent α of the viscous force ``C |v|^α sgn v``, greater than 0. The unit of C is N
        (s/m)^α. Default: 1.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "bouc-wen"

    exponent: Annotated[int, BeforeValidator(_whole)] = 1
    beta: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0, meaning="hysteresis number β")] = 0.5
    gamma: Annotated[float, Accepts(DIMENSIONLESS, meaning="hysteresis number γ")] = 0.5

    @takes_fields
    def __init__(
        self,
        elastic_stiffness: float | str,
        post_yield_stiffness: float | str,
        yield_force: float | str,
        damping: float | str,
        exponent: int = 1,
        beta: float | str = 0.5,
        gamma: float | str = 0.5,
        damping_exponent: float | str = 1.0,
    ) -> None: ...

    @model_validator(mode="after")
    def _is_bounded(self) -> Self:
        if not self.beta + self.gamma > 0.0:
            raise InputError(
                f"gamma: {self.gamma:g} plus beta, {self.beta:g}, is not greater than 0, so the "
                "isolator would never yield; increase gamma or beta"
            )
        if not self.hysteretic_limit < math.inf:
            raise InputError(
                f"gamma: {self.gamma:g} plus beta, {self.beta:g}, is so small that the limit of "
                "the hysteretic displacement is outside the range of floating-point numbers; "
                "increase gamma or beta"
            )
        # The engine writes u_y^-n as a number.
        if not -_DIGITS < self.exponent * math.log10(self.yield_displacement) < _DIGITS:
            raise InputError(
                f"exponent: {self.exponent} is too large, because the yield displacement, "
                f"{self.yield_displacement:g} m, to this power is outside the range of "
                f"floating-point numbers; use at most {self._sharpest}"
            )
        return self

    @property
    def _sharpest(self) -> int:
        return int(_DIGITS / abs(math.log10(self.yield_displacement)))

    @property
    def hysteretic_limit(self) -> float:
        """Upper bound of ``|z|``, u_y/(β + γ)^(1/n) (m)."""
        return self.yield_displacement * float((self.beta + self.gamma) ** (-1.0 / self.exponent))

    @classmethod
    def like(cls, stiffness: float, damping: float, displacement: float) -> Self:
        """Return such an isolator."""
        return cls(1.8 * stiffness, 0.9 * stiffness, 0.18 * stiffness * displacement, 0.5 * damping)

    def engine_numbers(self) -> tuple[float, float, IsolatorNumbers]:
        """Return the numbers by which the engine follows the law."""
        scale = self.yield_displacement**-self.exponent
        law = IsolatorNumbers(
            hysteretic=self.hysteretic_stiffness,
            turning=self.beta * scale,
            knee=self.gamma * scale,
            sharpness=self.exponent,
            drag=self.damping_exponent,
        )
        return self.post_yield_stiffness, self.damping, law

    def _moved_on(self, z: float, step: float) -> float:
        # The classical Runge-Kutta method.
        limit, n = self.yield_displacement, self.exponent
        h = step / _STEPS

        def slope(z: float) -> float:
            turned = self.beta if z * step > 0.0 else -self.beta
            return 1.0 - abs(z / limit) ** n * (self.gamma + turned)

        for _ in range(_STEPS):
            a = slope(z)
            b = slope(z + 0.5 * h * a)
            c = slope(z + 0.5 * h * b)
            z += h / 6.0 * (a + 2.0 * b + 2.0 * c + slope(z + h * c))
        return z

    def _loaded(self, displacement: float) -> float:
        limit = self.hysteretic_limit
        return math.copysign(
            limit * _saturation(abs(displacement) / limit, self.exponent), displacement
        )

    @property
    def strongest(self) -> float:
        """Largest static force (N): ∞, or k_e times the limit of z if k_p is 0."""
        if self.post_yield_stiffness:
            return super().strongest
        return self.elastic_stiffness * self.hysteretic_limit


def _saturation(x: float, n: int) -> float:
    """Return the solution y of dy/dx = 1 - yⁿ, y(0) = 0."""
    if n == 1:
        return -math.expm1(-x)
    if n == 2:
        return math.tanh(x)
    if n * (x - 1.0) > _SETTLED:
        return 1.0
    from scipy.optimize import brentq
    from scipy.special import hyp2f1

    def ahead(y: float) -> float:
        # ∫ dy/(1 - yⁿ) = y ₂F₁(1, 1/n; 1 + 1/n; yⁿ)
        return float(y * hyp2f1(1.0, 1.0 / n, 1.0 + 1.0 / n, y**n)) - x

    almost = math.nextafter(1.0, 0.0)
    if ahead(almost) <= 0.0:
        return 1.0
    return float(brentq(ahead, 0.0, almost, xtol=1e-300, rtol=1e-15))
