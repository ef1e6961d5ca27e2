"""Base classes of isolators: a dashpot, and a restoring force."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator

from vibroimpact.errors import InputError
from vibroimpact.model.isolators.design import design, design_keys, force_of_strength
from vibroimpact.model.law_registry import Named
from vibroimpact.model.quantities import DAMPING, DIMENSIONLESS, FORCE, STIFFNESS, power_damping
from vibroimpact.model.units import pretty
from vibroimpact.model.validation import Accepts, constructor


class IsolatorLaw(Named):
    """Base of the isolators: a restoring force plus the viscous force ``c |v|^α sgn v``.

    A new law defines its `initial_stiffness` and its `static_force`, and where that force stops
    growing (`reach`) or is bounded (`strongest`).

    Attributes
    ----------
    damping
        c in N (s/m)^α, at least 0.
    damping_exponent
        α, greater than 0: 1 is a linear dashpot, 2 the drag of a turbulent fluid, less than 1 a
        fluid damper.
    """

    _quiet: ClassVar = {"damping_exponent": 1.0}

    designs: ClassVar[tuple[str, ...]] = ()
    """Constructors from what a designer knows of the isolator of a mass, such as its period; a
    table inside an `Oscillator` may hold their arguments instead of the fields."""

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
        """Whether the force is K u + C v."""
        return False

    @property
    def initial_stiffness(self) -> float:
        """Tangent stiffness at rest (N/m)."""
        raise NotImplementedError

    def static_force(self, displacement: float) -> float:
        """Return the force (N) after a first, slow displacement (m) from rest: an odd function."""
        raise NotImplementedError

    @property
    def remembers(self) -> bool:
        """Whether the force depends on a memory z as well as on displacement and velocity."""
        return False

    def remembered(self, displacement: float) -> float:
        """Return the memory z (m, see `State`) after a first loading to a displacement (m)."""
        return 0.0

    @property
    def reach(self) -> float:
        """Displacement (m) up to which the static force grows; ∞ if it grows without end."""
        return math.inf

    @property
    def strongest(self) -> float:
        """Largest static force within the reach (N); ∞ if it is unbounded."""
        return math.inf if self.reach == math.inf else self.static_force(self.reach)

    @property
    def linear_and_bounded(self) -> tuple[float, float] | None:
        """The static force as K u + q with ``|q|`` at most Q: (K, Q), or None."""
        return None

    @property
    def restoring_reach(self) -> float:
        """Displacement (m) up to which the elastic force is restoring; ∞ if everywhere."""
        return math.inf

    def viscous_force(self, velocity: float) -> float:
        """Return ``c |v|^α sgn v`` (N) at a velocity (m/s)."""
        return math.copysign(self.damping * abs(velocity) ** self.damping_exponent, velocity)

    @classmethod
    def table_keys(cls) -> list[str]:
        """Return the keys that a table of this law may hold."""
        return [*super().table_keys(), *design_keys(cls)]

    @classmethod
    def _designed(cls, by: str, made: dict[str, float], others: dict[str, Any]) -> Self:
        """Make an isolator from the numbers of a design and other fields."""
        for name in ("damping_exponent", *made):
            if name in others:
                raise InputError(f"{name}: given beside {by}; one of the two is accepted")
        return cls(**made, **others)


class SpringLaw(IsolatorLaw):
    """Base of the laws with a linear spring K."""

    designs: ClassVar[tuple[str, ...]] = ("from_period",)

    stiffness: Annotated[float, Accepts(STIFFNESS, minimum=0.0)]

    @constructor
    def __init__(self, /, **values: Any) -> None:
        super().__init__(**values)

    @classmethod
    def from_period(
        cls, mass: float | str, period: float | str, damping_ratio: float | str, **others: Any
    ) -> Self:
        """Return the isolator that gives a mass a period and a damping ratio.

        Parameters
        ----------
        mass
            What it carries, M in kg, greater than 0; or text such as ``"5000 t"``.
        period
            T of the linear spring in s, greater than 0; or text such as ``"2.5 s"``.
        damping_ratio
            ξ of the parallel dashpot, at least 0; or text such as ``"15 %"``.
        **others
            Other fields of the law.

        Returns
        -------
        IsolatorLaw
            K = M (2π/T)² and C = 2 ξ M 2π/T.

        Raises
        ------
        InputError
            If a value is not finite, has a wrong unit or lies outside its bounds, or is determined
            by the period.

        Examples
        --------
        >>> building = Oscillator("5000 t", Isolator.from_period("5000 t", "2.5 s", 0.15))
        >>> round(1.0 / building.natural_frequency, 12), round(building.damping_ratio, 12)
        (2.5, 0.15)
        """
        m, t, xi = design(mass=mass, period=period, damping_ratio=damping_ratio)
        return cls._designed("period", spring_and_dashpot(m, t, xi), others)

    @property
    def initial_stiffness(self) -> float:
        """K, N/m."""
        return self.stiffness


def spring_and_dashpot(mass: float, period: float, damping_ratio: float) -> dict[str, float]:
    """Return the K (N/m) and C (N s/m) that give a mass (kg) a period (s) and a damping ratio."""
    omega = math.tau / period
    return {"stiffness": mass * omega**2, "damping": 2.0 * damping_ratio * mass * omega}


class YieldingLaw(IsolatorLaw):
    """Base of the laws with a spring k_p parallel to a yielding element of stiffness k_e - k_p.

    The force is k_p u + (k_e - k_p) z; the law defines the evolution of z.
    """

    designs: ClassVar[tuple[str, ...]] = ("from_strength",)

    elastic_stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    post_yield_stiffness: Annotated[float, Accepts(STIFFNESS, minimum=0.0)]
    yield_force: Annotated[float, Accepts(FORCE, above=0.0)]

    @constructor
    def __init__(self, /, **values: Any) -> None:
        super().__init__(**values)

    @classmethod
    def from_strength(
        cls,
        mass: float | str,
        strength: float | str,
        yield_displacement: float | str,
        post_yield_period: float | str,
        post_yield_damping_ratio: float | str = 0.0,
        **others: Any,
    ) -> Self:
        """Return the isolator with the design values of a lead-rubber bearing.

        Parameters
        ----------
        mass
            What it carries, M in kg, greater than 0; or text such as ``"5000 t"``.
        strength
            Characteristic strength Q_d, the force at zero displacement of a loop, as a share of
            the weight M g from 0 to 1, 0 excluded; or as a force, in text such as ``"2.5 MN"``.
        yield_displacement
            u_y in m, greater than 0; or text such as ``"10 mm"``.
        post_yield_period
            T_p in s, greater than 0: period of the mass on the post-yield stiffness alone; or text
            such as ``"2.5 s"``.
        post_yield_damping_ratio
            ξ_p of the dashpot, at least 0, relative to the post-yield period. Yielding dissipates
            far more.
        **others
            Other fields of the law.

        Returns
        -------
        YieldingLaw
            k_p = M (2π/T_p)², F_y = Q_d + k_p u_y, k_e = F_y/u_y and C = 2 ξ_p M 2π/T_p (Naeim
            and Kelly, Design of Seismic Isolated Structures, 1999, ch. 5).

        Raises
        ------
        InputError
            If a value is not finite, has a wrong unit or lies outside its bounds, or is determined
            by the strength.

        Examples
        --------
        >>> bearing = BilinearIsolator.from_strength("5000 t", 0.05, "10 mm", "2.5 s")
        >>> round((bearing.yield_force - bearing.post_yield_stiffness * 0.01) / 5e6 / 9.80665, 12)
        0.05
        """
        m, u, t, xi = design(
            mass=mass,
            yield_displacement=yield_displacement,
            post_yield_period=post_yield_period,
            post_yield_damping_ratio=post_yield_damping_ratio,
        )
        spring = spring_and_dashpot(m, t, xi)
        force = force_of_strength(m, strength) + spring["stiffness"] * u
        made = {
            "elastic_stiffness": force / u,
            "post_yield_stiffness": spring["stiffness"],
            "yield_force": force,
            "damping": spring["damping"],
        }
        return cls._designed("strength", made, others)

    @model_validator(mode="after")
    def _yields(self) -> Self:
        """Raise an error for a law that hardens where it yields, or never yields."""
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
        """Yield displacement u_y = F_y/k_e (m)."""
        return self.yield_force / self.elastic_stiffness

    @property
    def hysteretic_stiffness(self) -> float:
        """Stiffness of the yielding element, k_e - k_p (N/m)."""
        return self.elastic_stiffness - self.post_yield_stiffness

    @property
    def initial_stiffness(self) -> float:
        """k_e, N/m."""
        return self.elastic_stiffness

    @property
    def linear_and_bounded(self) -> tuple[float, float]:
        """The pair of k_p, and (k_e - k_p) times the limit of z."""
        return self.post_yield_stiffness, self.hysteretic_stiffness * self.hysteretic_limit

    @property
    def hysteretic_limit(self) -> float:
        """Upper bound of ``|z|`` (m)."""
        return self.yield_displacement

    def static_force(self, displacement: float) -> float:
        """Return the force (N) of a first loading to a displacement (m): k_p u + (k_e - k_p) z."""
        held = self.hysteretic_stiffness * self._loaded(displacement)
        return self.post_yield_stiffness * displacement + held

    @property
    def remembers(self) -> bool:
        """Whether a part of the isolator yields."""
        return self.hysteretic_stiffness > 0.0

    def remembered(self, displacement: float) -> float:
        """Return the memory z (m) after a first loading to a displacement (m), or 0."""
        return self._loaded(displacement) if self.hysteretic_stiffness else 0.0

    def _loaded(self, displacement: float) -> float:
        """Return the z (m) of a first loading."""
        raise NotImplementedError
