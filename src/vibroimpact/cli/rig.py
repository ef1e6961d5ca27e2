"""The rig of a command: a laboratory case or a study file, with the values that options replace."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import Any, NamedTuple

from vibroimpact.cli.options import RigOptions, by_path
from vibroimpact.cli.rig_changes import changes, joined
from vibroimpact.cli.study import SimulateTable, Study, SweepTable, read_study
from vibroimpact.errors import InputError
from vibroimpact.model import (
    GRAVITY,
    Assembly,
    Harmonic,
    Model,
    Oscillator,
    Periodic,
    Record,
    Repeated,
    laboratory,
)
from vibroimpact.model.assembly.names import check_known
from vibroimpact.model.derived_parameters import DERIVED
from vibroimpact.model.excitation import sized
from vibroimpact.model.laboratory import Case, Parameters
from vibroimpact.model.names import check_name, file_stem, literal
from vibroimpact.model.parameter_ranges import turn
from vibroimpact.model.parameters import (
    PARAMETERS,
    canonical,
    parameter,
    parameters,
    set_values,
)
from vibroimpact.model.periodic_shaking import as_periodic, is_nothing
from vibroimpact.model.quantities import FORCE
from vibroimpact.model.rig import Rig, System, with_stated_units
from vibroimpact.model.stated_units import has_unit
from vibroimpact.model.units import to_si
from vibroimpact.model.written_units import NONE, write_for
from vibroimpact.response.plausibility import doubt_stops


class Subject(NamedTuple):
    """The rig of a command, with its name and its study."""

    name: str
    """Name with the changes by the options."""
    slug: str
    """Name in file names."""
    system: System
    """What vibrates: an oscillator, or an assembly if the command accepts one."""
    shaking: Repeated | Record
    """The shaking. If it is periodic, its frequency is open."""
    study: Study | None
    published: bool
    """Whether the rig is a laboratory case whose natural frequency was not changed."""

    @property
    def oscillator(self) -> Oscillator:
        """The oscillator of a command that accepts no assembly."""
        assert isinstance(self.system, Oscillator)
        return self.system

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
            self.system, self.shaking, self.name, published=self.study is None
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
    system: System
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
    masses: bool = False,
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
    masses
        Whether an assembly of several masses is accepted.

    Raises
    ------
    InputError
        If the code, the file or a value of the options is invalid.
    """
    found = _named(text, options)
    if isinstance(found.system, Assembly) and not masses:
        raise InputError(
            f"study {text!r}: assembly: this command computes one mass, not an assembly of several "
            "masses; use vibroimpact simulate, sweep, branch, bifurcation, curve, motion, basins "
            "or earthquake"
        )
    if shaken is not None:
        found = found._replace(shaking=shaken)

    def rig_of(given: RigOptions) -> tuple[System, Repeated | Record | None]:
        shaking = found.shaking
        if given.amplitude is not None:
            shaking = _of_size(shaking, given.amplitude, found.system.units == NONE)
        stated: dict[str, Any] = {"--amplitude": given.amplitude, "--gap": given.gap}
        stated |= {f"--set: {k}": v for k, v in by_path("--set", given.values).items()}
        scale = otherwise if shaking is None else shaking
        if isinstance(found.system, Assembly):
            return with_stated_units(changed_assembly(found.system, given), stated), shaking
        return with_stated_units(changed(found.system, given, scale), stated), shaking

    system, shaking = rig_of(options)
    write_for(system)  # until the end of the command
    shaking = otherwise if shaking is None else shaking
    if shaking is None and unshaken:
        shaking = Rig(system).vibrating_freely().periodic
    if shaking is None:
        where = f"study {text!r}: excitation.amplitude: missing"
        raise InputError(
            f"{'--amplitude: 0' if options.amplitude else where}; set it in the study, or pass "
            "--amplitude, such as 0.05g (acceleration), 2mm (displacement) or 500N (force); for a "
            "free vibration, use vibroimpact simulate"
        )
    made = changes(options, rig_of, system)
    what = Subject(
        ", ".join((found.title, *(change.words for change in made))),
        file_stem(check_name(name, "--name")) if name else joined(found.slug, made),
        system,
        shaking,
        found.study,
        found.case and system.angular_frequency == found.system.angular_frequency,
    )
    if isinstance(system, Oscillator):
        doubt_stops(Rig(system, what.shaking))
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
    if shaking is None:
        return found
    on = None if found.moves_base else shaking.on
    return found.replace(phase=shaking.phase, on=on)


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
    title, system, shaking = described.name or "", described.system, described.shaking
    first = file_stem(title)
    if study.case is not None and parameters != (study.parameters or (parameters and "table")):
        title, first = f"{title}, {parameters} parameters", f"{first}-{parameters}"
    return _Named(title, first, system, shaking, study, study.case is not None)


