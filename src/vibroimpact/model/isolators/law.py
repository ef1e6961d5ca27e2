"""What every isolator has: a dashpot, and a restoring force of its own."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, Protocol

from vibroimpact.errors import InputError
from vibroimpact.model.kinds import Named
from vibroimpact.model.quantities import DAMPING, DIMENSIONLESS, FORCE, STIFFNESS, power_damping
from vibroimpact.model.units import pretty
from vibroimpact.model.validation import Accepts, constructor


class IsolatorLaw(Named):
    """Base of the isolators: a restoring force beside the viscous force c |v|^α sgn v.

    A new law says its `initial_stiffness` and its `static_force`, and where that force ends to grow
    (`reach`) or is bounded (`strongest`).

    Attributes
    ----------
    damping
        c in N (s/m)^α, at least 0.
    damping_exponent
        α, greater than 0: 1 is a linear dashpot, 2 the drag of a turbulent fluid, less than 1 a
        fluid damper.
    """

    _quiet: ClassVar = {"damping_exponent": 1.0}

    # The exponent stands first, for the unit of the damping depends on it.
    damping_exponent: Annotated[float, Accepts(DIMENSIONLESS, above=0.0)] = 1.0
    damping: Annotated[
        float, Accepts(DAMPING, minimum=0.0, by="damping_exponent", family=power_damping)
    ]

    @constructor
    def __init__(self, /, **values: Any) -> None:
        super().__init__(**values)

    @property
    def linear(self) -> bool:
        """Whether its force is K u + C v."""
        return False

    @property
    def initial_stiffness(self) -> float:
        """Tangent stiffness at rest, N/m."""
        raise NotImplementedError

    def static_force(self, displacement: float) -> float:
        """Force (N) after a first, slow displacement (m) from rest: an odd function."""
        raise NotImplementedError

    def remembered(self, displacement: float) -> float:
        """Its memory z (m, see `State.isolator`) after a first loading to a displacement (m)."""
        return 0.0

    @property
    def reach(self) -> float:
        """Displacement (m) up to which the static force grows; ∞ if it grows on and on."""
        return math.inf

    @property
    def strongest(self) -> float:
        """What the static force does not exceed within the reach, N; ∞ if it is unbounded."""
        return math.inf if self.reach == math.inf else self.static_force(self.reach)

    @property
    def restoring_reach(self) -> float:
        """Displacement (m) up to which its elastic part pushes back to rest; ∞ if everywhere."""
        return math.inf

    def viscous_force(self, velocity: float) -> float:
        """The c |v|^α sgn v in N, at a velocity in m/s."""
        return math.copysign(self.damping * abs(velocity) ** self.damping_exponent, velocity)


class Yielding(Protocol):
    """A law with an elastic and a post-yield stiffness."""

    @property
    def elastic_stiffness(self) -> float:
        """Before yielding, N/m."""

    @property
    def post_yield_stiffness(self) -> float:
        """After it, N/m."""

    @property
    def yield_force(self) -> float:
        """Where it yields, N."""


def check_yielding(law: Yielding) -> None:
    """Refuse a law that hardens where it yields, or yields nowhere.

    Raises
    ------
    InputError
        If the post-yield stiffness is above the elastic one, or the yield displacement is no
        number.
    """
    if law.post_yield_stiffness > law.elastic_stiffness:
        raise InputError(
            f"post_yield_stiffness: {pretty(law.post_yield_stiffness, STIFFNESS)} is greater than "
            f"elastic_stiffness, {pretty(law.elastic_stiffness, STIFFNESS)}; "
            "at most that is accepted"
        )
    if not 0.0 < law.yield_force / law.elastic_stiffness < math.inf:
        raise InputError(
            f"yield_force: {pretty(law.yield_force, FORCE)} over elastic_stiffness, "
            f"{pretty(law.elastic_stiffness, STIFFNESS)}, is a yield displacement outside the "
            "range of floating-point numbers; moderate values are accepted"
        )
