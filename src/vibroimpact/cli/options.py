"""Options that commands share."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from cyclopts import Group, Parameter, Token

from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.model import Record
    from vibroimpact.scenarios.thresholds import Thresholds

RIG = Group("Rig (replacing values of the case or study)", sort_key=2)
READING = Group("Reading of records (instead of what the files say)", sort_key=1)
COMPUTATION = Group("Computation", sort_key=3)
THRESHOLDS = Group("Thresholds", sort_key=3)
OUTPUT = Group("Output", sort_key=4)

# A text with units may begin with a minus sign: the model says what is wrong with it.
_RIG = Parameter(group=RIG, allow_leading_hyphen=True)

if TYPE_CHECKING:
    FileName: TypeAlias = str
else:
    FileName: TypeAlias = str | Path
"""Text that may name a file: shells complete file names where a path is among the types."""

RigName: TypeAlias = Annotated[
    FileName,
    Parameter(
        name="CASE|STUDY.toml",
        help=(
            "Case code, bumper-gap-acceleration: B1 to B4 or a stiffness, G1 to G4 or a total gap "
            "(shared equally by the two sides), A1 to A3 or an acceleration; such as B2-G1-A3, "
            "B3-10mm-A3, 510kN/m-G1-0.05g; Ginf is without bumpers. Or a study file."
        ),
    ),
]


def _whole(_type: Any, tokens: Sequence[Token]) -> int:
    """Read a whole number; cyclopts would cut 1.5 down to 1."""
    text = tokens[0].value
    try:
        number = float(text)
        whole = int(number)
    except (ValueError, OverflowError):
        whole, number = 0, 0.5
    if whole != number:
        raise ValueError(f"{text!r} is not a whole number")
    return whole


Whole: TypeAlias = Annotated[int, Parameter(converter=_whole)]
Where: TypeAlias = Annotated[
    str,
    Parameter(
        group=COMPUTATION,
        help="threads, processes, or the address of a dask scheduler, such as tcp://10.0.0.1:8786.",
    ),
]


@Parameter(name="*")
@dataclass(frozen=True)
class RigOptions:
    """What replaces values of the case or study."""

    parameters: Annotated[
        Literal["table", "identified", "refined"] | None,
        Parameter(
            group=RIG,
            help=(
                "Parameter set of a case: 'table' (every case; the default), 'identified' "
                "(fitted, for B2-G1-A3 and B2-G2-A2) or 'refined' (every case, on an isolator "
                "that softens by itself)."
            ),
        ),
    ] = None
    amplitude: Annotated[
        str | None,
        _RIG,
        Parameter(
            help=(
                "Peak base acceleration, such as 0.05g (gravity) or 0.49m/s^2; or displacement of "
                "the base, such as 5mm; or force on the mass, such as 120N."
            )
        ),
    ] = None
    mass: Annotated[str | None, _RIG, Parameter(help="Mass, such as 550kg or 5000t.")] = None
    weight: Annotated[
        str | None, _RIG, Parameter(help="Weight instead of the mass, such as 50MN.")
    ] = None
    stiffness: Annotated[
        str | None, _RIG, Parameter(help="Stiffness of the isolator, such as 26.8kN/m.")
    ] = None
    damping: Annotated[
        str | None, _RIG, Parameter(help="Damping of the isolator, such as '1.1 kN s/m'.")
    ] = None
    isolator_period: Annotated[
        str | None,
        _RIG,
        Parameter(
            help=(
                "Natural period on the isolator instead of its stiffness, such as 2.5s; the "
                "damping ratio stays as it was."
            )
        ),
    ] = None
    damping_ratio: Annotated[
        str | None,
        _RIG,
        Parameter(help="Damping ratio of the isolator instead of its damping, such as 0.15."),
    ] = None
    bumper_stiffness: Annotated[
        str | None, _RIG, Parameter(help="Stiffness of both bumpers, such as 510kN/m.")
    ] = None
    bumper_damping: Annotated[
        str | None, _RIG, Parameter(help="Damping of both bumpers, such as '0.9 kN s/m'.")
    ] = None
    gap: Annotated[
        str | None,
        _RIG,
        Parameter(help="Gap of each side (half the total gap of a case code), such as 7.5mm."),
    ] = None
    right_stiffness: Annotated[
        str | None, _RIG, Parameter(help="Stiffness of the right bumper.")
    ] = None
    right_damping: Annotated[str | None, _RIG, Parameter(help="Damping of the right bumper.")] = (
        None
    )
    right_gap: Annotated[str | None, _RIG, Parameter(help="Gap of the right side.")] = None
    left_stiffness: Annotated[str | None, _RIG, Parameter(help="Stiffness of the left bumper.")] = (
        None
    )
    left_damping: Annotated[str | None, _RIG, Parameter(help="Damping of the left bumper.")] = None
    left_gap: Annotated[str | None, _RIG, Parameter(help="Gap of the left side.")] = None
    no_right: Annotated[
        bool,
        Parameter(group=RIG, negative="", show_default=False, help="Take the right bumper away."),
    ] = False
    no_left: Annotated[
        bool,
        Parameter(group=RIG, negative="", show_default=False, help="Take the left bumper away."),
    ] = False


_THRESHOLD = Parameter(group=THRESHOLDS, allow_leading_hyphen=True)


@Parameter(name="*")
@dataclass(frozen=True)
class ThresholdOptions:
    """Where one scenario ends and the next begins."""

    prominence: Annotated[
        float | None,
        _THRESHOLD,
        Parameter(
            help="Least prominence of a secondary resonance in η_a, as a share of its height; 0.02."
        ),
    ] = None
    extent: Annotated[
        float | None,
        _THRESHOLD,
        Parameter(
            help=(
                "Least width of secondary left hystereses and non-regular resonances together, as "
                "a share of the natural frequency; 0.08, the step of the published tests."
            )
        ),
    ] = None
    touch: Annotated[
        float | None,
        _THRESHOLD,
        Parameter(help="Largest 1 - δ0 of a grazing contact; 0.1."),
    ] = None
    deformation: Annotated[
        float | None,
        _THRESHOLD,
        Parameter(help="Largest penetration of a grazing contact, as a share of the gap; 0.1."),
    ] = None

    def thresholds(self) -> Thresholds:
        """Return the thresholds, those that are not given at their defaults."""
        from vibroimpact.scenarios.thresholds import Thresholds

        given = {name: getattr(self, name) for name in Thresholds.names()}
        try:
            return Thresholds(**{name: v for name, v in given.items() if v is not None})
        except InputError as error:
            raise InputError(f"--{error}") from None


@Parameter(name="*")
@dataclass(frozen=True)
class RecordOptions:
    """What is said of files of records in place of what they say themselves."""

    component: Annotated[
        str | None,
        Parameter(
            group=READING,
            help=(
                "Which of several: its name in the file, such as 90, Up or HNE, or its number. "
                "One for all records, or one for each, as 90,Up."
            ),
        ),
    ] = None
    unit: Annotated[
        str | None,
        Parameter(
            group=READING,
            help=(
                "Of the values, such as g or cm/s^2; a length, such as mm, is differentiated. One "
                "for all records, or one for each."
            ),
        ),
    ] = None
    step: Annotated[
        str | None,
        Parameter(
            group=READING,
            allow_leading_hyphen=True,
            help=(
                "Time between samples, such as 10ms; replaces the times of a file. One for all "
                "records, or one for each."
            ),
        ),
    ] = None
    decimal: Annotated[
        Literal[".", ","] | None,
        Parameter(group=READING, help="Decimal mark of a table, where it does not tell by itself."),
    ] = None

    def said(self) -> dict[str, Any]:
        """Options that are the same for all files; the component is not among them."""
        return {"unit": self.unit, "step": self.step, "decimal": self.decimal}

    def read(self, files: Iterable[str]) -> dict[str, Record]:
        """Read the files of records, by their names.

        Raises
        ------
        InputError
            If one cannot be read, or two have one name.
        """
        from vibroimpact.model import Record

        found: dict[str, Record] = {}
        names = list(files)
        options = (("--component", self.component), ("--unit", self.unit), ("--step", self.step))
        said = (one_or_each(option, text, len(names)) for option, text in options)
        for file, *own in dict.fromkeys(zip(names, *said, strict=True)):
            component, unit, step = own
            name = record_name(file, component)
            if name in found:
                raise InputError(
                    f"RECORD: {file!r} has the name of another one; files of different names are "
                    "accepted"
                )
            found[name] = Record.read(file, component, unit=unit, step=step, decimal=self.decimal)
        return found


def one_or_each(option: str, text: str | None, count: int) -> list[str | None]:
    """One text for all of so many records, or one for each, separated by commas.

    Raises
    ------
    InputError
        If there are more than one, and not as many as records.
    """
    parts: list[str | None] = [text]
    if text is not None and count > 1:
        parts = [part.strip() for part in text.split(",")]
    if len(parts) not in (1, count):
        raise InputError(
            f"{option}: {text!r} are {len(parts)} for {count} records; one for all, or one for "
            "each, is accepted"
        )
    return parts if len(parts) == count else parts * count


def record_name(file: str, component: str | None) -> str:
    """What a record is called: its file, and its component if that was chosen."""
    return " ".join([Path(file).name.removesuffix(".gz"), *([component] if component else [])])


@Parameter(name="*")
@dataclass(frozen=True)
class OutputOptions:
    """Where results go, and how they are told."""

    output: Annotated[
        FileName,
        Parameter(
            name=["--output", "-o"],
            group=OUTPUT,
            help="Folder for the files; made if it does not exist.",
        ),
    ] = "out"
    name: Annotated[
        str | None,
        Parameter(group=OUTPUT, help="Beginning of the files' names; by default the rig's name."),
    ] = None
    figure: Annotated[
        Literal["png", "pdf", "svg"], Parameter(group=OUTPUT, help="Format of the figure.")
    ] = "png"
    json: Annotated[
        bool,
        Parameter(
            group=OUTPUT,
            negative="",
            show_default=False,
            help="Print the summary as JSON, for other programs, and nothing else.",
        ),
    ] = False
