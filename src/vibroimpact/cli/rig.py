"""The rig of a command: a laboratory case or a study file, with the values that options replace."""

from __future__ import annotations

import textwrap
from dataclasses import fields
from pathlib import Path
from typing import Any, NamedTuple

from vibroimpact.cli.options import RigOptions
from vibroimpact.cli.rig_changes import changes, joined
from vibroimpact.cli.study import SimulateTable, Study, SweepTable, read_study
from vibroimpact.errors import InputError
from vibroimpact.model import (
    GRAVITY,
    AnyIsolator,
    Bumper,
    Harmonic,
    Model,
    Oscillator,
    Periodic,
    Record,
    Repeated,
    Stop,
    laboratory,
)
from vibroimpact.model.excitation import sized
from vibroimpact.model.isolators.law import spring_and_dashpot
from vibroimpact.model.laboratory import Case, Parameters
from vibroimpact.model.names import check_name, file_stem, literal
from vibroimpact.model.periodic_shaking import as_periodic, is_nothing
from vibroimpact.model.quantities import DIMENSIONLESS, FORCE, PERIOD
from vibroimpact.model.rig import Rig, with_stated_units
from vibroimpact.model.stated_units import has_unit
from vibroimpact.model.units import to_si
from vibroimpact.model.written_units import NONE, write_for
from vibroimpact.response.plausibility import doubt_stops

_SHARED = {"stiffness": "bumper_stiffness", "damping": "bumper_damping", "gap": "gap"}
"""Options that set a field of both bumpers, by field."""


_ANY_BUMPER = Bumper(1.0, 0.0, 0.0)
"""Placeholder that reads the fields of a new bumper."""


class Subject(NamedTuple):
    """The rig of a command, with its name and its study."""

    name: str
    """Name with the changes by the options."""
    slug: str
    """Name in file names."""
    oscillator: Oscillator
    shaking: Repeated | Record
    """The shaking. If it is periodic, its frequency is open."""
    study: Study | None
    published: bool
    """Whether the rig is a laboratory case whose natural frequency was not changed."""

    @property
    def repeated(self) -> Repeated:
        """The periodic shaking, with the phase of the study.

        Raises
        ------
        InputError
            If the shaking is a record.
        """
        if isinstance(self.shaking, Record):
            raise InputError(
                "excitation.record: this command needs a periodic excitation, not a record; "
                "replace excitation.record by excitation.amplitude in the study, or use "
                "vibroimpact simulate or vibroimpact earthquake"
            )
        return self.shaking

    @property
    def phase(self) -> float:
        """Phase of the forcing in the study (rad), or 0 without a study."""
        return self.study.excitation.phase if self.study else 0.0

    @property
    def sweep_table(self) -> SweepTable:
        """The table ``[sweep]`` of the study, or an empty table without a study."""
        return self.study.sweep if self.study else SweepTable()

    @property
    def simulate_table(self) -> SimulateTable:
        """The table ``[simulate]`` of the study, or an empty table without a study."""
        return self.study.simulate if self.study else SimulateTable()

    @property
    def rig(self) -> Rig:
        """The rig. If its shaking is periodic, the frequency is open."""
        return Rig.of_open_frequency(
            self.oscillator, self.shaking, self.name, published=self.study is None
        )

    def at(self, hertz: float, phase: float | None = None) -> Repeated:
        """Return the periodic shaking at a frequency (Hz)."""
        changed = {} if phase is None else {"phase": phase}
        return self.repeated.replace(frequency=hertz, **changed)

    @property
    def title(self) -> str:
        """The name, broken between changes into lines that fit above a figure."""
        whole = self.name.replace(" ", "\N{NO-BREAK SPACE}").replace(",\N{NO-BREAK SPACE}", ", ")
        return literal(textwrap.fill(whole, 72).replace("\N{NO-BREAK SPACE}", " "))


class _Named(NamedTuple):
    """The rig that a text names, without the changes by options."""

    title: str
    slug: str
    oscillator: Oscillator
    shaking: Repeated | Record | None
    study: Study | None
    case: bool
    """Whether the rig is a laboratory case."""


