"""What every isolator has: a dashpot, and a restoring force of its own."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator

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

    @property
    def remembers(self) -> bool:
        """Whether its force depends on more than displacement and velocity: on a memory z."""
        return False

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


class YieldingLaw(IsolatorLaw):
    """A spring k_p beside an element of stiffness k_e - k_p that yields.

    Its force is k_p u + (k_e - k_p) z; how z moves is the law's own.
    """

    elastic_stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    post_yield_stiffness: Annotated[float, Accepts(STIFFNESS, minimum=0.0)]
    yield_force: Annotated[float, Accepts(FORCE, above=0.0)]

    @constructor
    def __init__(self, /, **values: Any) -> None:
        super().__init__(**values)

    @model_validator(mode="after")
    def _yields(self) -> Self:
        """Refuse a law that hardens where it yields, or yields nowhere."""
        if self.post_yield_stiffness > self.elastic_stiffness:
            raise InputError(
                f"post_yield_stiffness: {pretty(self.post_yield_stiffness, STIFFNESS)} is greater "
                f"than elastic_stiffness, {pretty(self.elastic_stiffness, STIFFNESS)}; "
                "at most that is accepted"
            )
        if not 0.0 < self.yield_displacement < math.inf:
            raise InputError(
                f"yield_force: {pretty(self.yield_force, FORCE)} over elastic_stiffness, "
                f"{pretty(self.elastic_stiffness, STIFFNESS)}, is a yield displacement outside the "
                "range of floating-point numbers; moderate values are accepted"
            )
        return self

    @property
    def yield_displacement(self) -> float:
        """u_y = F_y/k_e in m."""
        return self.yield_force / self.elastic_stiffness

    @property
    def hysteretic_stiffness(self) -> float:
        """k_e - k_p, N/m: that of the element that yields."""
        return self.elastic_stiffness - self.post_yield_stiffness

    @property
    def initial_stiffness(self) -> float:
        """k_e, N/m."""
        return self.elastic_stiffness

    def static_force(self, displacement: float) -> float:
        """Force in N of a first loading to a displacement in m: k_p u + (k_e - k_p) z."""
        held = self.hysteretic_stiffness * self._loaded(displacement)
        return self.post_yield_stiffness * displacement + held

    @property
    def remembers(self) -> bool:
        """Whether anything of it yields."""
        return self.hysteretic_stiffness > 0.0

    def remembered(self, displacement: float) -> float:
        """Its memory z (m) after a first loading to a displacement (m); 0 if nothing can yield."""
        return self._loaded(displacement) if self.hysteretic_stiffness else 0.0

    def _loaded(self, displacement: float) -> float:
        """The z (m) of a first loading."""
        raise NotImplementedError
