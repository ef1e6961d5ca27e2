"""Options that commands share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from cyclopts import Group, Parameter, Token

from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.scenarios.thresholds import Thresholds

RIG = Group("Rig (default of each option: the value of the case or study)", sort_key=2)
COMPUTATION = Group("Computation", sort_key=3)
THRESHOLDS = Group("Thresholds", sort_key=3)
OUTPUT = Group("Output", sort_key=4)

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
            "Code of a laboratory case, or a study file. A code is BUMPER-GAP-ACCELERATION: B1 to "
            "B4 or a stiffness, G1 to G4 or a total gap (divided equally between the two sides), "
            "A1 to A3 or an acceleration. Examples: B2-G1-A3, B3-10mm-A3, 510kN/m-G1-0.05g. Ginf "
            "means without bumpers."
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
Text: TypeAlias = Annotated[str | None, Parameter(allow_leading_hyphen=True)]
"""A value with a unit; it may begin with a minus sign, and the library function checks it."""
Pairs: TypeAlias = Annotated[
    tuple[tuple[str, str], ...], Parameter(allow_leading_hyphen=True, negative="")
]
"""An option that may be repeated, with a name and a value."""
Flag: TypeAlias = Annotated[bool, Parameter(negative="")]
Frequency: TypeAlias = Annotated[
    str | None,
    Parameter(
        allow_leading_hyphen=True,
        help="Forcing frequency, such as 2Hz. Default: that of the study ([simulate]).",
    ),
]
Threads: TypeAlias = Annotated[
    Whole | None,
    Parameter(group=COMPUTATION, help="Number of threads (default: one per processor)."),
]
Where: TypeAlias = Annotated[
    str,
    Parameter(
        group=COMPUTATION,
        help="Where the work is done: threads, processes, or the address of a dask scheduler, such "
        "as tcp://10.0.0.1:8786.",
    ),
]
Physical: TypeAlias = Annotated[bool, Parameter(group=OUTPUT, negative="")]
OutputFolder: TypeAlias = Annotated[
    FileName, Parameter(name=["--output", "-o"], group=OUTPUT, show_default=False)
]
Json: TypeAlias = Annotated[
    bool,
    Parameter(
        group=OUTPUT,
        negative="",
        show_default=False,
        help="Print the summary as JSON and nothing else, for other programs.",
    ),
]

_OfRig: TypeAlias = Annotated[str | None, Parameter(group=RIG, allow_leading_hyphen=True)]


def by_name(option: str, pairs: tuple[tuple[str, str], ...]) -> dict[str, str]:
    """Return the pairs NAME VALUE of an option that may be repeated.

    Raises
    ------
    InputError
        If a name is there twice.
    """
    found: dict[str, str] = {}
    for name, value in pairs:
        key = name.replace("-", "_")
        if key in found:
            raise InputError(f"{option}: {name!r} is given twice; once is accepted")
        found[key] = value
    return found


def stated(**options: Any) -> dict[str, Any]:
    """Return the options that have a value; the others get the defaults of the function."""
    return {name: value for name, value in options.items() if value is not None}


@Parameter(name="*")
@dataclass(frozen=True)
class RigOptions:
    """Options that replace values of the case or study."""

    parameters: Annotated[
        Literal["table", "identified", "refined"] | None, Parameter(group=RIG)
    ] = None
    """Parameter set of a laboratory case: table (all cases), identified (fitted; B2-G1-A3 and
    B2-G2-A2) or refined (all cases, with a softening isolator). Default: table."""
    amplitude: _OfRig = None
    """Peak base acceleration, such as 0.05g or 0.49m/s^2; or displacement of the base, such as 5mm;
    or force on the mass, such as 120N."""
    mass: _OfRig = None
    """Mass, such as 550kg or 5000t."""
    weight: _OfRig = None
    """Weight, such as 50MN. Replaces --mass."""
    stiffness: _OfRig = None
    """Stiffness of the isolator, such as 26.8kN/m."""
    damping: _OfRig = None
    """Damping of the isolator, such as '1.1 kN s/m'."""
    isolator_period: _OfRig = None
    """Natural period on the isolator, such as 2.5s. Replaces --stiffness; the damping ratio does
    not change."""
    damping_ratio: _OfRig = None
    """Damping ratio of the isolator, such as 0.15. Replaces --damping."""
    bumper_stiffness: _OfRig = None
    """Stiffness of both bumpers, such as 510kN/m."""
    bumper_damping: _OfRig = None
    """Damping of both bumpers, such as '0.9 kN s/m'."""
    gap: _OfRig = None
    """Gap of each side (half the total gap of a case code), such as 7.5mm."""
    right_stiffness: _OfRig = None
    """Stiffness of the right bumper."""
    right_damping: _OfRig = None
    """Damping of the right bumper."""
    right_gap: _OfRig = None
    """Gap of the right side."""
    left_stiffness: _OfRig = None
    """Stiffness of the left bumper."""
    left_damping: _OfRig = None
    """Damping of the left bumper."""
    left_gap: _OfRig = None
    """Gap of the left side."""
    no_right: Annotated[bool, Parameter(group=RIG, negative="", show_default=False)] = False
    """Remove the right bumper."""
    no_left: Annotated[bool, Parameter(group=RIG, negative="", show_default=False)] = False
    """Remove the left bumper."""


_Threshold: TypeAlias = Annotated[
    float | None, Parameter(group=THRESHOLDS, allow_leading_hyphen=True)
]


@Parameter(name="*")
@dataclass(frozen=True)
class ThresholdOptions:
    """Where one scenario ends and the next begins."""

    prominence: _Threshold = None
    """Least prominence of a secondary resonance in η_a, as a share of its height (default:
    0.02)."""
    extent: _Threshold = None
    """Least total width of secondary left hystereses and non-regular resonances, as a share of the
    natural frequency. Default: 0.08, the step of the published tests."""
    touch: _Threshold = None
    """Largest 1 - δ0 of a grazing contact (default: 0.1)."""
    deformation: _Threshold = None
    """Largest penetration of a grazing contact, as a share of the gap (default: 0.1)."""

    def thresholds(self) -> Thresholds:
        """Return the thresholds; those without an option have their defaults."""
        from vibroimpact.scenarios.thresholds import Thresholds

        own = {name: getattr(self, name) for name in Thresholds.names()}
        return Thresholds(**{name: value for name, value in own.items() if value is not None})


@Parameter(name="*")
@dataclass(frozen=True)
class OutputOptions:
    """Where results are written, and how they are printed."""

    output: OutputFolder = "out"
    """Folder for the files; it is created if needed (default: out)."""
    name: Annotated[str | None, Parameter(group=OUTPUT)] = None
    """Beginning of the names of the files (default: name of the rig)."""
    figure: Annotated[Literal["png", "pdf", "svg"], Parameter(group=OUTPUT, show_default=False)] = (
        "png"
    )
    """File format of the figure (default: png)."""
    json: Json = False


AS_DESCRIBED = RigOptions()
"""The rig without changes."""
DEFAULT_OUTPUT = OutputOptions()
DEFAULT_THRESHOLDS = ThresholdOptions()