def subject(
    text: str,
    options: RigOptions,
    name: str | None = None,
    shaken: Repeated | Record | None = None,
    otherwise: Repeated | None = None,
    unshaken: bool = False,
) -> Subject:
    """Return the rig that a case code or the path of a study file names, with changes.

    Parameters
    ----------
    text
        The case code or the path of a study file. The ending ``.toml`` may be omitted.
    options
        Options that replace values of the rig.
    name
        Name in file names, instead of the name of the rig and its changes.
    shaken
        Shaking that replaces the shaking of the case or of the study.
    otherwise
        Shaking that is used if neither the case, nor the study, nor the options state one.
    unshaken
        Whether a rig that nothing shakes is accepted. Its shaking has the amplitude 0.

    Raises
    ------
    InputError
        If the code, the file or a value of the options is invalid.
    """
    found = _named(text, options)
    if shaken is not None:
        found = found._replace(shaking=shaken)

    def rig_of(given: RigOptions) -> tuple[Oscillator, Repeated | Record | None]:
        shaking = found.shaking
        if given.amplitude is not None:
            shaking = _of_size(shaking, given.amplitude, found.oscillator.units == NONE)
        stated = {_flag(one.name): getattr(given, one.name) for one in fields(given)}
        return with_stated_units(changed(found.oscillator, given), stated), shaking

    oscillator, shaking = rig_of(options)
    write_for(oscillator)  # until the end of the command
    shaking = otherwise if shaking is None else shaking
    if shaking is None and unshaken:
        shaking = Rig(oscillator).vibrating_freely().periodic
    if shaking is None:
        where = f"study {text!r}: excitation.amplitude: missing"
        raise InputError(
            f"{'--amplitude: 0' if options.amplitude else where}; set it in the study, or pass "
            "--amplitude, such as 0.05g (acceleration), 2mm (displacement) or 500N (force); for a "
            "free vibration, use vibroimpact simulate"
        )
    made = changes(options, rig_of, oscillator)
    what = Subject(
        ", ".join((name or found.title, *(change.words for change in made))),
        file_stem(check_name(name, "--name")) if name else joined(found.slug, made),
        oscillator,
        shaking,
        found.study,
        found.case and oscillator.angular_frequency == found.oscillator.angular_frequency,
    )
    doubt_stops(Rig(what.oscillator, what.shaking))
    return what


def _of_size(
    shaking: Repeated | Record | None, amplitude: str, without_units: bool
) -> Repeated | None:
    """Return the shaking with the amplitude of the option. Several harmonics keep their shape.

    With an amplitude of 0, nothing shakes the rig. A plain number for a rig without units does not
    change the quantity.
    """
    if isinstance(shaking, Record):
        raise InputError(
            f"--amplitude: {amplitude!r}, but a record shakes this rig; to scale the record, use "
            "--peak of vibroimpact earthquake or vibroimpact design"
        )
    if isinstance(shaking, Periodic):
        size, _ = sized(amplitude, shaking.of, "--amplitude")
        return shaking.replace(amplitude=size) if size else None
    if is_nothing(amplitude):
        return None
    is_plain = without_units and not has_unit(amplitude)
    kept = shaking.of if shaking is not None and is_plain else None
    found, _ = as_periodic(amplitude, "--amplitude", kept)
    return found if shaking is None else found.replace(phase=shaking.phase)


def _named(text: str, options: RigOptions) -> _Named:
    """Return the case or the study that a text names."""
    path = Path(text)
    if path.suffix.lower() == ".toml" or path.is_file():
        return _of_study(text, read_study(path), options)
    try:
        return _of_case(text, options.parameters)
    except InputError as error:
        beside = path.with_name(f"{path.name}.toml") if path.name else path
        if beside.is_file():
            return _of_study(str(beside), read_study(beside), options)
        hint = "" if str(error).startswith("parameters: ") else "; or pass a study file, NAME.toml"
        raise InputError(f"{error}{hint}") from None


def _shaken_by(case: Case) -> Harmonic:
    return Harmonic(case.amplitude, 1.0)


def _of_case(code: str, parameters: Parameters | None) -> _Named:
    case = laboratory.case(code, parameters or "table")
    if parameters is None or parameters == "table":
        return _Named(case.code, case.slug, case.oscillator, _shaken_by(case), None, True)
    # Two parameter sets of one test are two rigs. They must not overwrite each other's files.
    title, first = f"{case.code}, {parameters} parameters", f"{case.slug}-{parameters}"
    return _Named(title, first, case.oscillator, _shaken_by(case), None, True)


def _of_study(path: str, study: Study, options: RigOptions) -> _Named:
    parameters = options.parameters or study.parameters
    if parameters is not None and study.case is None:
        raise InputError(
            f"--parameters: {parameters!r}, but {path!r} describes its own oscillator, and only "
            "laboratory cases have parameter sets; remove --parameters"
        )
    described = study.rig(Path(path), parameters)
    title, oscillator, shaking = described.name or "", described.oscillator, described.shaking
    first = file_stem(title)
    if study.case is not None and parameters != (study.parameters or (parameters and "table")):
        title, first = f"{title}, {parameters} parameters", f"{first}-{parameters}"
    return _Named(title, first, oscillator, shaking, study, study.case is not None)


