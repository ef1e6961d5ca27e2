"""The rig of a study file in TOML: a laboratory case, an oscillator or an assembly.

The tables of the commands, such as ``[sweep]``, are read by `vibroimpact.cli.study`.
"""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Self, TypeVar

from pydantic import Field, model_validator

from vibroimpact.errors import InputError, errors_at, printable
from vibroimpact.model import laboratory
from vibroimpact.model.assembly import Assembly
from vibroimpact.model.excitation import Harmonic, Of, Periodic, Repeated
from vibroimpact.model.laboratory import Parameters
from vibroimpact.model.names import check_name
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.periodic_shaking import as_periodic, is_nothing
from vibroimpact.model.quantities import ANGLE, TIME
from vibroimpact.model.record import Record
from vibroimpact.model.rig import Rig, with_stated_units
from vibroimpact.model.system import System
from vibroimpact.model.toml_text import quoted, toml
from vibroimpact.model.validation import Accepts, Model, validate
from vibroimpact.model.wrong_kinds import NumberOrText

_Study = TypeVar("_Study", bound="RigStudy")

_DEEPEST = 20
"""Largest number of levels of nested tables and lists in a study file."""
_DEEP = f"nests tables or lists more than {_DEEPEST} levels deep; use fewer levels"


class ExcitationTable(Model):
    """Table ``[excitation]``: the periodic shaking without its frequency, or the file of a record.

    The unit of an amplitude determines whether it is an acceleration, a displacement, a force or an
    unbalance. Without a unit, `of` determines it.
    The path of a record is relative to the study file. `component` is required if its file has
    several components. `step` (s), `unit` and `decimal` are required if the file does not state
    them. The unit may be a unit of length.
    """

    amplitude: NumberOrText | None = Field(
        None,
        examples=[
            'amplitude = "0.05 g" (one at all frequencies); for several harmonics, amplitudes = '
            '["1 mm", "2 mm"]; for one amplitude per frequency, use sweep in Python'
        ],
    )
    amplitudes: list[NumberOrText] | None = Field(
        None, examples=['amplitudes = ["1 mm", "0.5 mm"]']
    )
    phases: list[Annotated[float, Accepts(ANGLE)]] | None = Field(
        None, examples=['phases = ["0 deg", "90 deg"]']
    )
    of: Of | None = Field(None, examples=['of = "force"'])
    on: str | None = Field(None, examples=['on = "roof"'])
    phase: Annotated[float, Accepts(ANGLE)] = 0.0
    record: str | None = Field(None, examples=['record = "quake.csv"'])
    component: str | None = Field(None, examples=['component = "1"'])
    step: Annotated[float | None, Accepts(TIME, above=0.0, optional=True)] = None
    unit: str | None = Field(None, examples=['unit = "g"'])
    decimal: str | None = Field(None, examples=['decimal = ","'])

    @model_validator(mode="after")
    def _one_of_them(self) -> Self:
        ways = {name: getattr(self, name) for name in ("amplitude", "amplitudes", "record")}
        keys = [name for name, value in ways.items() if value is not None]
        if len(keys) > 1:
            raise InputError(f"{' and '.join(keys)} are given together; keep one of them")
        beside = dict.fromkeys(("component", "step", "unit", "decimal"), "record")
        for name, needs in (("phases", "amplitudes"), *beside.items()):
            if getattr(self, name) is not None and ways[needs] is None:
                raise InputError(f"{name} is given without {needs}; add {needs}, or remove {name}")
        for name in ("of", "on"):
            if getattr(self, name) is not None and (
                self.amplitude is None and self.amplitudes is None
            ):
                raise InputError(
                    f"{name} is given without amplitude; add amplitude, or remove {name}"
                )
        return self

    def shaking(self, folder: Path) -> Repeated | Record | None:
        """Return the shaking. The path of a record is relative to `folder`.

        Raises
        ------
        InputError
            If the record cannot be read, or if a value is invalid.
        """
        if self.record is not None:
            return Record.read(
                folder / self.record,
                self.component,
                unit=self.unit,
                step=self.step,
                decimal=self.decimal,
            )
        if self.amplitudes is not None:
            return Periodic(1.0, self.amplitudes, self.phases, self.phase, of=self.of, on=self.on)
        if self.amplitude is None or is_nothing(self.amplitude):
            return None
        shaken, _ = as_periodic(self.amplitude, "amplitude", self.of)
        return shaken.replace(phase=self.phase, on=self.on)


