"""Options for initial states: frequency, phase, and ranges of displacement and velocity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from cyclopts import Group, Parameter

import vibroimpact as vi
from vibroimpact.cli.options import by_path
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import AssemblyState

_OfStates: TypeAlias = Annotated[
    str | None,
    Parameter(group=Group("Initial states", sort_key=1), allow_leading_hyphen=True),
]
Texts: TypeAlias = Annotated[
    tuple[str, ...],
    Parameter(group=Group("Initial states", sort_key=1), negative="", consume_multiple=False),
]
Range: TypeAlias = tuple[str, str] | None


@Parameter(name="*")
@dataclass(frozen=True)
class StateOptions:
    """Options for the initial states."""

    frequency: _OfStates = None
    """Forcing frequency, such as 0.7Hz. Default: the frequency in the study file (table
    [simulate]). If there is none, the option is required."""
    phase: _OfStates = None
    """Phase of the forcing at the initial states, such as 90deg. Default: the phase in the study
    file, or 0."""
    displacement: _OfStates = None
    """Range of initial displacements, LOW:HIGH, such as -20mm:20mm. Default: a range that contains
    all steady motions."""
    velocity: _OfStates = None
    """Range of initial velocities, LOW:HIGH, such as -0.1m/s:0.1m/s. Default: a range that contains
    all steady motions."""

    def window(self) -> tuple[Range, Range]:
        """Return the ranges of displacement and velocity. A range without an option is None."""
        return _range("--displacement", self.displacement), _range("--velocity", self.velocity)

    def rig(self, what: Subject, along: str = "") -> vi.Rig:
        """Return the rig at the frequency and the phase of the options, as `rig_at` does."""
        return rig_at(what, self.frequency, self.phase, along)


ANY_STATES = StateOptions()


def rig_at(
    what: Subject, frequency: str | None, phase: str | None = None, along: str = ""
) -> vi.Rig:
    """Return a rig at a frequency and a phase. The defaults are those of the study.

    `along` is the name of the parameter that is varied. If it is the frequency, the value of the
    frequency does not matter.

    Raises
    ------
    InputError
        If there is no frequency, or if a value is invalid.
    """
    from vibroimpact.model import to_si
    from vibroimpact.model.quantities import ANGLE, FREQUENCY
    from vibroimpact.response.plausibility import doubt_frequency

    studied = what.simulate_table.frequency
    if frequency is not None:
        hertz = to_si(frequency, FREQUENCY, "--frequency", above=0.0)
    elif along == "frequency" or studied is not None:
        hertz = studied or 1.0
    elif not what.rig.is_shaken:
        hertz = what.repeated.frequency
    else:
        raise InputError("--frequency: missing; pass the forcing frequency, such as 2Hz")
    start = what.phase if phase is None else to_si(phase, ANGLE, "--phase")
    rig = what.rig.with_parts(what.system, what.at(hertz, start), keep_open=False)
    if along != "frequency":
        doubt_frequency(rig, "frequency" if frequency is None else "--frequency")
    return rig


def fixed_frequency(rig: vi.Rig, *along: str) -> float | None:
    """Return the forcing frequency (Hz), unless the frequency is among the varied parameters."""
    return None if "frequency" in along else rig.periodic.frequency


def state(option: str, text: str, phase: float | None = None) -> vi.State:
    """Read ``DISPLACEMENT,VELOCITY``.

    Raises
    ------
    InputError
        If the text is invalid.
    """
    from vibroimpact.model import to_si
    from vibroimpact.model.quantities import LENGTH, VELOCITY

    parts = text.split(",")
    if len(parts) != 2:
        raise InputError(
            f"{option}: {text!r}; pass a displacement and a velocity with a comma between them, "
            "such as 5mm,100mm/s"
        )
    u, v = (
        to_si(part.strip(), quantity, option)
        for part, quantity in zip(parts, (LENGTH, VELOCITY), strict=True)
    )
    return vi.State(u, v, phase=phase)


def plane(what: Subject, texts: Sequence[str]) -> dict[str, tuple[str, str]] | None:
    """Read the options --plane of several masses, COORDINATE=LOW:HIGH; None without an option.

    Raises
    ------
    InputError
        If several masses have not two of them, if one is not a range, or if a coordinate occurs
        twice.
    """
    range_texts = by_path("--plane", texts)
    spans = {name: _read_range(f"--plane: {name}", text) for name, text in range_texts.items()}
    if what.system.by_mass and len(spans) != 2:
        first = what.system.names[0]
        raise InputError(
            f"--plane: {', '.join(map(repr, texts)) or 'missing'}; pass two coordinates with their "
            f"ranges, such as --plane displacement.{first}=-2cm:2cm --plane velocity.{first}=-1:1"
        )
    return spans or None


def named_state(option: str, texts: Sequence[str]) -> AssemblyState | None:
    """Read a state of several masses, COORDINATE=VALUE such as ``velocity.roof=0.1m/s`` each.

    Raises
    ------
    InputError
        If a value is invalid, or if a coordinate occurs twice or does not exist.
    """
    from vibroimpact.model import AssemblyState

    parts: dict[str, Any] = {}
    for path, value in by_path(option, texts).items():
        part, _, name = path.partition(".")
        if part not in ("displacement", "velocity", "deformation", "memory") or not name:
            raise InputError(
                f"{option}: {path!r}; pass a part and a name, such as displacement.roof=2cm, "
                "velocity.roof=0.1m/s, deformation.STOP=1mm or memory.LINK=1mm"
            )
        parts.setdefault(part, {})[name] = value
    try:
        return AssemblyState(**parts) if parts else None
    except InputError as error:
        raise InputError(f"{option}: {error}") from None


def _range(option: str, text: str | None) -> Range:
    """Split ``LOW:HIGH``; None without an option."""
    return None if text is None else _read_range(option, text)


def _read_range(option: str, text: str) -> tuple[str, str]:
    """Split ``LOW:HIGH``. The library function reads the two values."""
    low, colon, high = (part.strip() for part in text.partition(":"))
    if not (low and colon and high) or ":" in high:
        example = "-20mm:20mm" if "displacement" in option else "-100mm/s:100mm/s"
        raise InputError(f"{option}: {text!r} is not a range; pass LOW:HIGH, such as {example}")
    return low, high