def changed(oscillator: Oscillator, options: RigOptions) -> Oscillator:
    """Return the oscillator with the values that the options replace.

    Raises
    ------
    InputError
        If a value is invalid, or if a new bumper is not completely described.
    """
    if options.no_isolator:
        oscillator = _without_isolator(oscillator, options)
    changes: dict[str, Any] = {
        "mass": _mass(oscillator, options),
        "isolator": _isolator(oscillator, options),
    }
    removed = {"right": options.no_right, "left": options.no_left}
    shared = [field for field, option in _SHARED.items() if getattr(options, option) is not None]
    # Options for both sides change existing stops. They make bumpers only if there are none.
    present = [
        side for side in removed if getattr(oscillator, side) is not None and not removed[side]
    ]
    targets = present or [side for side in removed if not removed[side]]
    if shared and not targets:
        option = _SHARED[shared[0]]
        raise InputError(
            f"{_flag(option)}: given together with --no-right and --no-left, which remove both "
            "stops; remove one of these three options"
        )
    for field in shared:
        if not any(_has(getattr(oscillator, side), field) for side in targets):
            raise InputError(
                f"{_flag(_SHARED[field])}: no stop of this rig has a {field}; remove this option, "
                f"or use a rig whose stops have a {field}"
            )
    for side in removed:
        own = [field for field in _SHARED if getattr(options, f"{side}_{field}") is not None]
        if removed[side] and own:
            raise InputError(
                f"{_flag(f'{side}_{own[0]}')}: given together with --no-{side}; remove one of the "
                "two options"
            )
        bumper: Stop | None = None if removed[side] else getattr(oscillator, side)
        for field in own:
            if not _has(bumper, field):
                raise InputError(
                    f"{_flag(f'{side}_{field}')}: the {side} stop is {bumper}, which has no "
                    f"{field}; remove this option"
                )
        values = {
            field: _value(bumper or _ANY_BUMPER, field, option, options)
            for field, option in (
                *((f, _SHARED[f]) for f in shared if side in targets and _has(bumper, f)),
                *((f, f"{side}_{f}") for f in own),
            )
        }
        if bumper is not None:
            bumper = bumper.replace(**values)
        elif values and not removed[side]:
            bumper = _new_bumper(side, values)
        changes[side] = bumper
    return oscillator.replace(**changes)


def _without_isolator(oscillator: Oscillator, options: RigOptions) -> Oscillator:
    """Return the oscillator without its isolator."""
    for option in ("stiffness", "damping", "isolator_period", "damping_ratio"):
        if getattr(options, option) is not None:
            raise InputError(
                f"{_flag(option)}: given together with --no-isolator; remove one of the two options"
            )
    return oscillator.replace(isolator=None)


def _mass(oscillator: Oscillator, options: RigOptions) -> float:
    """Return the mass (kg), from the option for the mass or from the option for the weight."""
    _one_of_two("weight", "mass", options)
    if options.weight is not None:
        return to_si(options.weight, FORCE, "--weight", above=0.0) / GRAVITY
    return oscillator.mass if options.mass is None else _value(oscillator, "mass", "mass", options)


def _isolator(oscillator: Oscillator, options: RigOptions) -> AnyIsolator:
    """Return the isolator. A new period keeps the damping ratio, unless an option states it."""
    _one_of_two("isolator_period", "stiffness", options)
    _one_of_two("damping_ratio", "damping", options)
    isolator = oscillator.isolator
    values: dict[str, float] = {}
    for field in ("stiffness", "damping"):
        option = "isolator_period" if field == "stiffness" and options.isolator_period else field
        if getattr(options, option) is None:
            continue
        if field not in type(isolator).model_fields:
            raise InputError(
                f"{_flag(option)}: the isolator is {isolator}, which has no {field}; remove this "
                "option"
            )
        if option == field:
            values[field] = _value(isolator, field, field, options)
    mass = _mass(oscillator, options)
    if options.isolator_period is not None:
        period = to_si(options.isolator_period, PERIOD, "--isolator-period", above=0.0)
        kept = options.damping is options.damping_ratio is None
        ratio = oscillator.damping_ratio if kept else 0.0
        values = {**spring_and_dashpot(mass, period, ratio), **values}
    if values:
        isolator = isolator.replace(**values)
    if options.damping_ratio is not None:
        ratio = to_si(options.damping_ratio, DIMENSIONLESS, "--damping-ratio", minimum=0.0)
        critical = oscillator.replace(mass=mass, isolator=isolator).critical_damping
        isolator = isolator.replace(damping=ratio * critical)
    return isolator


def _one_of_two(one: str, other: str, options: RigOptions) -> None:
    """Raise an error if two options state the same quantity."""
    if getattr(options, one) is not None and getattr(options, other) is not None:
        raise InputError(
            f"{_flag(one)}: given together with {_flag(other)}; remove one of the two options"
        )


def _has(stop: Stop | None, field: str) -> bool:
    """Return whether a stop has a field. Without a stop, a new bumper is assumed."""
    return field in (Bumper if stop is None else type(stop)).model_fields


def _new_bumper(side: str, values: dict[str, float]) -> Bumper:
    missing = [field for field in _SHARED if field not in values]
    if missing:
        flags = [f"--{side}-{field}" for field in missing]
        raise InputError(
            f"{flags[0]}: missing; the rig has no {side} stop, and a new one also needs "
            f"{' and '.join(flags)}"
        )
    return Bumper(**values)


def _value(part: Model, field: str, option: str, options: RigOptions) -> float:
    """Read an option as the part of the rig reads its field. Errors name the option."""
    accepts = part.accepts(field)
    assert accepts is not None
    try:
        value = accepts(getattr(options, option))
    except InputError as error:
        raise InputError(f"{_flag(option)}: {error}") from None
    assert value is not None
    return value


def _flag(option: str) -> str:
    return f"--{option.replace('_', '-')}"
