"""Convert between physical and dimensionless parameters (the paper's Section 7).

With ω0 = √(K/M), the dimensionless parameters are, for the stop on side j:

- stiffness ratio λ_j = K_j/K;
- relaxation time τ_j = ω0 C_j/K_j;
- gap δ0_j = G0_j/u_max, where u_max = A/(2ξ√(1-ξ²) ω0²) is the largest displacement
  amplitude in free flight, so that δ0_j = 1 just grazes;
- damping factor ξ = C/(2√(K M)).

A rigid stop is the limit λ_j → ∞; its restitution is already dimensionless.

The paper's text defines δ as the sum of the gaps of both sides, but its Table 1 contains the gap of
one side. In this package a gap is always the gap of one side.
"""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, TypeAlias

from vibroimpact.errors import InputError
from vibroimpact.model.derived_parameters import scale_of
from vibroimpact.model.isolators import Isolator
from vibroimpact.model.largest_free_response import peak_displacement, peak_of
from vibroimpact.model.law_registry import Kinds, Named
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.public import public
from vibroimpact.model.quantities import ACCELERATION, DIMENSIONLESS, MASS, STIFFNESS
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.model.rig import Rig
from vibroimpact.model.stated_units import has_unit
from vibroimpact.model.stops import Bumper, RigidStop, Stop
from vibroimpact.model.system import Units
from vibroimpact.model.units import plain, to_si
from vibroimpact.model.validation import Accepts, Model, takes_fields
from vibroimpact.model.written_units import SI

PerSide: TypeAlias = "float | str | tuple[float | str | None, float | str | None] | None"
"""One value for both sides, or a pair (right, left). None is a side without a bumper."""


class DimensionlessBumper(Named):
    """Dimensionless parameters of one bumper.

    Parameters
    ----------
    stiffness_ratio
        λ_j = K_j/K, greater than 0.
    gap
        δ0_j = G0_j/u_max. At 1 the mass just grazes the bumper. A negative gap is a preload.
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

    @takes_fields
    def __init__(
        self, stiffness_ratio: float | str, gap: float | str, relaxation_time: float | str
    ) -> None: ...

    def summary(self) -> str:
        """Return λ, δ0 and τ in one line."""
        ratio, gap = plain(self.stiffness_ratio, 4), plain(self.gap, 4)
        return f"λ = {ratio}, δ0 = {gap}, τ = {plain(self.relaxation_time, 3)}"


class DimensionlessRigidStop(Named):
    """Dimensionless parameters of one rigid stop.

    Parameters
    ----------
    restitution
        e_j, from 0 to 1.
    gap
        δ0_j = G0_j/u_max. At 1 the mass just grazes the stop.

    Raises
    ------
    InputError
        If a value is not finite or lies outside its bounds.
    """

    kind: ClassVar[str] = RigidStop.kind

    restitution: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0, maximum=1.0)]
    gap: Annotated[float, Accepts(DIMENSIONLESS)]

    @takes_fields
    def __init__(self, restitution: float | str, gap: float | str) -> None: ...

    @property
    def stiffness_ratio(self) -> float:
        """Stiffness ratio λ_j, which is infinite."""
        return math.inf

    def summary(self) -> str:
        """Return λ and δ0 in one line."""
        return f"λ = ∞, δ0 = {plain(self.gap, 4)}"


DimensionlessStop: TypeAlias = DimensionlessBumper | DimensionlessRigidStop

_STOPS = Kinds(DimensionlessBumper, DimensionlessRigidStop)


class Dimensionless(Model):
    """Dimensionless parameters of an oscillator at a given amplitude of the base acceleration.

    Parameters
    ----------
    damping_ratio
        ξ = C/(2√(K M)), at least 0.
    right, left
        The stops. None is a side without a stop. Default: None.

    Raises
    ------
    InputError
        If a value is not finite or lies outside its bounds.
    """

    damping_ratio: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0)]
    right: Annotated[DimensionlessBumper | DimensionlessRigidStop | None, _STOPS] = None
    left: Annotated[DimensionlessBumper | DimensionlessRigidStop | None, _STOPS] = None

    @takes_fields
    def __init__(
        self,
        damping_ratio: float | str,
        right: DimensionlessStop | None = None,
        left: DimensionlessStop | None = None,
    ) -> None: ...

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
            Mass M in kg, or a string with a unit. Default: 1 kg.
        stiffness
            Stiffness K of the isolator in N/m, or a string with a unit. Default: 1 N/m.
        amplitude
            Peak base acceleration A in m/s², or a string with a unit. The gaps are proportional to
            it. Default: 1 m/s².

        Returns
        -------
        Rig
            Rig with this oscillator and this amplitude; its frequency is open.

        Raises
        ------
        InputError
            If a value is invalid. Also if a gap is not 0 and the motion without stops has no finite
            resonance peak, because the gap is a multiple of this peak (see ``peak_displacement``).
        """
        m = to_si(mass, MASS, "mass", above=0.0)
        k = to_si(stiffness, STIFFNESS, "stiffness", above=0.0)
        a = to_si(amplitude, ACCELERATION, "amplitude", minimum=0.0)
        damping = 2.0 * self.damping_ratio * math.sqrt(k * m)
        units: Units | None = SI if any(map(has_unit, (mass, stiffness, amplitude))) else None
        free = Oscillator(m, Isolator(k, damping), units=units)

        def stop(side: DimensionlessStop | None) -> Stop | None:
            if side is None:
                return None
            # A gap of 0 is 0 at any scale, so it needs no resonance peak.
            gap = side.gap * peak_of(m, k, self.damping_ratio, a) if side.gap else 0.0
            if isinstance(side, DimensionlessRigidStop):
                return RigidStop(side.restitution, gap)
            stiffness_j = side.stiffness_ratio * k
            damping_j = side.relaxation_time * stiffness_j / free.angular_frequency
            return Bumper(stiffness_j, damping_j, gap)

        return Rig(free.replace(right=stop(self.right), left=stop(self.left)), a)


