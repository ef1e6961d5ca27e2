"""Kelvin-Voigt bumper: a spring and a dashpot in parallel."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact.errors import DependentError, InputError
from vibroimpact.model.quantities import DAMPING, DIMENSIONLESS, LENGTH, MASS, STIFFNESS, TIME
from vibroimpact.model.restitution import damping_ratio
from vibroimpact.model.stops.law import StopLaw
from vibroimpact.model.units import pretty, to_si
from vibroimpact.model.validation import Accepts, takes_fields


class Bumper(StopLaw):
    """A massless deformable stop: a spring and a dashpot in parallel (Kelvin-Voigt).

    After a contact, the face keeps its deformation and relaxes with the time constant C_j/K_j.
    ``print`` shows it as ``memory``. A stop without memory is ``Law("max(k*d + c*v, 0)", gap)``.

    In a study file, its ``kind`` is ``"kelvin-voigt"``, which may be omitted.

    Parameters
    ----------
    stiffness
        Stiffness K_j in N/m, greater than 0; or a string such as ``"510 kN/m"``.
    damping
        Damping coefficient C_j in N s/m, at least 0; or a string such as ``"0.9 kN s/m"``.
    gap
        Gap G0_j in m, or a string such as ``"7.5 mm"``. It is the distance from the mass at u = 0
        to the undeformed bumper. The total gap of a symmetric rig is twice this gap. A negative gap
        is a preload: at u = 0 the bumper is compressed by this amount.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "kelvin-voigt"
    words: ClassVar[str] = "spring and dashpot"
    usual: ClassVar[bool] = True

    stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    damping: Annotated[float, Accepts(DAMPING, minimum=0.0)]
    gap: Annotated[float, Accepts(LENGTH)]

    @takes_fields
    def __init__(self, stiffness: float | str, damping: float | str, gap: float | str) -> None: ...

    @classmethod
    def from_restitution(
        cls,
        mass: float | str,
        stiffness: float | str,
        restitution: float | str,
        gap: float | str,
    ) -> Self:
        """Return the bumper whose dashpot gives a mass a coefficient of restitution.

        The coefficient applies to an impact of the mass on the undeformed bumper without other
        forces. The impact ends when the contact force falls to zero. In a rig, the forces of the
        isolator and the motion of the base change the restitution of a contact. The stiffer the
        bumper, the smaller is this change.

        Parameters
        ----------
        mass
            Mass M in kg, greater than 0; or a string such as ``"550 kg"``.
        stiffness
            Stiffness K_j in N/m, greater than 0; or a string such as ``"510 kN/m"``.
        restitution
            Coefficient of restitution (rebound velocity divided by impact velocity), greater than 0
            and at most 1. At 1 the bumper has no dashpot.
        gap
            Gap G0_j in m; or a string such as ``"7.5 mm"``.

        Returns
        -------
        Bumper
            Bumper with C_j = 2 z √(K_j M), where z follows from Schwager and Pöschel, Granular
            Matter 9 (2007) 465.

        Raises
        ------
        InputError
            If a value is not finite, has a wrong unit or lies outside its bounds.

        Examples
        --------
        >>> Bumper.from_restitution("550 kg", "510 kN/m", 1, "7.5 mm").damping
        0.0
        """
        m = to_si(mass, MASS, "mass", above=0.0)
        k = to_si(stiffness, STIFFNESS, "stiffness", above=0.0)
        e = to_si(restitution, DIMENSIONLESS, "restitution", above=0.0, maximum=1.0)
        return cls(k, 2.0 * damping_ratio(e) * math.sqrt(k) * math.sqrt(m), gap)

    @classmethod
    def _table_keys(cls) -> list[str]:
        """Return the keys that a table of this stop may have."""
        return [*super()._table_keys(), "restitution"]

    def _read(self) -> Iterator[tuple[str, Any, str]]:
        yield from super()._read()
        if self.damping:
            yield "memory", self.relaxation_time, pretty(self.relaxation_time, TIME)

    @property
    def linear(self) -> bool:
        """Whether the force is linear in the deformation d and its rate d': K_j d + C_j d'."""
        return True

    @classmethod
    def like(
        cls, force: float, depth: float, gap: float, restitution: float, omega: float, mass: float
    ) -> Self:
        """Return such a stop, with a τ of 0.01, as the published rig."""
        return cls(force / depth, 0.01 * force / depth / omega, gap)

    @property
    def spring_and_dashpot(self) -> tuple[float, float]:
        """The pair (K_j, C_j)."""
        return self.stiffness, self.damping

    def engine_numbers(self) -> tuple[float, float, float]:
        """Return K_j (N/m), C_j (N s/m) and the gap (m)."""
        return self.stiffness, self.damping, self.gap

    def force(self, deformation: ArrayLike, velocity: ArrayLike) -> NDArray[np.float64]:
        """Return the force (N, at least 0) along a contact."""
        d, v = np.asarray(deformation, dtype=np.float64), np.asarray(velocity, dtype=np.float64)
        return np.maximum(self.stiffness * d + self.damping * v, 0.0)

    def summary(self) -> str:
        """Return the law in one line, with its numbers."""
        k, c = pretty(self.stiffness, STIFFNESS), pretty(self.damping, DAMPING)
        return f"K = {k}, C = {c}, gap {pretty(self.gap, LENGTH)}"

    @property
    def relaxation_time(self) -> float:
        """Time constant C_j/K_j (s) with which the face relaxes after a contact: its memory."""
        return self.damping / self.stiffness

    def static_force(self, deformation: float) -> float:
        """Return the force (N) of a bumper that is slowly compressed by a deformation (m)."""
        return self.stiffness * max(deformation, 0.0)


def returning(table: Mapping[str, Any], mass: float | None) -> Mapping[str, Any]:
    """Return a table with the damping that gives its ``restitution``, for a mass (kg).

    Raises
    ------
    InputError
        If the table also has a damping, or the restitution is invalid. `DependentError` if only
        the mass is.
    """
    if "restitution" not in table:
        return table
    if "damping" in table:
        raise InputError("restitution: this bumper also has a damping; remove one of the two")
    if mass is None:
        raise DependentError(
            "restitution: it requires a valid mass of the oscillator; set the mass, such as "
            '"550 kg"'
        )
    rest = {name: value for name, value in table.items() if name != "restitution"}
    if "stiffness" not in rest:
        return {**rest, "damping": 0.0}  # it is missed by who reads the table
    made = Bumper.from_restitution(mass, rest["stiffness"], table["restitution"], 0.0)
    return {**rest, "damping": made.damping}
