"""Periodic excitation: one sine, or several harmonics.

An excitation is an acceleration of the base, a displacement of the base, a force on the mass, or
the force of a rotating unbalance. The dimension of the amplitude determines which of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import SerializerFunctionWrapHandler, model_serializer, model_validator

from vibroimpact.arguments import check_list
from vibroimpact.errors import InputError, alternatives, errors_at, shown
from vibroimpact.model.assembly.names import check_part_name
from vibroimpact.model.quantities import (
    ACCELERATION,
    ANGLE,
    FORCE,
    FREQUENCY,
    LENGTH,
    UNBALANCE,
    Quantity,
)
from vibroimpact.model.size_checks import check_size
from vibroimpact.model.units import one_of, plain, pretty, to_si
from vibroimpact.model.validation import Accepts, Model, takes_fields
from vibroimpact.model.written_units import unitless

Of = Literal["acceleration", "displacement", "force", "unbalance"]
"""Quantity of an amplitude."""

ON_THE_MASS: tuple[Of, ...] = ("force", "unbalance")
"""Quantities of a force on the mass, under which the base is at rest."""

QUANTITIES: dict[Of, Quantity] = {
    "acceleration": ACCELERATION,
    "displacement": LENGTH,
    "force": FORCE,
    "unbalance": UNBALANCE,
}

FREQUENCY_WORDS = "excitation frequency"
_PEAKS: dict[Of, str] = {
    "acceleration": "peak base acceleration",
    "displacement": "peak base displacement",
    "force": "peak force on the mass",
    "unbalance": "rotating unbalance of the mass",
}


def amplitude_of(of: Of) -> Accepts:
    """Return what an amplitude accepts that is varied."""
    return Accepts(QUANTITIES[of], above=0.0, meaning=_PEAKS[of])


MOST = 32
"""Largest number of harmonics."""


class _Repeated(Model):
    """Base class of both excitations. If the amplitude has a unit, the unit determines `of`."""

    _quiet: ClassVar[Mapping[str, Any]] = {"of": "acceleration", "on": None}

    if TYPE_CHECKING:
        frequency: float
        phase: float
        of: Of
        on: str | None

        @property
        def amplitude(self) -> float:
            """Amplitude, or the largest one of several harmonics."""

    @model_validator(mode="after")
    def _acts_on_a_mass(self) -> Self:
        if self.on is None:
            return self
        check_part_name(self.on, "on")
        if self.moves_base:
            raise InputError(
                f"on: {self.on!r}, but the {self.of} of the base acts on all masses; remove on, or "
                'pass a force such as "120 N" or an unbalance such as "0.4 kg m"'
            )
        return self

    @model_serializer(mode="wrap")
    def _without_open_mass(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        table: dict[str, Any] = handler(self)
        if self.on is None:
            del table["on"]
        return table

    @property
    def quantity(self) -> Quantity:
        """Quantity of the amplitude."""
        return QUANTITIES[self.of]

    @property
    def moves_base(self) -> bool:
        """Whether the base moves. If not, a force acts on the mass, and the base is at rest."""
        return self.of not in ON_THE_MASS

    @property
    def grows_with_frequency(self) -> bool:
        """Whether the excitation grows as ω² at a constant amplitude."""
        return self.of in ("displacement", "unbalance")

    @property
    def angular_frequency(self) -> float:
        """Forcing angular frequency, ω = 2π f, in rad/s."""
        return math.tau * self.frequency

    @property
    def period(self) -> float:
        """Forcing period, 1/f, in s."""
        return 1.0 / self.frequency

    @property
    def _sign(self) -> float:
        """Sign of the acceleration or the force over that of the amplitude: −X ω² sin θ."""
        return -1.0 if self.of == "displacement" else 1.0

    def _as_acceleration(
        self, size: NDArray[np.float64], mass: float, omega: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        size = size if self.moves_base else size / mass
        return np.asarray(size * omega**2 if self.grows_with_frequency else size + 0.0 * omega)

    def knobs(self) -> dict[str, tuple[float, Accepts]]:
        """Return the frequency and the amplitude: the phase only moves the origin of time."""
        return {
            "frequency": (self.frequency, Accepts(FREQUENCY, above=0.0, meaning=FREQUENCY_WORDS)),
            "amplitude": (self.amplitude, amplitude_of(self.of)),
        }

    def _read(self) -> Iterator[tuple[str, Any, str]]:
        for name, value, text in super()._read():
            if name == "frequency" and unitless():
                yield "angular_frequency", math.tau * value, plain(math.tau * value)
            elif name == "amplitude":
                yield name, value, pretty(value, self.quantity)
            elif name == "amplitudes":
                parts = ", ".join(pretty(part, self.quantity) for part in value)
                yield name, value, f"({parts})"
            else:
                yield name, value, text


class Harmonic(_Repeated):
    """Sinusoidal excitation, A sin(2π f t + φ).

    Parameters
    ----------
    amplitude
        Amplitude A, at least 0. A number is an acceleration of the base in m/s². A text or a
        quantity with a unit is an acceleration of the base such as ``"0.05 g"`` (g is gravity), a
        displacement of the base such as ``"5 mm"``, a force on the mass such as ``"120 N"``, or a
        rotating unbalance m e on the mass such as ``"0.4 kg m"``, whose force is m e (2π f)².
    frequency
        Frequency f in Hz, greater than 0; or a string such as ``"2.5 Hz"``. An angular frequency
        such as ``"15.7 rad/s"`` is converted to Hz.
    phase
        Phase φ in rad; or a string such as ``"90 deg"``. Default: 0.
    of
        Quantity of an amplitude that has no unit: ``"acceleration"`` (m/s², the default),
        ``"displacement"`` (m), ``"force"`` (N) or ``"unbalance"`` (kg m).
    on
        Name of the mass of an `Assembly` on which a force or an unbalance acts. Default: None, for
        the mass of an `Oscillator`, and for a motion of the base.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    amplitude: float
    frequency: Annotated[float, Accepts(FREQUENCY, above=0.0)]
    phase: Annotated[float, Accepts(ANGLE)] = 0.0
    of: Of = "acceleration"
    on: str | None = None

    @takes_fields
    def __init__(
        self,
        amplitude: float | str,
        frequency: float | str,
        phase: float | str = 0.0,
        of: Of | None = None,
        on: str | None = None,
    ) -> None: ...

    @model_validator(mode="before")
    @classmethod
    def _dimension(cls, data: Any) -> Any:
        if not isinstance(data, Mapping) or "amplitude" not in data:
            return data
        value, of = sized(data["amplitude"], data.get("of"), "amplitude")
        return {**data, "amplitude": value, "of": of}

    @property
    def half_wave(self) -> bool:
        """Whether the excitation changes its sign after half a period: always true for a sine."""
        return True

    def at(self, angle: ArrayLike) -> NDArray[np.float64]:
        """Return the base acceleration (m/s²) or the force (N) at angles ωt + φ (rad)."""
        size = self.amplitude
        if self.grows_with_frequency:
            size *= self.angular_frequency**2
        return np.asarray(self._sign * size * np.sin(angle))

    def acceleration(self, mass: float, omega: ArrayLike) -> NDArray[np.float64]:
        """Return the equivalent peak base acceleration (m/s²) for a mass (kg) at ω (rad/s)."""
        return self._as_acceleration(np.asarray(self.amplitude), mass, np.asarray(omega))


