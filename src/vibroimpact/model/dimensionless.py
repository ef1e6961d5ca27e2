"""Physical parameters to dimensionless ones and back (the paper's Section 7).

With ω0 = √(K/M), for the stop on side j:

- stiffness ratio λ_j = K_j/K;
- relaxation time τ_j = ω0 C_j/K_j;
- gap δ0_j = G0_j/u_max, where u_max = A/(2ξ√(1-ξ²) ω0²) is the largest displacement
  amplitude in free flight, so that δ0_j = 1 just grazes;
- damping factor ξ = C/(2√(K M)).

A rigid stop is the limit λ_j → ∞; its restitution has no dimension as it is.

The paper's text calls δ the sum of both sides' gaps, but its Table 1 holds the gap of one
side. Here a gap is always that of one side.
"""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, NamedTuple, TypeAlias

from vibroimpact.errors import InputError
from vibroimpact.model.html_table import table
from vibroimpact.model.isolators import Isolator
from vibroimpact.model.law_registry import Kinds, Named
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.quantities import ACCELERATION, DIMENSIONLESS, MASS, STIFFNESS
from vibroimpact.model.rigs import takes_rig
from vibroimpact.model.stops import Bumper, RigidStop, Stop
from vibroimpact.model.units import pretty, to_si
from vibroimpact.model.validation import Accepts, Model, constructor

PerSide: TypeAlias = "float | str | tuple[float | str | None, float | str | None] | None"
"""One value for both sides, or a pair (right, left); None is a side without a bumper."""

_NO_DAMPING = 1e-150
"""A damping ratio below which the peak is larger than any number."""
_ALL_DAMPING = 1e100
"""Damping ratio from which on the mass moves with the base, to rounding."""


class Rig(NamedTuple):
    """An oscillator with the base acceleration that its gaps were scaled by.

    It unpacks: ``oscillator, amplitude = rig``.
    """

    oscillator: Oscillator
    amplitude: float
    """Peak base acceleration A in m/s²."""

    def __str__(self) -> str:
        return f"Rig(oscillator={self.oscillator}, amplitude={self.amplitude:.6g} m/s²)"

    def _repr_html_(self) -> str:
        shaken = ("amplitude", pretty(self.amplitude, ACCELERATION))
        return table("Rig", [*self.oscillator.rows(), shaken])


class DimensionlessBumper(Named):
    """One bumper in dimensionless parameters.

    Parameters
    ----------
    stiffness_ratio
        λ_j = K_j/K, greater than 0.
    gap
        δ0_j = G0_j/u_max; 1 is grazing, below 0 it is preloaded.
    relaxation_time
        τ_j = ω0 C_j/K_j, at least 0.

    Raises
    ------
    InputError
        If a value is not finite or lies outside its bounds.
    """

    kind: ClassVar[str] = Bumper.kind
    usual: ClassVar[bool] = True

    stiffness_ratio: Annotated[float, Accepts(DIMENSIONLESS, above=0.0)]
    gap: Annotated[float, Accepts(DIMENSIONLESS)]
    relaxation_time: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0)]

    @constructor
    def __init__(
        self, stiffness_ratio: float | str, gap: float | str, relaxation_time: float | str
    ) -> None:
        super().__init__(stiffness_ratio=stiffness_ratio, gap=gap, relaxation_time=relaxation_time)


class DimensionlessRigidStop(Named):
    """One rigid stop in dimensionless parameters.

    Parameters
    ----------
    restitution
        e_j, from 0 to 1.
    gap
        δ0_j = G0_j/u_max; 1 is grazing.

    Raises
    ------
    InputError
        If a value is not finite or lies outside its bounds.
    """

    kind: ClassVar[str] = RigidStop.kind

    restitution: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0, maximum=1.0)]
    gap: Annotated[float, Accepts(DIMENSIONLESS)]

    @constructor
    def __init__(self, restitution: float | str, gap: float | str) -> None:
        super().__init__(restitution=restitution, gap=gap)

    @property
    def stiffness_ratio(self) -> float:
        """λ_j, infinite."""
        return math.inf


DimensionlessStop: TypeAlias = DimensionlessBumper | DimensionlessRigidStop

_STOPS = Kinds(DimensionlessBumper, DimensionlessRigidStop)


