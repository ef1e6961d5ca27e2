"""Options that commands share."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from cyclopts import Group, Parameter, Token

import vibroimpact as vi
from vibroimpact.errors import InputError

RIG = Group("Rig (details: vibroimpact help rigs)", sort_key=2)
COMPUTATION = Group("Computation", sort_key=3)
THRESHOLDS = Group("Thresholds", sort_key=3)
OUTPUT = Group("Output (details: vibroimpact help output)", sort_key=4)

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
            "Code of a laboratory case, such as B2-G1-A3, or path of a study file. Details: "
            "vibroimpact help rigs."
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
Paths: TypeAlias = Annotated[
    tuple[str, ...], Parameter(allow_leading_hyphen=False, negative="", consume_multiple=False)
]
"""An option PATH=TEXT, which may be repeated."""
Pairs: TypeAlias = Annotated[
    tuple[tuple[str, str], ...], Parameter(allow_leading_hyphen=True, negative="")
]
"""An option with a name and a value, which may be repeated."""
Flag: TypeAlias = Annotated[bool, Parameter(negative="")]
Frequency: TypeAlias = Annotated[
    str | None,
    Parameter(
        allow_leading_hyphen=True,
        help="Forcing frequency, such as 2Hz. Default: the frequency in the study file (table "
        "[simulate]). If there is none, the option is required, unless a record shakes the rig.",
    ),
]
Compute: TypeAlias = Annotated[
    tuple[str, ...],
    Parameter(
        negative="",
        help="Compute an own output of each motion, such as 'power [W] = "
        "mean(isolator.damping*velocity**2)': its name, its units, and a formula of time "
        "histories, numbers of the rig, and max, min, mean, rms and integral over one period. The "
        "option may be repeated.",
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
        help="Where the computation runs: threads or processes (on this machine), or the address "
        "of the scheduler of a dask cluster, such as tcp://10.0.0.1:8786. The choice does not "
        "affect the result.",
    ),
]
Physical: TypeAlias = Annotated[
    bool | None, Parameter(group=OUTPUT, negative="--normalised", show_default=False)
]
OutputFolder: TypeAlias = Annotated[
    FileName, Parameter(name=["--output", "-o"], group=OUTPUT, show_default=False)
]
Json: TypeAlias = Annotated[
    bool,
    Parameter(
        group=OUTPUT,
        negative="",
        show_default=False,
        help="Print the summary as JSON, and nothing else.",
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
    values: dict[str, str] = {}
    for name, value in pairs:
        base, dot, part = name.partition(".")
        key = base.replace("-", "_") + dot + part
        if key in values:
            raise InputError(f"{option}: {name!r} is given twice; remove one of the two")
        values[key] = value
    return values


def by_path(option: str, texts: Sequence[str]) -> dict[str, str]:
    """Return the values of an option PATH=TEXT that may be repeated, by path.

    Raises
    ------
    InputError
        If a text has no ``=``, or if a path occurs twice.
    """
    values: dict[str, str] = {}
    for text in texts:
        path, equals, value = (part.strip() for part in text.partition("="))
        if not (path and equals and value):
            raise InputError(f"{option}: {text!r}; pass PATH=VALUE in one word, such as gap=9mm")
        if path in values:
            raise InputError(f"{option}: {path!r} is given twice; remove one of the two")
        values[path] = value
    return values


_OUTPUT = re.compile(r"\s*(\w+)\s*(?:\[([^\]]*)\])?\s*=(?!=)\s*(.+)", re.DOTALL)


def own_outputs(texts: Iterable[str]) -> dict[str, vi.Output] | None:
    """Read outputs such as ``power [W] = mean(isolator.damping*velocity**2)``, or return None.

    Raises
    ------
    InputError
        If a text is not a name with a formula.
    """
    outputs: dict[str, vi.Output] = {}
    for text in texts:
        match = _OUTPUT.fullmatch(text)
        if match is None:
            raise InputError(
                f"--compute: {text!r} is not a name with a formula; write it as 'power [W] = "
                "mean(isolator.damping*velocity**2)'"
            )
        name, units, formula = match.groups()
        if name in outputs:
            raise InputError(f"--compute: {name!r} is given twice; remove one of the two")
        outputs[name] = vi.Output(formula, units=(units or "").strip() or "1")
    return outputs or None


def stated(**options: Any) -> dict[str, Any]:
    """Return the options that have a value. The others get the defaults of the function."""
    return {name: value for name, value in options.items() if value is not None}


@Parameter(name="*")
@dataclass(frozen=True)
class RigOptions:
    """Options that replace values of the case or study file; `topics.py` explains them."""

    parameters: Annotated[
        Literal["table", "identified", "refined"] | None, Parameter(group=RIG)
    ] = None
    """Parameter set of a laboratory case. Default: that of the study file, or table."""
    amplitude: _OfRig = None
    """Amplitude of the shaking, such as 0.05g, 5mm or 120N."""
    gap: _OfRig = None
    """Gap on each side, such as 7.5mm."""
    values: Annotated[
        tuple[str, ...],
        Parameter(name="--set", group=RIG, negative="", consume_multiple=False, show_default=False),
    ] = ()
    """Another value, PATH=VALUE, such as mass=550kg or left=none. May be repeated."""


_Threshold: TypeAlias = Annotated[
    float | None, Parameter(group=THRESHOLDS, allow_leading_hyphen=True)
]


@Parameter(name="*")
@dataclass(frozen=True)
class ThresholdOptions:
    """Options for the thresholds between scenarios."""

    prominence: _Threshold = None
    """Smallest prominence of a secondary resonance, as a share of the height of its peak. The
    prominence is the height of the peak above the neighbouring parts of the acceleration curve.
    Peaks with a smaller prominence are not counted. Default: 0.02."""
    extent: _Threshold = None
    """Smallest extent in scenario S4. The extent is the total width of all left hystereses and
    non-regular resonances below the primary resonance, divided by the natural frequency. If it is
    smaller than this limit, the scenario is not S4. Default: 0.08, about the frequency step of
    the published tests (0.1 Hz) divided by their natural frequencies."""
    touch: _Threshold = None
    """Largest value of (1 − gap ratio) at which a contact counts as grazing (scenario S1). The gap
    ratio is the gap divided by the largest displacement without bumpers. Default: 0.1."""
    deformation: _Threshold = None
    """Largest penetration in scenario S1 (grazing), divided by the gap. The penetration is the
    deformation of the bumper. If the penetration divided by the gap is larger than this limit, a
    contact does not count as grazing. Default: 0.1."""

    def thresholds(self) -> vi.Thresholds:
        """Return the thresholds. A threshold without an option has its default."""
        return vi.Thresholds(**stated(**vars(self)))


@Parameter(name="*")
@dataclass(frozen=True)
class OutputOptions:
    """Options for files and the printed summary; `topics.py` explains them."""

    output: OutputFolder = "out"
    """Folder for the written files (default: out)."""
    name: Annotated[str | None, Parameter(group=OUTPUT)] = None
    """Beginning of the file names (NAME above). Default: the name of the rig or record."""
    figure: Annotated[Literal["png", "pdf", "svg"], Parameter(group=OUTPUT, show_default=False)] = (
        "png"
    )
    """File format of the figures (default: png)."""
    figure_width: Annotated[str | None, Parameter(group=OUTPUT)] = None
    """Width of the figures for print, such as 86mm. Default: a size for the screen."""
    json: Json = False


AS_DESCRIBED = RigOptions()
"""No option changes the rig."""
DEFAULT_OUTPUT = OutputOptions()
DEFAULT_THRESHOLDS = ThresholdOptions()