class Periodic(_Repeated):
    """Sum of harmonics of one frequency, Σ A_n sin(n (2π f t + φ) + φ_n), n = 1, 2, ….

    Parameters
    ----------
    frequency
        Fundamental frequency f in Hz, greater than 0; or a string such as ``"2.5 Hz"``.
    amplitudes
        Amplitudes A_1, A_2, …, at most 32. Each is a number or a string, as the amplitude of a
        `Harmonic`. All must have the same dimension. An amplitude of 0 omits the harmonic. An
        unbalance of harmonic n rotates n times as fast: its force is m e (2π n f)².
    phases
        Phases φ_1, φ_2, … in rad, or strings such as ``"90 deg"``. Default: all are 0.
    phase
        Phase φ in rad, at which the excitation starts in its period. Default: 0.
    of, on
        Quantity of amplitudes that have no unit, and the mass on which they act, as in `Harmonic`.

    Raises
    ------
    InputError
        If a value is invalid, or if the numbers of phases and amplitudes differ.
    """

    frequency: Annotated[float, Accepts(FREQUENCY, above=0.0)]
    amplitudes: tuple[float, ...]
    phases: tuple[Annotated[float, Accepts(ANGLE)], ...] = ()
    phase: Annotated[float, Accepts(ANGLE)] = 0.0
    of: Of = "acceleration"
    on: str | None = None

    @takes_fields
    def __init__(
        self,
        frequency: float | str,
        amplitudes: Iterable[float | str],
        phases: Iterable[float | str] | None = None,
        phase: float | str = 0.0,
        of: Of | None = None,
        on: str | None = None,
    ) -> None: ...

    @model_validator(mode="before")
    @classmethod
    def _dimension(cls, data: Any) -> Any:
        if not isinstance(data, Mapping) or "amplitudes" not in data:
            return data
        amplitudes, of = check_list(data["amplitudes"], "amplitudes"), data.get("of")
        if not 1 <= len(amplitudes) <= MOST:
            raise InputError(f"amplitudes: {len(amplitudes)} harmonics; pass 1 to {MOST}")
        values = []
        for i, one in enumerate(amplitudes):
            value, of = sized(one, of, f"amplitudes[{i}]")
            values.append(value)
        phases = data.get("phases")
        turned = check_list(phases, "phases") if phases is not None else (0.0,) * len(values)
        if not turned:
            turned = (0.0,) * len(values)
        if len(turned) != len(values):
            raise InputError(
                f"phases: {len(turned)} given for {len(values)} "
                f"amplitude{'' if len(values) == 1 else 's'}; pass one phase per amplitude, or no "
                "phases"
            )
        if not any(values):
            raise InputError(
                f"amplitudes: {values} are all 0; pass at least one that is greater than 0"
            )
        return {**data, "amplitudes": tuple(values), "phases": tuple(turned), "of": of}

    @property
    def amplitude(self) -> float:
        """Largest of the amplitudes. If it is varied, the shape of the excitation is kept."""
        return max(self.amplitudes)

    @property
    def half_wave(self) -> bool:
        """Whether the excitation has no even harmonics: it changes its sign after half a period."""
        return not any(self.amplitudes[1::2])

    def at(self, angle: ArrayLike) -> NDArray[np.float64]:
        """Return the base acceleration (m/s²) or the force (N) at angles ωt + φ (rad)."""
        order = np.arange(1, len(self.amplitudes) + 1)
        sizes = self._sign * np.array(self.amplitudes)
        if self.grows_with_frequency:
            sizes *= (order * self.angular_frequency) ** 2
        turned = np.multiply.outer(np.asarray(angle), order) + np.array(self.phases)
        return np.asarray(np.sin(turned) @ sizes)

    def acceleration(self, mass: float, omega: ArrayLike) -> NDArray[np.float64]:
        """Return the equivalent peak base acceleration (m/s²) of each harmonic for a mass (kg).

        ω (rad/s) is the angular frequency of the fundamental. The last axis of the result counts
        the harmonics.
        """
        sizes = np.asarray(self.amplitudes)
        order = np.arange(1, len(sizes) + 1)
        return self._as_acceleration(sizes, mass, np.asarray(omega)[..., np.newaxis] * order)

    def replace(self, **changes: Any) -> Self:
        """Return a copy with some fields changed. A new ``amplitude`` scales all harmonics."""
        if "amplitude" in changes:
            factor = to_si(changes.pop("amplitude"), self.quantity, "amplitude") / self.amplitude
            changes["amplitudes"] = tuple(factor * one for one in self.amplitudes)
        return super().replace(**changes)


Repeated: TypeAlias = Harmonic | Periodic
"""A periodic excitation."""


def sized(value: Any, of: Any, field: str, positive: bool = False) -> tuple[float, Of]:
    """Return an amplitude in SI units, and its quantity.

    Raises
    ------
    InputError
        If it is invalid, or its unit does not fit the quantity.
    """
    if of is not None and not (isinstance(of, str) and of in QUANTITIES):
        raise InputError(f"of: {shown(of)} is unknown; use {alternatives(map(repr, QUANTITIES))}")
    allowed = QUANTITIES if of is None else {of: QUANTITIES[of]}
    least = {"above": 0.0} if positive else {"minimum": 0.0}
    number, quantity = one_of(value, list(allowed.values()), field, **least)
    with errors_at(f"{field}: "):
        check_size(value, number)
    return number, next(name for name, one in allowed.items() if one is quantity)