class Dimensionless(Model):
    """An oscillator under a given base acceleration, in dimensionless parameters.

    Parameters
    ----------
    damping_ratio
        ξ = C/(2√(K M)), at least 0.
    right, left
        The stops, or None for a side without one.

    Raises
    ------
    InputError
        If a value is not finite or lies outside its bounds.
    """

    damping_ratio: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0)]
    right: Annotated[DimensionlessBumper | DimensionlessRigidStop | None, _STOPS] = None
    left: Annotated[DimensionlessBumper | DimensionlessRigidStop | None, _STOPS] = None

    @constructor
    def __init__(
        self,
        damping_ratio: float | str,
        right: DimensionlessStop | None = None,
        left: DimensionlessStop | None = None,
    ) -> None:
        super().__init__(damping_ratio=damping_ratio, right=right, left=left)

    def to_physical(
        self,
        *,
        mass: float | str = 1.0,
        stiffness: float | str = 1.0,
        amplitude: float | str = 1.0,
    ) -> Rig:
        """Return the physical rig with these dimensionless parameters.

        Parameters
        ----------
        mass
            M in kg, or text with units.
        stiffness
            The isolator's K in N/m, or text with units.
        amplitude
            Peak base acceleration A in m/s², or text with units. The gaps scale with it.

        Returns
        -------
        Rig
            The oscillator and the amplitude in m/s².

        Raises
        ------
        InputError
            If a value cannot be used, or if a gap is not 0 while free flight has no finite
            resonance peak to scale it by (see ``peak_displacement``).
        """
        m = to_si(mass, MASS, "mass", above=0.0)
        k = to_si(stiffness, STIFFNESS, "stiffness", above=0.0)
        a = to_si(amplitude, ACCELERATION, "amplitude", minimum=0.0)
        damping = 2.0 * self.damping_ratio * math.sqrt(k * m)
        free = Oscillator(m, Isolator(k, damping))

        def stop(side: DimensionlessStop | None) -> Stop | None:
            if side is None:
                return None
            # A gap of 0 is 0 at any scale, so it needs no resonance peak.
            gap = side.gap * _peak(m, k, self.damping_ratio, a) if side.gap else 0.0
            if isinstance(side, DimensionlessRigidStop):
                return RigidStop(side.restitution, gap)
            stiffness_j = side.stiffness_ratio * k
            damping_j = side.relaxation_time * stiffness_j / free.angular_frequency
            return Bumper(stiffness_j, damping_j, gap)

        return Rig(free.replace(right=stop(self.right), left=stop(self.left)), a)


def from_dimensionless(
    stiffness_ratio: PerSide,
    gap: PerSide,
    relaxation_time: PerSide,
    damping_ratio: float | str,
    *,
    mass: float | str = 1.0,
    stiffness: float | str = 1.0,
    amplitude: float | str = 1.0,
) -> Rig:
    """Return the physical rig with bumpers of the given dimensionless parameters.

    Parameters
    ----------
    stiffness_ratio
        λ = K_j/K: one number for both sides, or a pair (right, left). None, alone or in the
        pair, is a side without a bumper, whatever the gap and the relaxation time say.
    gap
        δ0 = G0_j/u_max of one side (1 is grazing); one number or a pair (right, left).
    relaxation_time
        τ = ω0 C_j/K_j; one number or a pair (right, left).
    damping_ratio
        ξ of the isolator.
    mass, stiffness, amplitude
        Scales: M in kg, the isolator's K in N/m, peak base acceleration A in m/s²; or texts
        with units. With the defaults ω0 is 1 rad/s, so a frequency ratio r is the frequency
        ``r * rig.oscillator.natural_frequency`` in Hz.

    Returns
    -------
    Rig
        ``oscillator, amplitude``: the gaps hold only at that amplitude.

    Raises
    ------
    InputError
        If a value cannot be used, or if a gap is not 0 while free flight has no finite
        resonance peak to scale it by (see ``peak_displacement``).

    Examples
    --------
    >>> oscillator, amplitude = from_dimensionless(20.0, 0.5, 0.01, 0.15)
    >>> oscillator.right == oscillator.left
    True
    >>> one_sided, _ = from_dimensionless((20.0, None), 0.5, 0.01, 0.15)
    >>> one_sided.left is None
    True
    """
    ratios = _pair(stiffness_ratio, "stiffness_ratio")
    gaps = _pair(gap, "gap")
    times = _pair(relaxation_time, "relaxation_time")
    sides = {
        side: None if ratio is None else {"stiffness_ratio": ratio, "gap": g, "relaxation_time": t}
        for side, ratio, g, t in zip(("right", "left"), ratios, gaps, times, strict=True)
    }
    group = Dimensionless.model_validate({"damping_ratio": damping_ratio, **sides})
    return group.to_physical(mass=mass, stiffness=stiffness, amplitude=amplitude)


