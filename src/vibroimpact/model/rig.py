"""The rig, a system with its excitation: the first argument of most public functions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from vibroimpact.arguments import is_list
from vibroimpact.errors import InputError, shown
from vibroimpact.model.assembly import Assembly
from vibroimpact.model.excitation import Harmonic, Periodic, Repeated
from vibroimpact.model.html_table import table
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.periodic_shaking import as_periodic, is_nothing, several
from vibroimpact.model.quantities import FREQUENCY
from vibroimpact.model.record import Record
from vibroimpact.model.stated_units import has_unit
from vibroimpact.model.system import System
from vibroimpact.model.units import pretty, to_si
from vibroimpact.model.written_units import NONE, SI, written_for

Shaking: TypeAlias = float | str | Harmonic | Periodic | Record | Sequence[float | str]
"""Accepted values for the shaking of a rig: an amplitude, a string with a unit, one amplitude per
frequency of a sweep, a `Harmonic`, a `Periodic` or a `Record`."""

_EXAMPLE = 'Rig(oscillator, "0.05 g") or Rig(oscillator, Harmonic("0.05 g", "2 Hz"))'


@dataclass(frozen=True, init=False)
class Rig:
    """An oscillator, or an assembly of several masses, and its excitation.

    Parameters
    ----------
    system
        An `Oscillator`: the mass with its isolator and its stops; or an `Assembly`.
    shaking
        What shakes the rig. It is one of:

        - the peak A of the base acceleration in m/s², greater than 0, or a string such as
          ``"0.05 g"`` (acceleration of the base), ``"5 mm"`` (displacement of the base) or
          ``"120 N"`` (force on the mass) or ``"0.4 kg m"`` (rotating unbalance). In this case the
          frequency is open: it is set later, by ``frequency`` or by a function such as `sweep`;
        - a `Harmonic`, a `Periodic` or a `Record`;
        - for `sweep`, `sweeps` and `lyapunov_exponents`: a list with one amplitude per frequency.
          Functions of one motion do not accept it, because the list does not state its frequencies;
        - None or 0, if nothing shakes the rig, or if a function gets the shaking from another
          argument. `simulate` then computes the free vibration.

        A force or an unbalance on an assembly requires the mass on which it acts, as in
        ``Harmonic("120 N", "2 Hz", on="roof")``.
    frequency
        Forcing frequency in Hz, or a string such as ``"2 Hz"``. Default: the frequency of the
        shaking. If the shaking is only an amplitude, the frequency is open.
    name
        Name of the rig in datasets, tables and legends. Default: no name.

    Attributes
    ----------
    system : Oscillator or Assembly
    shaking : Harmonic, Periodic, Record or None
        The excitation. If the frequency of the rig is open, the frequency of this object has no
        meaning. If the rig has a list of amplitudes, this object has the largest one.
    frequency : float or None
        Forcing frequency in Hz. None if it is open, or if a record shakes the rig.
    amplitudes : tuple of float or None
        One amplitude per frequency of a sweep, in the units of the shaking.
    name : str or None
    published : bool
        Whether the rig is that of a published laboratory case, whose resonance curves figures and
        commands draw as η by default. It is kept if parameters are changed. The rig of a study
        file is not published.

    Raises
    ------
    InputError
        If ``system`` is neither an `Oscillator` nor an `Assembly`, or if the shaking or the
        frequency is invalid. Also if the shaking is a list of amplitudes and a frequency is passed.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> oscillator = vi.Oscillator("550 kg", vi.Isolator("26.8 kN/m", "1.1 kN s/m"))
    >>> vi.Rig(oscillator, "0.05 g").frequency is None
    True
    >>> vi.Rig(oscillator, vi.Harmonic("0.05 g", "2 Hz")).frequency
    2.0
    """

    system: System
    shaking: Repeated | Record | None
    frequency: float | None
    amplitudes: tuple[float, ...] | None
    name: str | None
    published: bool = field(compare=False)

    def __init__(
        self,
        system: System,
        shaking: Shaking | None = None,
        frequency: float | str | None = None,
        name: str | None = None,
    ) -> None:
        if not isinstance(system, System):
            raise InputError(f"system: {_misplaced(system)}; write {_EXAMPLE}")
        if isinstance(shaking, System | Rig):
            raise InputError(f"shaking: {shown(shaking)} is not an excitation; write {_EXAMPLE}")
        system = with_stated_units(system, {"shaking": shaking})
        amplitudes: tuple[float, ...] | None = None
        own: float | None = None
        if isinstance(shaking, Harmonic | Periodic):
            own = shaking.frequency
        elif is_nothing(shaking):
            shaking = None
        elif shaking is not None and not isinstance(shaking, Record):
            shaking, amplitudes = as_periodic(shaking, "shaking")
        if frequency is not None:
            own = to_si(frequency, FREQUENCY, "frequency", above=0.0)
            if amplitudes is not None:
                raise InputError(_one_needed(system, shaking, amplitudes))
            if isinstance(shaking, Record):
                raise InputError(
                    f"frequency: {own:g} Hz, but the shaking is a Record, which has no frequency; "
                    "remove the frequency, or use a Harmonic or a Periodic as the shaking"
                )
            if shaking is not None:
                shaking = shaking.replace(frequency=own)
        if isinstance(shaking, Harmonic | Periodic):
            shaking = system._acted_on_by(shaking)
        vars(self).update(
            system=system,
            shaking=shaking,
            frequency=own,
            amplitudes=amplitudes,
            name=name,
            published=False,
        )

    def _with(self, **changes: Any) -> Rig:
        """Return a copy with other attributes, which are not checked."""
        made = object.__new__(Rig)
        vars(made).update(vars(self) | changes)
        return made

    @property
    def oscillator(self) -> Oscillator:
        """The oscillator.

        Raises
        ------
        InputError
            If the system is an assembly.
        """
        return one_mass_only(self.system)

    @property
    def assembly(self) -> Assembly:
        """The assembly.

        Raises
        ------
        InputError
            If the system is an oscillator.
        """
        return several_masses_only(self.system)

    @property
    def amplitude(self) -> float:
        """Amplitude of the periodic shaking, the largest one of its harmonics (m/s², m, N or kg m).

        Raises
        ------
        InputError
            As in `periodic`.
        """
        return self.periodic.amplitude

    @property
    def periodic(self) -> Repeated:
        """The periodic shaking.

        Raises
        ------
        InputError
            If a record shakes the rig, if the rig has no shaking, or if it has a list of
            amplitudes.
        """
        if self.amplitudes is not None:
            raise InputError(_one_needed(self.system, self.shaking, self.amplitudes))
        if isinstance(self.shaking, Harmonic | Periodic):
            return self.shaking
        return as_periodic(self.shaking, "shaking")[0]  # which says what is wrong

    @property
    def harmonic(self) -> Repeated:
        """The periodic shaking at the frequency of the rig.

        Raises
        ------
        InputError
            As in `periodic`. Also if the frequency is open.
        """
        shaking = self.periodic
        self.check_frequency()
        return shaking

    def check_frequency(self) -> None:
        """Raise an error if the rig has no forcing frequency.

        Raises
        ------
        InputError
            If the frequency is open, or if the shaking is not periodic.
        """
        _ = self.periodic  # which says what is wrong
        if self.frequency is None:
            raise InputError(
                "frequency: missing, and the rig does not state it; pass it, such as "
                'frequency="2 Hz" or Rig(oscillator, Harmonic("0.05 g", "2 Hz"))'
            )

    @classmethod
    def of_open_frequency(
        cls,
        system: System,
        shaking: Repeated | Record | None,
        name: str | None = None,
        *,
        published: bool = False,
    ) -> Rig:
        """Return a rig with the shape of a periodic shaking, but with an open frequency."""
        return cls(system, shaking, name=name)._with(frequency=None, published=published)

    @property
    def sine(self) -> Harmonic:
        """The sine that shakes the rig.

        Raises
        ------
        InputError
            If several harmonics or a record shake the rig, or if the rig has no shaking.
        """
        shaking = self.periodic
        if not isinstance(shaking, Harmonic):
            raise InputError("shaking: it has several harmonics; use one sine, such as a Harmonic")
        return shaking

    @property
    def record(self) -> Record:
        """The record that shakes the rig.

        Raises
        ------
        InputError
            If a periodic excitation shakes the rig, or if the rig has no shaking.
        """
        if not isinstance(self.shaking, Record):
            raise InputError(
                f"shaking: {shown(self.shaking)} is not a Record; pass Rig(oscillator, record) "
                "with a Record"
            )
        return self.shaking

    def at(self, frequency: float | str) -> Rig:
        """Return a copy of the rig with another forcing frequency (Hz, or a string with a unit).

        Raises
        ------
        InputError
            As in `periodic`. Also if the frequency is invalid.
        """
        moved = Rig(self.system, self.periodic, frequency, self.name)
        return moved._with(published=self.published)

    @property
    def is_shaken(self) -> bool:
        """Whether a record, or an amplitude greater than 0, shakes the rig."""
        if isinstance(self.shaking, Record):
            return True
        return self.shaking is not None and self.shaking.amplitude > 0.0

    def vibrating_freely(self) -> Rig:
        """Return the rig with an excitation of amplitude 0, in whose cycles time is counted.

        If the frequency is open, a cycle is one natural period, or 1 s without a spring. Of an
        assembly, it is the longest natural period.
        """
        natural = self.system.angular_frequency / math.tau
        hertz = self.frequency or natural or 1.0
        still = Harmonic(0.0, hertz)
        if self.shaking is not None:
            whole = self.periodic
            still = still.replace(phase=whole.phase, of=whole.of, on=whole.on)
        return self.with_parts(self.system, still, keep_open=False)

    @property
    def hardest(self) -> Rig:
        """The rig with the largest of its amplitudes alone; a rig with one amplitude as it is."""
        return self if self.amplitudes is None else self._with(amplitudes=None)

    def levels(self, count: int) -> NDArray[np.float64]:
        """Return the amplitude at each of the frequencies of a sweep (m/s², m or N).

        Parameters
        ----------
        count
            Number of frequencies.

        Raises
        ------
        InputError
            If the rig has a list with another number of amplitudes. Also as in `periodic`.
        """
        if self.amplitudes is None:
            return np.full(count, self.amplitude)
        if len(self.amplitudes) != count:
            raise InputError(
                f"shaking: {len(self.amplitudes)} amplitudes for {count} "
                f"frequenc{'y' if count == 1 else 'ies'}; pass one amplitude, or {count}"
            )
        return np.array(self.amplitudes)

    def with_parts(
        self,
        system: System,
        shaking: Repeated | Record | None = None,
        *,
        keep_open: bool = True,
    ) -> Rig:
        """Return a copy with another system, and optionally with another shaking.

        If the frequency is open, it stays open, unless ``keep_open`` is False.
        """
        frequency = self.frequency
        if isinstance(shaking, Harmonic | Periodic) and not (frequency is None and keep_open):
            frequency = shaking.frequency
        return self._with(system=system, shaking=shaking or self.shaking, frequency=frequency)

    def __repr__(self) -> str:
        parts = [repr(self.system)]
        if self.amplitudes is not None:
            parts.append(repr(list(self.amplitudes)))
        elif isinstance(self.shaking, Harmonic | Periodic) and self.frequency is None:
            parts.append(repr(self._open()))
        elif self.shaking is not None:
            parts.append(repr(self.shaking))
        if self.name is not None:
            parts.append(f"name={self.name!r}")
        return f"Rig({', '.join(parts)})"

    def __str__(self) -> str:
        with written_for(self):
            return f"Rig({self.system.table_name}={self.system}, shaking={self._shaking_text()})"

    def _repr_html_(self) -> str:
        title = "Rig" if self.name is None else f"Rig {self.name}"
        with written_for(self):
            rows = [*self.system.rows(), ("shaking", self._shaking_text())]
            return f"{self.system._picture()}{table(title, rows)}"

    def _open(self) -> object:
        """Return the shaking with an open frequency, as its amplitude if it is a plain sine."""
        shaking = self.periodic
        if isinstance(shaking, Harmonic) and shaking.phase == 0.0:
            return shaking.amplitude if shaking.of == "acceleration" else self._shaking_text()
        return shaking

    def _shaking_text(self) -> str:
        if self.amplitudes is not None:
            quantity = self.hardest.periodic.quantity
            return f"({', '.join(pretty(size, quantity) for size in self.amplitudes)})"
        if isinstance(self.shaking, Harmonic) and self.frequency is None:
            return pretty(self.shaking.amplitude, self.shaking.quantity)
        return "open" if self.shaking is None else str(self.shaking)


def _one_needed(
    system: System, shaking: Repeated | Record | None, amplitudes: tuple[float, ...]
) -> str:
    """Say that one amplitude is needed, with an example in the units of the system."""
    assert isinstance(shaking, Harmonic)  # as a list is read
    with written_for(system):
        return several(amplitudes, shaking)


def _misplaced(value: object) -> str:
    """Describe the value that was passed instead of an oscillator."""
    if isinstance(value, Harmonic | Periodic | Record):
        return f"a {type(value).__name__} is a shaking, which is the second argument"
    return f"{shown(value)} is not an Oscillator or an Assembly"


def one_mass_only(system: System, where: str = "rig") -> Oscillator:
    """Return the oscillator of a function that accepts only one mass."""
    if not isinstance(system, Oscillator):
        raise InputError(
            f"{where}: an Assembly of several masses is not accepted by this function; pass a Rig "
            "with an Oscillator"
        )
    return system


def several_masses_only(system: System, where: str = "rig") -> Assembly:
    """Return the assembly of a function that accepts only several masses."""
    if not isinstance(system, Assembly):
        raise InputError(f"{where}: an Oscillator has one mass; pass an Assembly")
    return system


_S = TypeVar("_S", bound=System)


def with_stated_units(system: _S, values: Mapping[str, object]) -> _S:
    """Return the system for values that may state units, such as its shaking, by their names.

    A mass and a stiffness of 1 are 1 kg and 1 N/m after all if another value has a unit, unless
    ``units="none"`` was passed.

    Raises
    ------
    InputError
        If a value states a unit, but the rig has none for another reason.
    """
    for name, value in values.items():
        if isinstance(value, Record) and value.about.unit == NONE and system.units != NONE:
            raise InputError(
                f"{name}: {value.about.source!r} was read without a unit, but the rig has units; "
                "read it with its unit, such as g"
            )
    if system.units != NONE:
        return system
    for name, value in values.items():
        if isinstance(value, Record) and _states_unit(value) and not system.may_have_units:
            raise InputError(
                f"{name}: {value.about.source!r} contains accelerations in {value.about.unit}, but "
                'the rig has no units (units is "none"); if the numbers of the record are '
                'dimensionless, read it with unit="none" (--unit none); otherwise remove units'
            )
        parts = cast("Sequence[object]", value) if is_list(value) else [value]
        if not any(map(_states_unit, parts)):
            continue
        if not system.may_have_units:
            raise InputError(
                f'{name}: {shown(value)} has a unit, but the rig has none (units is "none"); pass '
                "a number without a unit, or remove units"
            )
        return system.replace(units=SI)
    return system


def _states_unit(value: object) -> bool:
    """Return whether a value states a unit. A file of a record has one, or is read with "none"."""
    return _has_unit_of_file(value) if isinstance(value, Record) else has_unit(value)


def _has_unit_of_file(record: Record) -> bool:
    return bool(record.about.source) and record.about.unit != NONE
