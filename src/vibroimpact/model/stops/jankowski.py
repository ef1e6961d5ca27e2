"""Pounding of structures: a Hertz contact that dissipates energy during the approach."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import model_validator

from vibroimpact.errors import InputError
from vibroimpact.law_numbers import PowerLaw
from vibroimpact.model.quantities import DIMENSIONLESS, LENGTH, MASS, power_stiffness
from vibroimpact.model.stops.law import StopLaw
from vibroimpact.model.validation import Accepts, takes_fields


class JankowskiBumper(StopLaw):
    """A massless Hertz stop that dissipates energy only during the approach.

    The force is F = k δ^1.5 + 2 ξ √(m k √δ) δ' during the approach (δ' > 0), and F = k δ^1.5 during
    the rebound. δ is the penetration depth of the mass (Jankowski, Earthquake Eng. Struct. Dyn. 34
    (2005) 595; ξ is from 35 (2006) 517).

    In a study file, its ``kind`` is ``"jankowski"``.

    Parameters
    ----------
    stiffness
        Stiffness k in N/m^1.5, greater than 0; or a string such as ``"2 GN/m^1.5"``.
    gap
        Distance from the mass at u = 0 to the undeformed stop, in m; or a string such as
        ``"7.5 mm"``. A negative gap is a preload.
    restitution
        Coefficient of restitution e of an impact of the mass m, greater than 0 and at most 1. The
        model reaches it approximately.
    mass
        Mass m that hits the stop, in kg, greater than 0; or a string such as ``"550 kg"``. For two
        bodies that hit each other it is m₁ m₂/(m₁ + m₂). Default: None; an `Assembly` then uses
        the two bodies that the stop joins. An `Oscillator` requires the mass.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "jankowski"
    words: ClassVar[str] = "Jankowski"
    exponent: ClassVar[float] = 1.5
    _quiet: ClassVar = {"mass": None}

    stiffness: Annotated[float, Accepts(power_stiffness(1.5), above=0.0)]
    gap: Annotated[float, Accepts(LENGTH)]
    restitution: Annotated[float, Accepts(DIMENSIONLESS, above=0.0, maximum=1.0)]
    mass: Annotated[float | None, Accepts(MASS, above=0.0, optional=True)] = None

    @takes_fields
    def __init__(
        self,
        stiffness: float | str,
        gap: float | str,
        restitution: float | str,
        mass: float | str | None = None,
    ) -> None: ...

    @model_validator(mode="after")
    def _damped_finitely(self) -> Self:
        if not self.damping_ratio < math.inf:
            raise InputError(
                f"restitution: {self.restitution:g} gives an infinite damping; use a larger "
                "restitution, such as 0.5"
            )
        return self

    @property
    def damping_ratio(self) -> float:
        """Damping ratio ξ = (9√5/2) (1 - e²)/{e [e (9π - 16) + 16]}."""
        e = self.restitution
        below = e * (e * (9.0 * math.pi - 16.0) + 16.0)
        lost = 4.5 * math.sqrt(5.0) * (1.0 - e) * (1.0 + e)
        return lost / below if below else math.inf

    @classmethod
    def like(
        cls, force: float, depth: float, gap: float, restitution: float, omega: float, mass: float
    ) -> Self:
        """Return such a stop, a Hertz contact."""
        return cls(force / depth**1.5, gap, restitution, mass)

    def between(self, meeting_mass: float) -> Self:
        """Return the stop with the mass that hits it, if it has none of its own."""
        return self.replace(mass=meeting_mass) if self.mass is None else self

    def engine_numbers(self) -> PowerLaw:
        """Return the numbers by which the engine follows the law."""
        assert self.mass is not None  # which an oscillator requires
        viscous = 2.0 * self.damping_ratio * math.sqrt(self.mass * self.stiffness)
        return PowerLaw(self.stiffness, 1.5, 0.0, viscous, self.gap)

    def force(self, deformation: ArrayLike, velocity: ArrayLike) -> NDArray[np.float64]:
        """Return the force (N, at least 0) along a contact."""
        d, v = np.asarray(deformation, dtype=np.float64), np.asarray(velocity, dtype=np.float64)
        assert self.mass is not None  # which an oscillator requires
        damping = 2.0 * self.damping_ratio * np.sqrt(self.mass * self.stiffness * np.sqrt(d))
        return np.asarray(self.stiffness * d**1.5 + damping * np.maximum(v, 0.0))

    def stored_energy(self, deformation: float, memory: float | None = None) -> float:
        """Return the energy k δ^2.5/2.5 (J) of a deformation (m)."""
        return self.static_force(deformation) * deformation / 2.5

    def static_force(self, deformation: float) -> float:
        """Return the force k δ^1.5 (N) of a stop that is slowly compressed by a deformation (m)."""
        return float(self.stiffness * max(deformation, 0.0) ** 1.5)
