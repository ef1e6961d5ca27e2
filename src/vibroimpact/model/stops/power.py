"""Power-law contacts, such as the contact of Hertz, with the damping of Hunt and Crossley."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import model_validator

from vibroimpact.errors import InputError
from vibroimpact.law_numbers import PowerLaw
from vibroimpact.model.quantities import (
    DIMENSIONLESS,
    DISSIPATION,
    LENGTH,
    STIFFNESS,
    power_stiffness,
)
from vibroimpact.model.stops.dissipation import Relation, dissipation_number
from vibroimpact.model.stops.law import StopLaw
from vibroimpact.model.validation import Accepts, takes_fields

_EXPONENT = replace(DIMENSIONLESS, example="1.5", number=1.5)


class PowerBumper(StopLaw):
    """A massless stop whose force is a power of its deformation (Hertz, Hunt and Crossley).

    The force is F = k δⁿ (1 + χ δ') for δ > 0, and never less than 0. δ is the penetration depth of
    the mass. n = 1.5 is the contact of Hertz between curved surfaces, and n = 1 is a spring.

    There are two ways to specify the dissipation: the coefficient χ, or the coefficient of
    restitution of impacts. In the second case each contact has its own χ = d/v₀, where v₀ is its
    closing speed and d follows from the coefficient of restitution. If neither is specified, the
    contact is elastic.

    A contact that does not start with an impact, such as the contact with a preloaded stop, has no
    closing speed. With a coefficient of restitution, such a contact is elastic until the mass has
    left the stop.

    In a study file, its ``kind`` is ``"power"``.

    Parameters
    ----------
    stiffness
        Stiffness k in N/mⁿ, greater than 0; or a string such as ``"2 GN/m^1.5"``.
    gap
        Distance from the mass at u = 0 to the undeformed stop, in m; or a string such as
        ``"7.5 mm"``. A negative gap is a preload.
    exponent
        Exponent n, at least 1. Default: 1.5.
    dissipation
        Dissipation coefficient χ in s/m, at least 0. Default: None, see above.
    restitution
        Coefficient of restitution e, from 0 to 1: the rebound velocity divided by the impact
        velocity, without other forces. Default: None, see above.
    relation
        Relation by which d is computed from e. ``"exact"`` (the default) gives exactly the
        restitution e. ``"hunt-crossley"``, ``"lankarani-nikravesh"``, ``"flores"`` and
        ``"gonthier"`` are approximations. ``"exact"``, ``"flores"`` and ``"gonthier"`` require an e
        greater than 0.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds. Also if both
        ``dissipation`` and ``restitution`` are passed.
    """

    kind: ClassVar[str] = "power"
    words: ClassVar[str] = "power law (Hertz)"
    _quiet: ClassVar = {"dissipation": None, "restitution": None, "relation": "exact"}

    # The exponent stands first, for the unit of the stiffness depends on it.
    exponent: Annotated[float, Accepts(_EXPONENT, minimum=1.0)] = 1.5
    stiffness: Annotated[
        float, Accepts(STIFFNESS, above=0.0, by="exponent", family=power_stiffness)
    ]
    gap: Annotated[float, Accepts(LENGTH)]
    dissipation: Annotated[float | None, Accepts(DISSIPATION, minimum=0.0, optional=True)] = None
    restitution: Annotated[
        float | None, Accepts(DIMENSIONLESS, minimum=0.0, maximum=1.0, optional=True)
    ] = None
    relation: str = "exact"

    @takes_fields
    def __init__(
        self,
        stiffness: float | str,
        gap: float | str,
        exponent: float | str = 1.5,
        dissipation: float | str | None = None,
        restitution: float | str | None = None,
        relation: Relation = "exact",
    ) -> None: ...

    @model_validator(mode="after")
    def _takes_energy_one_way(self) -> Self:
        if self.dissipation is not None and self.restitution is not None:
            raise InputError(
                f"dissipation: {self.dissipation:g} s/m is given together with a restitution of "
                f"{self.restitution:g}; remove one of the two"
            )
        dissipation_number(1.0 if self.restitution is None else self.restitution, self.relation)
        if self.restitution is None and self.relation != "exact":
            raise InputError(
                f"relation: {self.relation!r} is given without a restitution; add a restitution, "
                "or remove the relation"
            )
        return self

    @property
    def dissipation_number(self) -> float | None:
        """The number d = χ v₀ of all impacts. None if χ is specified: d then varies."""
        if self.dissipation is not None:
            return None
        return (
            0.0 if self.restitution is None else dissipation_number(self.restitution, self.relation)
        )

    @classmethod
    def like(
        cls, force: float, depth: float, gap: float, restitution: float, omega: float, mass: float
    ) -> Self:
        """Return such a stop, a Hertz contact."""
        return cls(force / depth**1.5, gap, restitution=restitution)

    def engine_numbers(self) -> PowerLaw:
        """Return the numbers by which the engine follows the law."""
        number = self.dissipation_number
        chi = self.dissipation if number is None else -number
        return PowerLaw(self.stiffness, self.exponent, chi or 0.0, 0.0, self.gap)

    def force(self, deformation: ArrayLike, velocity: ArrayLike) -> NDArray[np.float64]:
        """Return the force (N, at least 0) along a contact.

        The closing speed is the first velocity.
        """
        d, v = np.asarray(deformation, dtype=np.float64), np.asarray(velocity, dtype=np.float64)
        number, closing = self.dissipation_number, float(v[0])
        chi = self.dissipation if number is None else number / closing if closing else 0.0
        return np.maximum(self.stiffness * d**self.exponent * (1.0 + (chi or 0.0) * v), 0.0)

    def stored_energy(self, deformation: float, memory: float | None = None) -> float:
        """Return the energy k δⁿ⁺¹/(n + 1) (J) of a deformation (m)."""
        return self.static_force(deformation) * deformation / (self.exponent + 1.0)

    def static_force(self, deformation: float) -> float:
        """Return the force k δⁿ (N) of a stop that is slowly compressed by a deformation (m)."""
        return float(self.stiffness * max(deformation, 0.0) ** self.exponent)
