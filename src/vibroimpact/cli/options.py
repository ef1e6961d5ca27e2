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
"""Text that may be a file name: shells complete file names if a path is among the types."""

RigName: TypeAlias = Annotated[
    FileName,
    Parameter(
        name="CASE|STUDY.toml",
        help=(
            "The rig: the code of a laboratory case, or the path of a study file. A code is "
            "BUMPER-GAP-ACCELERATION. BUMPER is B1 to B4, or a stiffness. GAP is G1 to G4, a total "
            "gap (half of it is on each side), or Ginf for a rig without bumpers. "
            "ACCELERATION is A1 to A3, or a peak acceleration. Examples: B2-G1-A3, B3-10mm-A3, "
            "510kN/m-G1-0.05g."
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
"""A value with a unit, which may begin with a minus sign. The library function checks it."""
Pairs: TypeAlias = Annotated[
    tuple[tuple[str, str], ...], Parameter(allow_leading_hyphen=True, negative="")
]
"""An option with a name and a value, which may be repeated."""
Flag: TypeAlias = Annotated[bool, Parameter(negative="")]
Frequency: TypeAlias = Annotated[
    str | None,
    Parameter(
        allow_leading_hyphen=True,
        help="Forcing frequency, such as 2Hz. Default: "
        "the frequency in the study (table [simulate]).",
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
        help="Where the computation runs: threads, processes, or the address of a dask scheduler, "
        "such as tcp://10.0.0.1:8786. The choice does not affect the result.",
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
        help="Print only the summary, as JSON for other programs.",
    ),
]

_OfRig: TypeAlias = Annotated[str | None, Parameter(group=RIG, allow_leading_hyphen=True)]


def by_name(option: str, pairs: tuple[tuple[str, str], ...]) -> dict[str, str]:
    """Return the values of an option NAME VALUE that may be repeated, by name.

    Raises
    ------
    InputError
        If a name occurs twice.
    """
    found: dict[str, str] = {}
    for name, value in pairs:
        key = name.replace("-", "_")
        if key in found:
            raise InputError(f"{option}: {name!r} is given twice; each name is accepted once")
        found[key] = value
    return found


def stated(**options: Any) -> dict[str, Any]:
    """Return the options that have a value. The others get the defaults of the function."""
    return {name: value for name, value in options.items() if value is not None}


@Parameter(name="*")
@dataclass(frozen=True)
class RigOptions:
    """Options that replace values of the laboratory case or of the study."""

    parameters: Annotated[
        Literal["table", "identified", "refined"] | None, Parameter(group=RIG)
    ] = None
    """Parameter set of a laboratory case. table: the values in the table of the paper on these
    cases, for all cases. identified: fitted values, only for B2-G1-A3 and B2-G2-A2.
    refined: the same as table, but with a softening isolator, for all cases. Default: table."""
    amplitude: _OfRig = None
    """Amplitude of the shaking. Its unit selects the quantity: peak acceleration of the base (0.05g
    or 0.49m/s^2), peak displacement of the base (5mm), or peak force on the mass (120N)."""
    mass: _OfRig = None
    """Mass, such as 550kg or 5000t."""
    weight: _OfRig = None
    """Weight of the mass, such as 50MN. Replaces --mass."""
    stiffness: _OfRig = None
    """Stiffness of the isolator, such as 26.8kN/m."""
    damping: _OfRig = None
    """Damping of the isolator, such as '1.1 kN s/m'."""
    isolator_period: _OfRig = None
    """Natural period of the mass on the isolator, such as 2.5s. Replaces --stiffness. The damping
    ratio does not change."""
    damping_ratio: _OfRig = None
    """Damping ratio of the isolator, such as 0.15. Replaces --damping."""
    bumper_stiffness: _OfRig = None
    """Stiffness of both bumpers, such as 510kN/m."""
    bumper_damping: _OfRig = None
    """Damping of both bumpers, such as '0.9 kN s/m'."""
    gap: _OfRig = None
    """Gap on each side, such as 7.5mm. It is half the total gap of a case code."""
    right_stiffness: _OfRig = None
    """Stiffness of the right bumper, such as 510kN/m."""
    right_damping: _OfRig = None
    """Damping of the right bumper, such as '0.9 kN s/m'."""
    right_gap: _OfRig = None
    """Gap on the right side, such as 7.5mm."""
    left_stiffness: _OfRig = None
    """Stiffness of the left bumper, such as 510kN/m."""
    left_damping: _OfRig = None
    """Damping of the left bumper, such as '0.9 kN s/m'."""
    left_gap: _OfRig = None
    """Gap on the left side, such as 7.5mm."""
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
    """Options for the thresholds between scenarios."""

    prominence: _Threshold = None
    """Least prominence of a secondary resonance in the curve of η_a, the normalised excursion of
    the acceleration, as a share of the height of the resonance. A less prominent resonance is
    ignored. Default: 0.02."""
    extent: _Threshold = None
    """Least total width of secondary left hystereses and non-regular resonances in scenario S4, as
    a share of the natural frequency. Default: 0.08, the frequency step of the published tests."""
    touch: _Threshold = None
    """A contact counts as grazing only if the gap is at most this share smaller than the largest
    displacement without stops (default: 0.1)."""
    deformation: _Threshold = None
    """Largest penetration of a grazing contact, as a share of the gap (default: 0.1)."""

    def thresholds(self) -> Thresholds:
        """Return the thresholds. A threshold without an option has its default."""
        from vibroimpact.scenarios.thresholds import Thresholds

        own = {name: getattr(self, name) for name in Thresholds.names()}
        return Thresholds(**{name: value for name, value in own.items() if value is not None})


@Parameter(name="*")
@dataclass(frozen=True)
class OutputOptions:
    """Options for the files, and for the printed summary."""

    output: OutputFolder = "out"
    """Folder for the files, which is created if it does not exist (default: out)."""
    name: Annotated[str | None, Parameter(group=OUTPUT)] = None
    """NAME, with which the names of all files begin (default: the name of the rig or record)."""
    figure: Annotated[Literal["png", "pdf", "svg"], Parameter(group=OUTPUT, show_default=False)] = (
        "png"
    )
    """File format of the figure (default: png)."""
    json: Json = False


AS_DESCRIBED = RigOptions()
"""No option changes the rig."""
DEFAULT_OUTPUT = OutputOptions()
DEFAULT_THRESHOLDS = ThresholdOptions()
