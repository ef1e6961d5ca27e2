"""Base classes of isolators, which have a restoring force and a dashpot."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import model_validator

from vibroimpact.errors import InputError
from vibroimpact.law_numbers import IsolatorNumbers
from vibroimpact.model.isolators.design import design, design_keys, force_of_strength
from vibroimpact.model.law_registry import Named
from vibroimpact.model.quantities import DAMPING, DIMENSIONLESS, FORCE, STIFFNESS, power_damping
from vibroimpact.model.units import pretty
from vibroimpact.model.validation import Accepts


class IsolatorLaw(Named):
    """Base class of the isolators: a restoring force plus the viscous force ``c |v|^α sgn v``.

    A new law has a ``kind`` and its fields, defines its `initial_stiffness`, its `static_force` and
    its `engine_numbers`, and is an entry of `ISOLATORS`. If the static force stops growing, it also
    defines the displacement where it does (`reach`). If the force is bounded, it also defines the
    bound (`strongest`). If it depends on the path, it also defines `_restoring`.

    Attributes
    ----------
    damping
        Damping coefficient c in N (s/m)^α, at least 0.
    damping_exponent
        Exponent α, greater than 0. It is 1 for a linear dashpot, 2 for the drag of a turbulent
        fluid, and less than 1 for a fluid damper.
    """

    _quiet: ClassVar = {"damping_exponent": 1.0}

    designs: ClassVar[tuple[str, ...]] = ()
    """Names of constructors from design values, such as the period. A table inside an `Oscillator`
    may have their arguments instead of the fields."""

    # The exponent stands first, for the unit of the damping depends on it.
    damping_exponent: Annotated[float, Accepts(DIMENSIONLESS, above=0.0)] = 1.0
    damping: Annotated[
        float, Accepts(DAMPING, minimum=0.0, by="damping_exponent", family=power_damping)
    ]

    @property
    def is_stop(self) -> bool:
        """Whether the law is a stop: always false."""
        return False

    @property
    def linear(self) -> bool:
        """Whether the force is K u + C v."""
        return False

    @property
    def initial_stiffness(self) -> float:
        """Tangent stiffness at rest (N/m)."""
        raise NotImplementedError

    def static_force(self, displacement: float) -> float:
        """Return the force (N) of a first, slow displacement (m) from rest: an odd function."""
        raise NotImplementedError

    def stored_energy(self, displacement: float, memory: float = 0.0) -> float:
        """Return the energy (J) of the springs at a displacement (m) and a memory z (m)."""
        raise NotImplementedError

    @property
    def remembers(self) -> bool:
        """Whether the force also depends on an internal variable z (memory)."""
        return False

    def remembered(self, displacement: float) -> float:
        """Return the memory z (m, see `State`) after a first loading to a displacement (m)."""
        return 0.0

    @property
    def reach(self) -> float:
        """Displacement (m) up to which the static force grows; ∞ if it always grows."""
        return math.inf

    @property
    def strongest(self) -> float:
        """Largest static force within the reach (N); ∞ if it is unbounded."""
        return math.inf if self.reach == math.inf else self.static_force(self.reach)

    @property
    def linear_and_bounded(self) -> tuple[float, float] | None:
        """The pair (K, Q) if the static force is K u + q with ``|q|`` at most Q; otherwise None."""
        return None

    @property
    def restoring_reach(self) -> float:
        """Displacement (m) up to which the elastic force is restoring; ∞ if it always is."""
        return math.inf

    def engine_numbers(self) -> tuple[float, float, IsolatorNumbers]:
        """Return K (N/m), C (N (s/m)^α) and what the isolator does besides."""
        raise NotImplementedError

    @classmethod
    def like(cls, stiffness: float, damping: float, displacement: float) -> Self | None:
        """Return such an isolator, about as strong as another one, if the law has an example.

        Parameters
        ----------
        stiffness
            Static force over displacement (N/m) at the displacement (m).
        damping
            Damping coefficient (N s/m).
        displacement
            Displacement in m.
        """
        return None

    @property
    def sticks(self) -> bool:
        """Whether the mass can come to rest away from the equilibrium."""
        return False

    def force(
        self, displacement: ArrayLike, direction: ArrayLike, velocity: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return the force (N) along a path that starts at rest.

        It is computed step by step, independently of the engine.

        Parameters
        ----------
        displacement
            Displacements along the path in m, starting with 0. They must be so dense that the
            motion reverses only at samples.
        direction
            Direction of the motion at each sample, of which only the sign is used.
        velocity
            Velocity in m/s, which determines the force of the dashpot.
        """
        u = np.asarray(displacement, dtype=np.float64)
        v = np.broadcast_to(np.asarray(velocity, dtype=np.float64), u.shape)
        viscous = self.damping * np.abs(v) ** self.damping_exponent * np.sign(v)
        signs = np.sign(np.asarray(direction)).tolist()
        return np.fromiter(self._restoring(u.tolist(), signs), np.float64, len(u)) + viscous

    def _restoring(self, displacement: list[float], sign: list[float]) -> Iterator[float]:
        """Yield the force (N) without the dashpot at each sample of a path."""
        yield from map(self.static_force, displacement)

    def viscous_force(self, velocity: float) -> float:
        """Return ``c |v|^α sgn v`` (N) at a velocity (m/s)."""
        return math.copysign(self.damping * abs(velocity) ** self.damping_exponent, velocity)

    @classmethod
    def _table_keys(cls) -> list[str]:
        """Return the keys that a table of this law may have."""
        return [*super()._table_keys(), *design_keys(cls)]

    @classmethod
    def _designed(cls, by: str, made: dict[str, float], others: dict[str, Any]) -> Self:
        """Make an isolator from the numbers of a design and other fields."""
        for name in ("damping_exponent", *made):
            if name in others:
                raise InputError(f"{name}: given together with {by}; remove one of the two")
        return cls(**made, **others)