@takes_rig
def to_dimensionless(oscillator: Oscillator, amplitude: float | str) -> Dimensionless:
    """Return the dimensionless parameters of an oscillator under a base acceleration.

    Parameters
    ----------
    oscillator
        The oscillator; or a case, its code or a study file, and then the amplitude may be left out.
    amplitude
        Peak base acceleration A in m/s², or text with units; it scales the gaps.

    Returns
    -------
    Dimensionless
        ξ, and of each side λ, δ0 and τ of its bumper, or e and δ0 of its rigid stop.

    Raises
    ------
    InputError
        If the isolator or a stop is not linear. If the amplitude cannot be used, or if a gap is
        not 0 while free flight has no finite resonance peak to scale it by (see
        ``peak_displacement``).
    """
    a = to_si(amplitude, ACCELERATION, "amplitude", minimum=0.0)
    oscillator.check_linear("dimensionless parameters")
    k = oscillator.isolator.initial_stiffness

    def side(stop: Stop | None) -> DimensionlessStop | None:
        if stop is None:
            return None
        gap = stop.gap / peak_displacement(oscillator, a) if stop.gap else 0.0
        if isinstance(stop, RigidStop):
            return DimensionlessRigidStop(stop.restitution, gap)
        assert isinstance(stop, Bumper)
        time = oscillator.angular_frequency * stop.damping / stop.stiffness
        return DimensionlessBumper(stop.stiffness / k, gap, time)

    return Dimensionless(oscillator.damping_ratio, side(oscillator.right), side(oscillator.left))


def peak_displacement(oscillator: Oscillator, amplitude: float | str) -> float:
    """Return the largest displacement amplitude in free flight, over all frequencies.

    u_max = A/(2ξ√(1-ξ²) ω0²), reached at ω = ω0√(1-2ξ²).

    Parameters
    ----------
    oscillator
        The oscillator; its stops are left out of account.
    amplitude
        Peak base acceleration A in m/s², or text with units.

    Returns
    -------
    float
        u_max in m.

    Raises
    ------
    InputError
        If the isolator is not linear. If the amplitude is 0, or if the damping ratio is 0 (the
        peak is unbounded) or at least 1/√2 (the displacement has no peak).
    """
    a = to_si(amplitude, ACCELERATION, "amplitude", minimum=0.0)
    oscillator.check_linear("free flight in closed form, whose peak scales gaps", stops=False)
    stiffness = oscillator.isolator.initial_stiffness
    return _peak(oscillator.mass, stiffness, oscillator.damping_ratio, a)


def largest_free_flight(
    angular_frequency: float, damping_ratio: float, amplitude: float
) -> tuple[float, float]:
    """Return the largest amplitudes in free flight, over all frequencies.

    Of the displacement A/(2ξ√(1-ξ²) ω0²) (see ``peak_displacement``), or A/ω0², which it comes
    close to at low frequencies, if ξ is at least 1/√2. Of the absolute acceleration
    A √(1 + 4ξ²r²)/√((1 - r²)² + 4ξ²r²) at r² = 2/(1 + √(1 + 8ξ²)).

    Parameters
    ----------
    angular_frequency
        ω0 in rad/s.
    damping_ratio
        ξ; with 0 both are infinite.
    amplitude
        Peak base acceleration A in m/s².

    Returns
    -------
    tuple of float
        In m and m/s².
    """
    xi, static = damping_ratio, amplitude / angular_frequency**2
    if xi < _NO_DAMPING:
        return math.inf, math.inf
    peaked = xi < math.sqrt(0.5)
    swing = static / (2.0 * xi * math.sqrt(1.0 - xi**2)) if peaked else static
    if xi > _ALL_DAMPING:
        return swing, amplitude
    square = 2.0 / (1.0 + math.sqrt(1.0 + 8.0 * xi**2))
    damped = 4.0 * xi**2 * square
    return swing, amplitude * math.sqrt((1.0 + damped) / ((1.0 - square) ** 2 + damped))


def _peak(mass: float, stiffness: float, damping_ratio: float, amplitude: float) -> float:
    if not 0.0 < damping_ratio < math.sqrt(0.5):
        raise InputError(
            f"damping_ratio: {damping_ratio:.6g} gives free flight no finite resonance peak, by "
            "which a gap that is not 0 is scaled; between 0 and 0.707107 is accepted"
        )
    if amplitude == 0.0:
        raise InputError(
            "amplitude: 0 moves nothing, so a gap that is not 0 has no scale; "
            "an acceleration greater than 0 is accepted"
        )
    peak, _ = largest_free_flight(math.sqrt(stiffness / mass), damping_ratio, amplitude)
    if not 0.0 < peak < math.inf:
        raise InputError(
            f"amplitude: {amplitude:g} m/s² moves a mass of {mass:g} kg on {stiffness:g} N/m by "
            "a distance outside the range of floating-point numbers; a moderate one is accepted"
        )
    return peak


def _pair(value: PerSide, field: str) -> tuple[float | str | None, float | str | None]:
    if isinstance(value, tuple | list):
        if len(value) != 2:
            raise InputError(
                f"{field}: {value!r} is not a pair; a number or a pair (right, left) is accepted"
            )
        return (value[0], value[1])
    return (value, value)