def changed_assembly(assembly: Assembly, options: RigOptions) -> Assembly:
    """Return the assembly with the values that the options replace.

    Raises
    ------
    InputError
        If a path does not exist, or if a value is invalid.
    """
    values = new_values(assembly, options)
    for path, value in values.items():
        part, _, name = path.partition(".")
        if value is None and "." not in name and part in ("links", "stops", "forces"):
            continue  # a whole part is removed
        if value is None:
            raise InputError(
                f"--set: {path}=none; only a link, a stop or a force can be removed, such as "
                "stops.moat=none"
            )
        parameter(path, assembly, "--set")  # names the nearest
    removed = {path for path, value in values.items() if value is None}
    try:
        for path in removed:
            part, _, name = path.partition(".")
            kept = getattr(assembly, part)
            check_known(name, list(kept), part.removesuffix("s"), path)
            assembly = assembly.replace(**{part: {k: v for k, v in kept.items() if k != name}})
        return set_values(assembly, {k: v for k, v in values.items() if k not in removed})
    except InputError as error:
        raise InputError(f"--set: {error}") from None


def changed(
    oscillator: Oscillator, options: RigOptions, shaking: Repeated | Record | None = None
) -> Oscillator:
    """Return the oscillator with the values that the options replace.

    A new period keeps the damping ratio, unless a damping is set. The shaking scales a gap ratio.

    Raises
    ------
    InputError
        If a path does not exist, if a value is invalid, or if a new stop is not described
        completely.
    """
    values = new_values(oscillator, options)
    for one, other in _SAME:
        if one in values and other in values:
            raise InputError(
                f"--set: {one} and {other} set the same quantity; remove one of the two"
            )
    if "weight" in values:
        values["mass"] = to_si(values.pop("weight"), FORCE, "--set: weight", above=0.0) / GRAVITY
    derived = {name: text for name, text in values.items() if name in DERIVED}
    fields = {name: text for name, text in values.items() if name not in DERIVED}
    if "isolator_period" in derived and "mass" in fields and "isolator.damping" not in fields:
        derived.setdefault("damping_ratio", oscillator.damping_ratio)  # that of the old mass
    # A derived parameter keeps a damping ratio or a relaxation time, unless the damping is set.
    late = {name for name in fields if derived and name.endswith(".damping")}
    oscillator = _set(oscillator, {k: v for k, v in fields.items() if k not in late})
    for name in sorted(derived, key=turn):
        if turn(name) > 0:
            oscillator = _set(oscillator, {k: fields[k] for k in late})
            late = set()
        rig = Rig.of_open_frequency(oscillator, shaking)
        varied = parameter(name, rig, "--set")
        limits: dict[str, Any] = {"minimum": varied.least} if varied.zero else {"above": 0.0}
        value = to_si(derived[name], varied.quantity, f"--set: {name}", **limits)
        try:
            varied.read(rig)
        except InputError as error:
            raise InputError(f"--set: {str(error).removeprefix('parameter: ')}") from None
        oscillator = varied.vary(rig, value).oscillator
    return _set(oscillator, {k: fields[k] for k in late})


_SAME = (
    ("isolator_period", "isolator.stiffness"),
    ("damping_ratio", "isolator.damping"),
    ("weight", "mass"),
)
"""Pairs of paths that set the same quantity."""


def new_values(system: System, options: RigOptions) -> dict[str, Any]:
    """Return the values of the options by path. "none" removes a part.

    Raises
    ------
    InputError
        If a path is set twice.
    """
    found: dict[str, Any] = {}
    known = list(parameters(Rig(system)))
    known += [] if isinstance(system, Assembly) else PARAMETERS
    for path, text in by_path("--set", options.values).items():
        name = canonical(path, known)
        if name in ("amplitude", "frequency"):
            raise InputError(f"--set: {path!r} is that of the shaking; use --{name}")
        if name in found or (name == "gap" and options.gap is not None):
            raise InputError(f"--set: {path!r} is given twice; remove one of the two")
        found[name] = None if text.lower() == "none" else text
    for part in (path for path, value in found.items() if value is None):
        for path in found:
            if path.removeprefix("stops.").startswith(f"{part.removeprefix('stops.')}."):
                raise InputError(
                    f"--set: {path.removeprefix('stops.')}: the part is removed by {part}=none; "
                    "remove one of the two"
                )
    # A value of one side replaces that of both.
    both = {} if options.gap is None else {"gap": options.gap}
    return {**both, **dict(sorted(found.items(), key=lambda item: item[0].count(".")))}


def _set(oscillator: Oscillator, values: dict[str, Any]) -> Oscillator:
    """Set values by path. Errors name the option."""
    if not values:
        return oscillator
    rig = Rig(oscillator)
    for path in values:
        first, _, field = path.rpartition(".")
        part = getattr(oscillator, first.removeprefix("stops."), None)
        keys = type(part).table_keys() if isinstance(part, Model) else []
        whole = path.removeprefix("stops.") in ("isolator", "right", "left")
        absent = first in ("right", "left", "stops.right", "stops.left")
        shared = path in PARAMETERS and (first == "stops" or path == "gap")
        if not (whole or absent or shared or field in keys):
            parameter(path, rig, "--set")  # names the nearest
    try:
        return set_values(oscillator, values)
    except InputError as error:
        path, _, rest = str(error).partition(": ")
        if "gap" in values and path in ("right.gap", "left.gap") and f"stops.{path}" not in values:
            raise InputError(f"gap: {rest}") from None
        raise InputError(f"--set: {error}") from None
