"""Statements in headers of a fixed form, and what contradicts the values of the file."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.records.channel import Channel
from vibroimpact.tables.checks import duration_contradiction
from vibroimpact.tables.file import File
from vibroimpact.tables.statements import StatedNumber, StatedPeak, Statements, last_digit, same
from vibroimpact.tables.times import spacing
from vibroimpact.tables.units import spelled


def each_channel(file: File, read: Callable[[File, int], tuple[Channel, int]]) -> list[Channel]:
    """Read the channels of a file in turn; `read` returns one, and the line after it."""
    channels = []
    at = 0
    while at < len(file.lines):
        if file.lines[at].strip():
            channel, at = read(file, at)
            channels.append(channel)
        else:
            at += 1
    return channels


def check_stated(file: File, at: int, count: int, what: str = "values") -> int:
    """Check a number of values that a line states, and return it."""
    if count < 1:
        raise file.refused(at, f"the header states {count} {what}; use a record with at least 2")
    return count


def read_peak(at: int, number: str, unit: str | None, text: str = "") -> tuple[StatedPeak, ...]:
    """Return a stated peak, or nothing if it is 0, as networks write an unknown peak.

    Lines are counted from 0.

    Parameters
    ----------
    unit
        Its unit. None if it has the unit of the values.
    text
        The statement as it is shown in messages. Default: the number.
    """
    value = abs(float(number))
    if value == 0.0:
        return ()
    shown = " ".join((text or number).split())
    return (StatedPeak(value, spelled(unit) if unit else None, at, shown, last_digit(number)),)


def step_conflict(at: int, text: str, stated: float, other: float, source: str) -> str:
    """Return why a stated step (s) contradicts one of another source, or an empty string.

    `text` is the statement as shown, and `source` that of the other step, such as "the times".
    """
    if same(other, stated):
        return ""
    return (
        f"line {at + 1} states {' '.join(text.split())!r}, a step of {stated:g} s, but {source} "
        f"have steps of {other:.6g} s; correct one of them, or pass step= (--step)"
    )


def duration_conflict(at: int, number: str, text: str, count: int, step: float) -> str:
    """Return why a stated duration (s) contradicts the values, or an empty string.

    `text` is the statement as it is shown. Networks write 0 for an unknown duration.
    """
    if float(number) == 0.0:
        return ""
    stated = StatedNumber(float(number), at, " ".join(text.split()), last_digit(number))
    contradiction = duration_contradiction(Statements(durations=(stated,)), step, count)
    return contradiction and f"{contradiction}, or pass step= (--step)"


class TimeSteps(NamedTuple):
    """The step that the times beside the values give."""

    step: float | None
    """Step in s. None if the times are uneven."""
    times: NDArray[np.float64] | None
    """Uneven times (s)."""
    no_step: str
    """Error that is raised for uneven times if no step is passed."""
    notes: tuple[str, ...]


def read_times(file: File, at: int, times: NDArray[np.float64]) -> TimeSteps:
    """Return the step of the times (s) that stand beside the values from a line on.

    Raises
    ------
    InputError
        If there is one time, or if the times decrease.
    """
    if len(times) < 2:
        raise file.refused(at, "the file has one sample; pass at least two samples")
    steps = np.diff(times)
    if steps.min() < 0.0 or times[-1] <= times[0]:
        before = int(steps.argmin())
        problem = f"the time {times[before]:g} s is followed by {times[before + 1]:g} s"
        raise file.refused(at, f"{problem}; pass a file whose times increase")
    even = spacing(times)
    if even.step is not None:
        note = (
            f"its times are uneven by up to {even.off:.3g} s, so the average step of "
            f"{even.step:.6g} s is used"
        )
        return TimeSteps(_decimal(even.step, times), None, "", () if even.is_exact else (note,))
    problem = (
        f"line {at + 1}: its times are uneven, with steps from {steps.min():.3g} to "
        f"{steps.max():.3g} s; pass a step as step= (--step), such as '5 ms', at which the values "
        "are interpolated"
    )
    return TimeSteps(None, times, problem, ())


def _decimal(step: float, times: NDArray[np.float64]) -> float:
    """A step such as 0.01, which the average of decimal times misses by its last binary digits."""
    decimal = float(f"{step:.9g}")
    rounding = 4.0 * np.finfo(float).eps * float(np.abs(times).max()) / (len(times) - 1)
    return decimal if abs(decimal - step) <= rounding else step