@public
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
    """Return the physical rig with given dimensionless parameters.

    Parameters
    ----------
    stiffness_ratio
        λ = K_j/K: one number for both sides, or a pair (right, left). None, alone or in the pair,
        is a side without a bumper. The gap and the relaxation time of such a side do not matter.
    gap
        δ0 = G0_j/u_max of one side: one number for both sides, or a pair (right, left). At 1 the
        mass just grazes the bumper.
    relaxation_time
        τ = ω0 C_j/K_j: one number for both sides, or a pair (right, left).
    damping_ratio
        Damping ratio ξ of the isolator.
    mass, stiffness, amplitude
        Physical scales: mass M in kg, stiffness K of the isolator in N/m, and peak base
        acceleration A in m/s²; or strings with units. Default: 1 for each. In this case ω0 is 1
        rad/s, and a frequency ratio r is the frequency ``r * rig.oscillator.natural_frequency`` in
        Hz.

    Returns
    -------
    Rig
        Rig with the base acceleration A. The dimensionless gaps apply only at this base
        acceleration.

    Raises
    ------
    InputError
        If a value is invalid. Also if a gap is not 0 and the motion without stops has no finite
        resonance peak, because the gap is a multiple of this peak (see ``peak_displacement``).

    Examples
    --------
    >>> rig = from_dimensionless(20.0, 0.5, 0.01, 0.15)
    >>> rig.oscillator.right == rig.oscillator.left
    True
    >>> from_dimensionless((20.0, None), 0.5, 0.01, 0.15).oscillator.left is None
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


@public
def to_dimensionless(rig: AnyRig) -> Dimensionless:
    """Return the dimensionless parameters of a rig.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
        It must be shaken by one sine, because the gaps are divided by the response to this sine
        without stops.

    Returns
    -------
    Dimensionless
        The damping ratio ξ, and for each side λ, δ0 and τ of the bumper, or e and δ0 of the rigid
        stop.

    Raises
    ------
    InputError
        If the isolator or a stop is not linear, or if the amplitude is invalid. Also if a gap is
        not 0 and the motion without stops has no finite resonance peak, because the gap is divided
        by this peak (see ``peak_displacement``).
    """
    full_rig = as_rig(rig)
    oscillator, a = full_rig.oscillator, scale_of(full_rig)
    oscillator.check_linear("dimensionless parameters")
    k = oscillator.isolator.initial_stiffness

    def side(stop: Stop | None) -> DimensionlessStop | None:
        if stop is None:
            return None
        gap = stop.gap / peak_displacement(oscillator, a) if stop.gap else 0.0
        if isinstance(stop, RigidStop):
            return DimensionlessRigidStop(stop.restitution, gap)
        if not isinstance(stop, Bumper):
            raise InputError(
                f"{stop.kind}: its law has no dimensionless parameters; use a Bumper or a RigidStop"
            )
        time = oscillator.angular_frequency * stop.damping / stop.stiffness
        return DimensionlessBumper(stop.stiffness / k, gap, time)

    return Dimensionless(oscillator.damping_ratio, side(oscillator.right), side(oscillator.left))


def _pair(value: PerSide, field: str) -> tuple[float | str | None, float | str | None]:
    if isinstance(value, tuple | list):
        if len(value) != 2:
            raise InputError(
                f"{field}: {value!r} is not a pair; pass a number or a pair (right, left)"
            )
        return (value[0], value[1])
    return (value, value)
