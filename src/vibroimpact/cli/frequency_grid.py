"""Frequencies of sweeps as exact decimal numbers, and default ranges of frequencies."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import TYPE_CHECKING, TypeAlias

from vibroimpact.cli.study import SweepTable
from vibroimpact.errors import InputError
from vibroimpact.model import to_si
from vibroimpact.model.quantities import FREQUENCY
from vibroimpact.model.quantity_lists import check_stated_units

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject

_PUBLISHED = (0.5, 5.0, 0.01)
"""From, to and step in Hz: the range of the published tests, with a tenth of their step."""
_PUBLISHED_LOW = 0.3
"""Lowest frequency of branches in Hz."""
_LOW, _SPAN_LOW, _HIGH, _STEPS = 0.45, 0.27, 4.5, 110.0
"""The same values, divided by the natural frequency of the published rig. The last number is the
number of steps per natural frequency."""

MOST = 1_000_000
"""Largest number of frequencies."""


Range: TypeAlias = tuple[float, float, float] | tuple[None, None, None]
"""From, to and step in Hz; None if the rig has no natural frequency."""
Span: TypeAlias = tuple[float | None, float | None]
"""From and to in Hz; None if the rig has no natural frequency."""

NO_DEFAULT = (
    "missing; the isolator has no stiffness, so there is no natural frequency and no default; "
    "pass a frequency greater than 0"
)


def default_range(what: Subject, coarser: float = 1.0) -> Range:
    """Return the default range of a sweep: from, to and step (Hz).

    For a laboratory case it is the range of the tests. For another rig it is a multiple of the
    natural frequency, so that it contains the resonance. The step is multiplied by `coarser`.
    """
    natural = what.system.angular_frequency / math.tau
    if what.published:
        low, high, step = _PUBLISHED
    elif natural > 0.0:
        low, high, step = _short(_LOW * natural), _short(_HIGH * natural), _step(natural / _STEPS)
    else:
        return None, None, None
    return low, high, coarser * step


def default_span(what: Subject) -> Span:
    """Return the default range of branches: from and to (Hz).

    It starts lower than the range of a sweep, because branches are cheap to compute there. If the
    study states an end of the range for its sweep, this end is also used for its branches.
    """
    low, high, _ = default_range(what)
    if what.published:
        low = _PUBLISHED_LOW
    elif low is not None:
        low = _short(_SPAN_LOW * what.system.angular_frequency / math.tau)
    table = what.sweep_table
    if table.frequencies and len(table.frequencies) > 1:
        return min(table.frequencies), max(table.frequencies)
    return table.start or low, table.to or high


def _short(value: float) -> float:
    """Round to two digits."""
    return float(f"{value:.1e}")


def _step(value: float) -> float:
    """Round to one, two or five times a power of ten."""
    power = math.floor(math.log10(value))
    steps = [float(f"{digit}e{power}") for digit in (1, 2, 5, 10)]
    return min(steps, key=lambda step: abs(math.log(step / value)))


def frequency_grid(start: float, stop: float, step: float) -> tuple[float, ...]:
    """Return the frequencies from `start` to `stop`, including both ends.

    They are computed as decimal numbers and rounded once: 0.3 + 40 × 0.01 is 0.7, and not
    0.7000000000000001. If the range is not a multiple of the step, the last step is shorter.

    Raises
    ------
    InputError
        If the range is empty, or if it has more than `MOST` frequencies.
    """
    if start > stop:
        raise InputError(
            f"--from: {start:g} Hz is above --to, {stop:g} Hz; lower --from or raise --to"
        )
    first, last, width = (Decimal(repr(value)) for value in (start, stop, step))
    whole = int((last - first) / width)
    if whole >= MOST:
        raise InputError(
            f"--step: {step:g} Hz makes {whole + 1} frequencies, more than {MOST}; "
            "raise --step, or narrow the range from --from to --to"
        )
    grid = [float(first + k * width) for k in range(whole + 1)]
    # Units such as rad/s give long decimal numbers. Their last digit may miss the end.
    if stop - grid[-1] > 1e-9 * step:
        grid.append(stop)
    grid[-1] = stop
    return tuple(grid)


def list_frequencies(
    start: str | None,
    stop: str | None,
    step: str | None,
    listed: str | None,
    table: SweepTable | None,
    default: Range,
) -> tuple[float, ...] | tuple[str, ...]:
    """Return the frequencies of a sweep (Hz), or the texts of a list, which the sweep reads.

    Options take precedence over the table ``[sweep]`` of the study, and the table over the default.

    Raises
    ------
    InputError
        If a text is not a frequency greater than 0, or if both a list and a range are passed. Also
        if an end is missing that has no default, or if only one end has a unit.
    """
    texts = {"--from": start, "--to": stop, "--step": step}
    if listed is not None:
        for option, text in texts.items():
            if text is not None:
                raise InputError(
                    f"{option}: given together with --frequencies; remove one of the two options"
                )
        return tuple(part.strip() for part in listed.split(",")) if listed.strip() else ()
    if all(text is None for text in texts.values()) and table and table.frequencies is not None:
        return tuple(table.frequencies)
    from_study = (table.start, table.to, table.step) if table else (None, None, None)
    numbers: list[float] = []
    for (option, text), studied, otherwise in zip(texts.items(), from_study, default, strict=True):
        number = otherwise if studied is None else studied
        if text is not None:
            number = to_si(text, FREQUENCY, option, above=0.0)
        if number is None:
            raise InputError(f"{option}: {NO_DEFAULT}")
        numbers.append(number)
    ends = [text for text in (start, stop) if text is not None]
    check_stated_units(ends, FREQUENCY, "--from, --to")
    return frequency_grid(*numbers)


def sine_span(what: Subject) -> tuple[float, float] | None:
    """Return the range of frequencies in the study, or None if it states none.

    Raises
    ------
    InputError
        If the study states only one end.
    """
    low, high = what.sweep_table.start, what.sweep_table.to
    if low is None and high is None:
        return None
    if low is None or high is None:
        missing, stated = ("from", "to") if low is None else ("to", "from")
        raise InputError(
            f"sweep.{missing}: missing, although the study gives {stated!r}; add it, or pass "
            "--vary frequency=LOW:HIGH"
        )
    return low, high
