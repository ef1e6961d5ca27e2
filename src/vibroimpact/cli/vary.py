"""Parameters that are varied, as they are written on the command line: PATH=LOW:HIGH[:log][:N]."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, NamedTuple, TypeAlias

from cyclopts import Parameter as Option

from vibroimpact.cli.options import by_path
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject
    from vibroimpact.model.parameters import Parameter

MOST = 4_000_000
"""Largest number of values in a range."""
HELP = (
    "Parameter that is varied and its range, PATH=LOW:HIGH, such as frequency=0.9Hz:1.3Hz, "
    "gap=3mm:7mm (both stops), right.gap=3mm:7mm, stops.stiffness=100kN/m:1MN/m, "
    "isolator.damping=0:2kN*s/m or isolator.yield_force=100N:400N. vibroimpact show lists the "
    "paths of a rig."
)
FREQUENCY_HELP = (
    "Default: the frequency, over the range in the study file (table [sweep]). If the file states "
    "none, the range is from 0.27 to 4.5 × the natural frequency. For laboratory cases it is from "
    "0.3 to 5 Hz. --vary frequency, without a range, means the same."
)
NUMBER_HELP = (
    "To change the number of values or their spacing, write LOW:HIGH:NUMBER, LOW:HIGH:log or "
    "LOW:HIGH:log:NUMBER (log: logarithmic spacing)."
)
Vary: TypeAlias = Annotated[
    tuple[str, ...], Option(name="--vary", negative="", consume_multiple=False)
]


class VaryOption(NamedTuple):
    """A parameter that is varied, and its range in SI units."""

    name: str
    low: float
    high: float
    number: int | None
    """Number of values, if it is stated."""
    logarithmic: bool

    @property
    def span(self) -> tuple[float, float]:
        """Lowest and highest value."""
        return self.low, self.high

    @property
    def ending(self) -> str:
        """The path in names of files."""
        return self.name.replace(".", "-").replace("_", "-")

    def values(self, number: int) -> list[float]:
        """Return the values, of which there are `number` unless the option states another one."""
        number = self.number or number
        shares = [i / (number - 1) for i in range(number)]
        if self.logarithmic:
            ratio = math.log(self.high / self.low)
            inside = [self.low * math.exp(share * ratio) for share in shares]
        else:
            inside = [self.low + share * (self.high - self.low) for share in shares]
        return [self.low, *inside[1:-1], self.high]


def _one_word(value: float, varied: Parameter) -> str:
    """Return a value with its unit and without blanks, such as ``"2kN*s/m"``."""
    from vibroimpact.model.units import pretty

    return pretty(value, varied.quantity, 4).replace(" ", "", 1).replace(" ", "*")


def _example(varied: Parameter, now: float | None) -> str:
    """Return how a range around the value of the rig is written."""
    if not now:
        return ""
    low, high = (_one_word(share * now, varied) for share in (0.7, 1.3))
    return f", such as {low}:{high}, which is ±30 % of that of the rig"


def read_vary_text(path: str, varied: Parameter, text: str, now: float | None = None) -> VaryOption:
    """Read ``LOW:HIGH[:log][:NUMBER]``. `now` is the value of the rig, for messages.

    Raises
    ------
    InputError
        If the text is not such a range. The message contains the path.
    """
    from vibroimpact.model.parameter_ranges import field_of, read_range
    from vibroimpact.model.quantities import DIMENSIONLESS

    option = f"--vary: {path}"
    parts = [part.strip() for part in text.split(":")]
    logarithmic = "log" in parts[2:3]
    rest = parts[3:] if logarithmic else parts[2:]
    if len(parts) < 2 or len(rest) > 1 or not all(parts):
        raise InputError(
            f"{option}: {text!r} is not a range; pass LOW:HIGH[:log][:NUMBER], such as 0.5:100 or "
            "0.5:100:log:21"
        )
    if varied.quantity is not DIMENSIONLESS and any(part.endswith("%") for part in parts[:2]):
        raise InputError(
            f"{option}: {text!r} is in percent, but a range has the values themselves; write them "
            f"with a unit{_example(varied, now)}"
        )
    low, high = read_range(varied, (parts[0], parts[1]), field_of(path), positive=logarithmic).ends
    number = None
    if rest:
        number = int(rest[0]) if rest[0].isascii() and rest[0].isdecimal() else 0
        if number < 2:
            log = "" if logarithmic else ", or log for a logarithmic range"
            raise InputError(
                f"{option}: the number of values, {rest[0]!r}, is not a whole number of at least "
                f"2; pass such a number{log}"
            )
        if number > MOST:
            raise InputError(f"{option}: {number} values; pass at most {MOST}")
    return VaryOption(varied.name, low, high, number, logarithmic)


def read_vary(what: Subject, texts: Sequence[str] | Mapping[str, str]) -> list[VaryOption]:
    """Read the options --vary, or such ranges by path. A frequency alone has a default range.

    Raises
    ------
    InputError
        If the rig has no such parameter, if a range is invalid, or if a path occurs twice.
    """
    from vibroimpact.model.parameters import parameter

    if isinstance(texts, Mapping):
        ranges = list(texts.items())
    else:
        written = [text for text in texts if text.strip() != "frequency"]
        ranges = [(path, text) for path, text in by_path("--vary", written).items()]
        ranges = [("frequency", "")] * (len(texts) - len(written)) + ranges
        order = [text.partition("=")[0].strip() for text in texts]
        ranges.sort(key=lambda one: order.index(one[0]))
    parameters = {}
    for path, text in ranges:
        varied = parameter(path, what.rig, "--vary")
        if varied.name in parameters:
            raise InputError(f"--vary: {path!r} is given twice; remove one of the two")
        parameters[varied.name] = (
            read_vary_text(path, varied, text, _value(what, varied)) if text else _frequencies(what)
        )
    return list(parameters.values())


def _value(what: Subject, varied: Parameter) -> float | None:
    """Return the value of the rig, unless it has none, such as a frequency that is open."""
    try:
        return None if varied.name == "frequency" else varied.read(what.rig)
    except InputError:
        return None


def read_one(what: Subject, texts: Sequence[str], *, number: bool = True) -> VaryOption:
    """Read one option --vary. By default the frequency is varied.

    Without `number`, the values between the ends are not chosen by the user.

    Raises
    ------
    InputError
        As `read_vary`. Also if there are several options.
    """
    ranges = read_vary(what, texts or ("frequency",))
    if len(ranges) > 1:
        raise InputError(
            f"--vary: given {len(ranges)} times, but this command varies one parameter; remove all "
            "but one"
        )
    if not number:
        check_continuous(ranges[0])
    return ranges[0]


def split_sines(
    varied: Sequence[VaryOption],
) -> tuple[list[VaryOption], tuple[float, float] | None]:
    """Return the varied parameters without the frequency, and the range of the frequency or None.

    Raises
    ------
    InputError
        If the range of the frequency has a number of values or a spacing.
    """
    others = [one for one in varied if one.name != "frequency"]
    for one in varied:
        if one.name == "frequency":
            if one.number is not None or one.logarithmic:
                raise InputError(
                    "--vary: frequency: the sines cover the range, so it has no number of values "
                    "and no spacing; pass LOW:HIGH"
                )
            return others, one.span
    return others, None


def check_continuous(one: VaryOption) -> None:
    """Refuse a number of values, and a spacing, of a parameter along which a curve is followed."""
    if one.number is not None or one.logarithmic:
        raise InputError(
            f"--vary: {one.name}: a curve is followed through the range, so it has no number of "
            "values and no spacing; pass LOW:HIGH"
        )


def _frequencies(what: Subject) -> VaryOption:
    """Return the default range of the frequency."""
    from vibroimpact.cli.frequency_grid import NO_DEFAULT, default_span
    from vibroimpact.model.quantities import FREQUENCY
    from vibroimpact.model.units import pretty

    low, high = default_span(what)
    if low is None or high is None:
        raise InputError(f"--vary: frequency: {NO_DEFAULT}")
    if not low < high:
        raise InputError(
            f"--vary: frequency: the range of the study, from {pretty(low, FREQUENCY)} to "
            f"{pretty(high, FREQUENCY)}, is empty; pass a range"
        )
    return VaryOption("frequency", low, high, None, False)
