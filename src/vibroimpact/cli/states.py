"""Initial states on the command line: at which frequency and phase, and within which window."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from cyclopts import Group, Parameter

from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Repeated, State

_STATES = Group("States", sort_key=1)
_WITH_UNITS = Parameter(group=_STATES, allow_leading_hyphen=True)

Range = tuple[str, str] | None


@Parameter(name="*")
@dataclass(frozen=True)
class StateOptions:
    """Where motions begin."""

    frequency: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="Excitation frequency, such as 0.7Hz; that of the study's motion."),
    ] = None
    phase: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(
            help="Phase of the forcing at which motions begin, such as 90deg; that of the study."
        ),
    ] = None
    displacement: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="Range of displacements LOW:HIGH, such as -20mm:20mm; around the motions."),
    ] = None
    velocity: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="Range of velocities, such as -0.1m/s:0.1m/s; around the motions."),
    ] = None

    def window(self) -> tuple[Range, Range]:
        """Ranges of displacement and velocity; None where none is given."""
        return _range("--displacement", self.displacement), _range("--velocity", self.velocity)

    def forcing(self, what: Subject, along: str = "") -> Repeated:
        """The forcing of the rig where motions begin; along the frequency its own is of no matter.

        Raises
        ------
        InputError
            If none is given, or it cannot be used.
        """
        return forcing(what, along, self.frequency, self.phase)


def forcing(what: Subject, along: str, frequency: str | None, phase: str | None) -> Repeated:
    """The forcing of a rig at a frequency and a phase, by default the study's.

    Where a parameter is varied, `along` is its name.

    Raises
    ------
    InputError
        If no frequency is given, or a value cannot be used.
    """
    from vibroimpact.model import to_si
    from vibroimpact.model.quantities import ANGLE, FREQUENCY

    studied = what.study.simulate.frequency if what.study else None
    if frequency is not None:
        hertz = to_si(frequency, FREQUENCY, "--frequency", above=0.0)
    elif along == "frequency" or studied is not None:
        hertz = studied or 1.0
    else:
        raise InputError("--frequency: missing; a frequency greater than 0 is accepted, as 2Hz")
    own = what.study.excitation.phase if what.study else 0.0
    return what.at(hertz, own if phase is None else to_si(phase, ANGLE, "--phase"))


def state(option: str, text: str) -> State:
    """Read ``DISPLACEMENT,VELOCITY``.

    Raises
    ------
    InputError
        If it cannot be used.
    """
    from vibroimpact.model import State, to_si
    from vibroimpact.model.quantities import LENGTH, VELOCITY

    parts = text.split(",")
    if len(parts) != 2:
        raise InputError(
            f"{option}: {text!r}; a displacement and a velocity are accepted, as 5mm,100mm/s"
        )
    u, v = (
        to_si(part.strip(), quantity, option)
        for part, quantity in zip(parts, (LENGTH, VELOCITY), strict=True)
    )
    return State(u, v)


def _range(option: str, text: str | None) -> Range:
    """Read ``LOW:HIGH``; the ends are read by what is called."""
    if text is None:
        return None
    low, colon, high = (part.strip() for part in text.partition(":"))
    if not (low and colon and high) or ":" in high:
        raise InputError(f"{option}: {text!r}; a range LOW:HIGH is accepted, such as -20mm:20mm")
    return low, high