class RigStudy(Model):
    """A study file. The tables of the commands are not checked."""

    name: str | None = Field(None, examples=['name = "wall"'])
    case: str | None = Field(None, examples=['case = "B2-G1-A3"'])
    parameters: Parameters | None = None
    oscillator: Oscillator | None = None
    assembly: dict[str, Any] | None = Field(None, examples=["[assembly.masses]"])
    excitation: ExcitationTable = ExcitationTable()
    sweep: Any = None
    simulate: Any = None
    design: Any = None
    ensemble: Any = None

    @model_validator(mode="after")
    def _one_rig(self) -> Self:
        if self.name is not None:
            check_name(self.name, "name")
        systems = ("case", "oscillator", "assembly")
        keys = [name for name in systems if getattr(self, name) is not None]
        if not keys:
            raise InputError(
                'neither case nor oscillator is given; add case, such as case = "B2-G1-A3", or '
                "the table [oscillator] or [assembly]"
            )
        if len(keys) > 1:
            raise InputError(f"both {keys[0]} and {keys[1]} are given; remove one of them")
        if self.parameters is not None and self.case is None:
            raise InputError(
                "parameters: this key is only for a laboratory case; remove it, or replace the "
                'table [oscillator] by a case, such as case = "B2-G1-A3"'
            )
        return self

    def rig(self, path: Path, parameters: Parameters | None = None) -> Rig:
        """Return the rig of the study. The frequency of a periodic shaking is open.

        Parameters
        ----------
        path
            Path of the study file, to which the paths of records are relative.
        parameters
            Parameter set of a laboratory case. Default: the set in the study.

        Raises
        ------
        InputError
            If there is no such case, if a record cannot be read, or if a value is invalid.
        """
        where, name = f"study {str(path)!r}", self.name or printable(path.stem)
        with errors_at(f"{where}: excitation."):
            shaking = self.excitation.shaking(path.parent)
        if self.case is None:
            stated: dict[str, object] = {
                "excitation.amplitude": self.excitation.amplitude,
                "excitation.amplitudes": self.excitation.amplitudes,
                "excitation.record": shaking,
            }
            with errors_at(f"{where}: "):
                system = with_stated_units(self._system(path.parent), stated)
            try:
                return Rig.of_open_frequency(system, shaking, name)
            except InputError as error:  # the table of the shaking has another name
                raise InputError(
                    f"{where}: excitation{str(error).removeprefix('shaking')}"
                ) from None
        with errors_at(f"{where}: "):
            case = laboratory.case(self.case, parameters or self.parameters or "table")
        usual = Harmonic(case.amplitude, 1.0, phase=self.excitation.phase)
        return Rig.of_open_frequency(case.oscillator, shaking or usual, name)

    def _system(self, folder: Path) -> System:
        """Return the oscillator, or the assembly, whose matrices may be files in a folder."""
        if self.assembly is None:
            assert self.oscillator is not None  # one of the two is there
            return self.oscillator
        table = dict(self.assembly)
        if isinstance(table.get("matrices"), dict):
            table["matrices"] = {**table["matrices"], "folder": folder}
        return validate(Assembly, table, "assembly")


def study_text(rig: Rig, about: str = "") -> str:
    """Return the study file of a rig. Read again, it gives an equal rig with an open frequency.

    Parameters
    ----------
    rig
        The rig. Numbers are in SI units, with all digits.
    about
        Comment at the beginning of the file. Default: no comment.

    Raises
    ------
    InputError
        If a record shakes the rig, or if it has one amplitude per frequency of a sweep.
    """
    if isinstance(rig.shaking, Record):
        raise InputError(
            "shaking: a record cannot be written into a study file; write its file as "
            "excitation.record"
        )
    lines = [f"# {line}" for line in about.splitlines()]
    lines += [] if rig.name is None else [f"name = {quoted(rig.name)}", ""]
    for name, values in _tables(rig.system).items():
        lines += [f"[{name}]", *_lines(values), ""]
    if rig.shaking is not None:
        shaken = rig.periodic.model_dump()
        del shaken["frequency"]
        lines += ["[excitation]", *_lines(shaken), ""]
    return "\n".join(lines).rstrip() + "\n"


def _tables(system: System) -> dict[str, dict[str, Any]]:
    """Return the tables of a system by their names; those of several masses have one per part."""
    every = system.model_dump(exclude_none=True)
    parts = {name: one for name, one in every.items() if system.by_mass and isinstance(one, dict)}
    values = {name: one for name, one in every.items() if name not in parts}
    whole = {system.table_name: values} if values else {}
    return whole | {f"{system.table_name}.{name}": one for name, one in parts.items()}


def _lines(table: Mapping[str, Any]) -> list[str]:
    return [f"{key} = {toml(value)}" for key, value in table.items()]


def read_study(path: Path, kind: type[_Study]) -> _Study:
    """Read a study file.

    Parameters
    ----------
    kind
        Class of the study, which determines the tables that are read.

    Raises
    ------
    InputError
        If the file cannot be read, is not TOML, or has an unknown key or an invalid value. The
        message states the file and the path of the key.
    """
    try:
        # Some editors put a mark before the text, which "-sig" leaves out.
        data = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise InputError(
            f"study: {str(path)!r} cannot be read ({error.strerror or error}); "
            "pass the path of a study file, or the code of a case, such as B2-G1-A3"
        ) from None
    except UnicodeDecodeError:
        raise InputError(
            f"study: {str(path)!r} is not UTF-8 text; pass a TOML file that is saved in UTF-8"
        ) from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(
            f"study: {str(path)!r} is not valid TOML ({error}); correct the file there"
        ) from None
    except ValueError:  # Python reads no whole number of more than some thousand digits
        raise InputError(
            f"study: {str(path)!r} has a whole number of more than "
            f"{sys.get_int_max_str_digits()} digits; write a shorter number"
        ) from None
    except RecursionError:
        raise InputError(f"study: {str(path)!r} {_DEEP}") from None
    if _deeper(data, _DEEPEST):
        raise InputError(f"study: {str(path)!r} {_DEEP}")
    with errors_at(f"study {str(path)!r}: "):
        return validate(kind, data)


def _deeper(data: Any, levels: int) -> bool:
    """Whether tables and lists lie within each other more than so many levels deep."""
    nodes = [data]
    for _ in range(levels):
        inside = (part.values() if isinstance(part, dict) else part for part in nodes)
        nodes = [one for part in inside for one in part if isinstance(one, dict | list)]
    return bool(nodes)


def read_rig_study(path: Path) -> Rig:
    """Read the rig of a study file."""
    return read_study(path, RigStudy).rig(path)
