"""The rig of a command: a laboratory case or a study file, with the values that options replace."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

from vibroimpact.cli.options import RigOptions, by_path
from vibroimpact.cli.study import SimulateTable, Study, SweepTable, read_study
from vibroimpact.errors import InputError
from vibroimpact.model import (
    GRAVITY,
    Harmonic,
    Oscillator,
    Periodic,
    Record,
    Repeated,
    laboratory,
)
from vibroimpact.model.assembly import Assembly
from vibroimpact.model.excitation import QUANTITIES, sized
from vibroimpact.model.laboratory import Parameters
from vibroimpact.model.names import check_name, file_stem, kept_letters, literal
from vibroimpact.model.parameters import canonical, check_units_kept, parameters, set_values
from vibroimpact.model.periodic_shaking import as_periodic, is_nothing
from vibroimpact.model.quantities import LENGTH
from vibroimpact.model.rig import Rig, one_mass_only, several_masses_only, with_stated_units
from vibroimpact.model.stated_units import has_unit
from vibroimpact.model.system import System
from vibroimpact.model.units import pretty, to_si
from vibroimpact.model.written_units import NONE, unitless, write_for
from vibroimpact.response.plausibility import doubt_stops

SEVERAL_MASSES = (
    "show",
    "simulate",
    "sweep",
    "branch",
    "bifurcation",
    "curve",
    "motion",
    "basins",
    "earthquake",
    "design",
    "ensemble",
)
"""Commands that accept an assembly, which pass ``masses=True`` to `subject`."""


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
        return one_mass_only(self.system)

    @property
    def assembly(self) -> Assembly:
        """The assembly of a command that accepts only several masses."""
        return several_masses_only(self.system)

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

    def refuse_of_masses(self, **options: Any) -> None:
        """Refuse options that only a rig of one mass has, if this one has several masses.

        Raises
        ------
        InputError
            If it has, and one of the options has a value.
        """
        for option, value in options.items() if self.system.by_mass else ():
            if value is not None and value is not False:
                words = "set" if value is True else repr(value)
                raise InputError(
                    f"--{option}: {words}, but {self.name!r} has several masses, for which this "
                    f"option is not available; remove --{option}"
                )

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
    original = _named(text, options)
    if original.system.by_mass and not masses:
        raise InputError(
            f"study {text!r}: assembly: this command computes one mass, not an assembly of several "
            f"masses; use vibroimpact {', '.join(SEVERAL_MASSES[:-1])} or {SEVERAL_MASSES[-1]}"
        )
    if shaken is not None:
        original = original._replace(shaking=shaken)

    values = stated(options)

    def rig_of(values: Mapping[str, str]) -> tuple[System, Repeated | Record | None]:
        fields = dict(values)
        amplitude, shaking = fields.pop("amplitude", None), original.shaking
        if amplitude is not None:
            shaking = _of_size(shaking, amplitude, original.system.units == NONE)
        system = changed(original.system, fields, otherwise if shaking is None else shaking)
        named = {f"--{k}" if k in _OWN else f"--set: {k}": text for k, text in values.items()}
        return with_stated_units(system, named), shaking

    system, shaking = rig_of(values)
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
    made = [_change(path, text, system) for path, text in _effective(values, rig_of).items()]
    what = Subject(
        ", ".join((original.title, *(change.words for change in made))),
        file_stem(
            check_name(name, "--name")
            if name
            else "-".join((original.slug, *(c.slug for c in made)))
        ),
        system,
        shaking,
        original.study,
        original.case and system.angular_frequency == original.system.angular_frequency,
    )
    doubt_stops(Rig(system, what.shaking))
    return what


_OWN = ("amplitude", "gap")
"""Paths that have an option of their own."""


def stated(options: RigOptions) -> dict[str, str]:
    """Return the values of the options by path."""
    gap = () if options.gap is None else (f"gap={options.gap}",)
    if options.gap is not None and options.gap.lower() != "none":
        to_si(options.gap, LENGTH, "--gap")  # an error below would name a path
    values = by_path("--set", (*gap, *options.values))
    for path in values:
        if (name := path.rpartition(".")[2]) in ("amplitude", "frequency"):
            raise InputError(f"--set: {path!r} is that of the shaking; use --{name}")
    return values if options.amplitude is None else {"amplitude": options.amplitude, **values}


def _effective(
    values: Mapping[str, str], rig_of: Callable[[Mapping[str, str]], object]
) -> dict[str, str]:
    """Return the values without which the rig would be another one."""
    wanted, kept = rig_of(values), dict(values)
    # Start with the last: if the value of all stops is set, that of one may be superfluous.
    for path in reversed([*values]):
        without = {other: text for other, text in kept.items() if other != path}
        with suppress(InputError):  # a new stop requires all its values
            kept = without if rig_of(without) == wanted else kept
    return kept


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
    periodic, _ = as_periodic(amplitude, "--amplitude", kept)
    if shaking is None:
        return periodic
    on = None if periodic.moves_base else shaking.on
    return periodic.replace(phase=shaking.phase, on=on)


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


def _of_case(code: str, parameters: Parameters | None) -> _Named:
    case = laboratory.case(code, parameters or "table")
    title, slug = case.code, case.slug
    if parameters not in (None, "table"):
        # Two parameter sets of one test are two rigs. They must not overwrite each other's files.
        title, slug = f"{title}, {parameters} parameters", f"{slug}-{parameters}"
    return _Named(title, slug, case.oscillator, Harmonic(case.amplitude, 1.0), None, True)


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


def changed(
    system: System, values: Mapping[str, str], shaking: Repeated | Record | None = None
) -> System:
    """Return the system with the values of options by path; "none" removes a part.

    Raises
    ------
    InputError
        If a path does not exist, if a value is invalid, if a new stop is not described completely,
        or if an exponent is set without a number whose unit depends on it.
    """
    read = {path: None if text.lower() == "none" else text for path, text in values.items()}
    try:
        made = set_values(Rig.of_open_frequency(system, shaking), read).system
        check_units_kept(system, made, read)
        return made
    except InputError as error:
        raise InputError(f"--set: {str(error).removeprefix('parameter: ')}") from None


class _Change(NamedTuple):
    """An option that changes the rig."""

    words: str
    """Text in titles, such as "left gap 9 mm"."""
    slug: str
    """Text in file names, such as "left-gap-9mm"."""


def _change(path: str, value: str, system: System) -> _Change:
    """Describe an option by its path, without the kind of a part that has a name of its own."""
    known = parameters(Rig(system))
    name = canonical(path, known)
    kind, _, part = name.rpartition(".")
    text = value
    if value.lower() == "none":
        of = _KINDS.get(kind, "stop" if part in ("right", "left") else "")
        words, text = "no", f"{of} {part}" if system.by_mass else f"{part} {of}"
        text = " ".join(re.split(r"[ _-]+", text.strip()))
    elif name == "amplitude":
        words, (size, of) = name, sized(value, None, path)
        in_g = of == "acceleration" and not unitless()
        text = f"{size / GRAVITY:.6g} g" if in_g else pretty(size, QUANTITIES[of])
    else:
        words = name.partition(".")[2] if "." in kind or kind == "forces" else name
        words = re.sub(r"[._-]", " ", words.replace("masses.", "mass "))
        if name in known:
            text = pretty(to_si(value, known[name].quantity, path), known[name].quantity)
    slug = f"{words} {text}" if words == "no" else f"{words} {text.replace(' ', '')}"
    return _Change(f"{words} {text}", kept_letters(slug.replace(" ", "-")))


_KINDS = {"masses": "mass", "links": "link", "stops": "stop", "forces": "force"}
"""Parts of a rig in paths, and their names in titles."""