class SpringLaw(IsolatorLaw):
    """Base class of the laws with a linear spring K."""

    designs: ClassVar[tuple[str, ...]] = ("from_period",)

    stiffness: Annotated[float, Accepts(STIFFNESS, minimum=0.0)]

    @classmethod
    def from_period(
        cls, mass: float | str, period: float | str, damping_ratio: float | str, **others: Any
    ) -> Self:
        """Return the isolator that gives a mass a natural period and a damping ratio.

        Parameters
        ----------
        mass
            Mass M on the isolator in kg, greater than 0; or a string such as ``"5000 t"``.
        period
            Natural period T of the mass on the linear spring in s, greater than 0; or a string such
            as ``"2.5 s"``.
        damping_ratio
            Damping ratio ξ of the parallel dashpot, at least 0; or a string such as ``"15 %"``.
        **others
            Other fields of the law.

        Returns
        -------
        IsolatorLaw
            Isolator with K = M (2π/T)² and C = 2 ξ M 2π/T.

        Raises
        ------
        InputError
            If a value is not finite, has a wrong unit or lies outside its bounds. Also if one of
            the other fields is already determined by the period.

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
        """Stiffness K (N/m)."""
        return self.stiffness

    def stored_energy(self, displacement: float, memory: float = 0.0) -> float:
        """Return the energy K u²/2 (J) at a displacement (m)."""
        return 0.5 * self.stiffness * displacement**2


def spring_and_dashpot(mass: float, period: float, damping_ratio: float) -> dict[str, float]:
    """Return the K (N/m) and C (N s/m) that give a mass (kg) a period (s) and a damping ratio."""
    omega = math.tau / period
    return {"stiffness": mass * omega**2, "damping": 2.0 * damping_ratio * mass * omega}


class YieldingLaw(IsolatorLaw):
    """Base class of the laws with a spring k_p parallel to a yielding element.

    The stiffness of the yielding element is k_e - k_p. The force is k_p u + (k_e - k_p) z. Each law
    defines how z evolves.
    """

    designs: ClassVar[tuple[str, ...]] = ("from_strength",)

    elastic_stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    post_yield_stiffness: Annotated[
        float, Accepts(STIFFNESS, minimum=0.0, meaning="post-yield stiffness")
    ]
    yield_force: Annotated[float, Accepts(FORCE, above=0.0)]

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
            Mass M on the isolator in kg, greater than 0; or a string such as ``"5000 t"``.
        strength
            Characteristic strength Q_d: the force of a hysteresis loop at zero displacement. A
            number is a share of the weight M g, greater than 0 and at most 1. A text such as
            ``"2.5 MN"`` is a force.
        yield_displacement
            Yield displacement u_y in m, greater than 0; or a string such as ``"10 mm"``.
        post_yield_period
            Natural period T_p of the mass on the post-yield stiffness alone, in s, greater than 0;
            or a string such as ``"2.5 s"``.
        post_yield_damping_ratio
            Damping ratio ξ_p of the dashpot at the post-yield period, at least 0. Yielding
            dissipates far more energy than this dashpot. Default: 0.
        **others
            Other fields of the law.

        Returns
        -------
        YieldingLaw
            Isolator with k_p = M (2π/T_p)², F_y = Q_d + k_p u_y, k_e = F_y/u_y and C = 2 ξ_p M
            2π/T_p (Naeim and Kelly, Design of Seismic Isolated Structures, 1999, ch. 5).

        Raises
        ------
        InputError
            If a value is not finite, has a wrong unit or lies outside its bounds. Also if one of
            the other fields is already determined by the strength.

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
                f"than elastic_stiffness, {pretty(self.elastic_stiffness, STIFFNESS)}; reduce "
                "post_yield_stiffness, or increase elastic_stiffness"
            )
        if not 0.0 < self.yield_displacement < math.inf:
            raise InputError(
                f"yield_force: {pretty(self.yield_force, FORCE)} divided by elastic_stiffness, "
                f"{pretty(self.elastic_stiffness, STIFFNESS)}, gives a yield displacement outside "
                "the range of floating-point numbers; correct the two values or their units"
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
        """Elastic stiffness k_e (N/m)."""
        return self.elastic_stiffness

    @property
    def linear_and_bounded(self) -> tuple[float, float]:
        """The pair of k_p and (k_e - k_p) times the limit of z."""
        return self.post_yield_stiffness, self.hysteretic_stiffness * self.hysteretic_limit

    @property
    def hysteretic_limit(self) -> float:
        """Upper bound of ``|z|`` (m)."""
        return self.yield_displacement

    def static_force(self, displacement: float) -> float:
        """Return the force (N) of a first loading to a displacement (m): k_p u + (k_e - k_p) z."""
        held = self.hysteretic_stiffness * self._loaded(displacement)
        return self.post_yield_stiffness * displacement + held

    def stored_energy(self, displacement: float, memory: float = 0.0) -> float:
        """Return the energy (k_p u² + (k_e - k_p) z²)/2 (J)."""
        yielding = self.hysteretic_stiffness * memory**2
        return 0.5 * (self.post_yield_stiffness * displacement**2 + yielding)

    @property
    def remembers(self) -> bool:
        """Whether a part of the isolator yields."""
        return self.hysteretic_stiffness > 0.0

    def remembered(self, displacement: float) -> float:
        """Return the memory z (m) after a first loading to a displacement (m), or 0."""
        return self._loaded(displacement) if self.hysteretic_stiffness else 0.0

    def _restoring(self, displacement: list[float], sign: list[float]) -> Iterator[float]:
        z = last = 0.0
        for u in displacement:
            step, last = u - last, u
            z = self._moved_on(z, step)
            yield self.post_yield_stiffness * u + self.hysteretic_stiffness * z

    def _moved_on(self, z: float, step: float) -> float:
        """Return the z (m) after a step of u (m)."""
        raise NotImplementedError

    def _loaded(self, displacement: float) -> float:
        """Return the z (m) of a first loading."""
        raise NotImplementedError
