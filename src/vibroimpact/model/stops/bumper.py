"""A spring and a dashpot in parallel: the bumper of Kelvin and Voigt."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Self

from vibroimpact.errors import InputError
from vibroimpact.model.law_registry import Named
from vibroimpact.model.quantities import DAMPING, DIMENSIONLESS, LENGTH, MASS, STIFFNESS
from vibroimpact.model.restitution import damping_ratio
from vibroimpact.model.units import to_si
from vibroimpact.model.validation import Accepts, constructor


class Bumper(Named):
    """A massless deformable stop: spring and dashpot in parallel (Kelvin-Voigt).

    Its kind, ``"kelvin-voigt"``, need not be named in a table.

    Parameters
    ----------
    stiffness
        K_j in N/m, greater than 0; or text such as ``"510 kN/m"``.
    damping
        C_j in N s/m, at least 0; or text such as ``"0.9 kN s/m"``.
    gap
        G0_j in m: the distance from the mass at u = 0 to the bumper at rest; or text such as
        ``"7.5 mm"``. The total gap of a symmetric rig is twice as large. Below 0 the bumper is
        preloaded: at u = 0 it is pressed by that much.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "kelvin-voigt"
    usual: ClassVar[bool] = True

    stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    damping: Annotated[float, Accepts(DAMPING, minimum=0.0)]
    gap: Annotated[float, Accepts(LENGTH)]

    @constructor
    def __init__(self, stiffness: float | str, damping: float | str, gap: float | str) -> None:
        super().__init__(stiffness=stiffness, damping=damping, gap=gap)

    @classmethod
    def from_restitution(
        cls,
        mass: float | str,
        stiffness: float | str,
        restitution: float | str,
        gap: float | str,
    ) -> Self:
        """Return the bumper with the dashpot that makes impacts return a given restitution.

        The impact is that of the mass against the bumper at rest while nothing else acts, and
        ends when the contact force falls to zero. The isolator and the base change the return of
        a real contact the less, the stiffer the bumper is.

        Parameters
        ----------
        mass
            M in kg, greater than 0; or text such as ``"550 kg"``.
        stiffness
            K_j in N/m, greater than 0; or text such as ``"510 kN/m"``.
        restitution
            Velocity of return over velocity of impact, above 0 and at most 1; 1 needs no dashpot.
        gap
            G0_j in m; or text such as ``"7.5 mm"``.

        Returns
        -------
        Bumper
            With C_j = 2 z √(K_j M), z from Schwager and Pöschel, Granular Matter 9 (2007) 465.

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
    def table_keys(cls) -> list[str]:
        """What a table of it may hold."""
        return [*super().table_keys(), "restitution"]

    @property
    def linear(self) -> bool:
        """Whether its force is K_j d + C_j d'."""
        return True

    def static_force(self, deformation: float) -> float:
        """Force in N of a bumper that is slowly pressed by a deformation in m."""
        return self.stiffness * max(deformation, 0.0)


def returning(table: Mapping[str, Any], mass: float | None) -> Mapping[str, Any]:
    """A table with the damping that a ``restitution`` in its place asks for, for a mass in kg.

    Raises
    ------
    InputError
        If it stands beside a damping, or cannot be used.
    """
    if "restitution" not in table:
        return table
    if "damping" in table:
        raise InputError("restitution: given beside damping; one of the two is accepted")
    if mass is None:
        raise InputError("restitution: needs a mass to go with; a mass is accepted")
    rest = {name: value for name, value in table.items() if name != "restitution"}
    if "stiffness" not in rest:
        return {**rest, "damping": 0.0}  # it is missed by who reads the table
    made = Bumper.from_restitution(mass, rest["stiffness"], table["restitution"], 0.0)
    return {**rest, "damping": made.damping}
