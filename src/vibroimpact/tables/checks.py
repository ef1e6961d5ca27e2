"""Compare what a file states of its values with the values: their count, step and duration."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.tables.file import File
from vibroimpact.tables.statements import StatedNumber, Statements, same
from vibroimpact.tables.table import Table
from vibroimpact.tables.times import IN_A_SECOND, spacing

_BESIDE = 1.5
"""Largest difference of a duration, in steps: it may count the first and the last sample or not."""


class Sampling(NamedTuple):
    """The step between the samples of a table."""

    step: float | None
    """In s. None if neither times nor a statement give one."""
    note: str = ""
    """What is assumed of the times."""
    uneven: str = ""
    """Where the times are uneven, if no step fits them."""
    contradiction: str = ""
    """Which statement differs from another one or from the times."""


def check_count(file: File, stated: Statements, counts: Iterable[int]) -> None:
    """Check the stated number of samples against `counts`: the values, as they may be counted.

    Raises
    ------
    InputError
        If the file states numbers of samples, and none of them is one of these. The message has the
        first one.
    """
    numbers = list(counts)
    if stated.counts and not {int(one.value) for one in stated.counts} & set(numbers):
        raise wrong_count(file, stated.counts[0], numbers[0])


def wrong_count(file: File, stated: StatedNumber, count: int) -> InputError:
    """Return the error for a stated number of samples that the values contradict."""
    return file.refused(
        stated.line,
        f"the file announces {stated.value:g} values, but {count} follow; correct this number, or "
        "pass a complete file",
    )


def sampling(table: Table, unit: str | None = None) -> Sampling:
    """Return the step of a table, from its times (in `unit`) and from what the file states.

    Raises
    ------
    InputError
        If the unit of the times is not known, or if there is only one time.
    """
    stated = table.statements
    step = stated.step
    contradiction = ""
    if step is not None and (other := stated.other_step):
        contradiction = (
            f"line {step.line + 1} states {step.text!r}, but line {other.line + 1} states "
            f"{other.text!r}: {step.value:g} s or {other.value:g} s; correct one of them"
        )
    if table.time is None:
        timing = Sampling(step.value if step else None)
    else:
        times = np.asarray(table.columns[table.time].values, dtype=float)
        timing = _of_times(table, times, unit or stated.time_unit or "s")
    contradiction = timing.contradiction or contradiction
    if timing.step is not None and not contradiction:
        contradiction = duration_contradiction(stated, timing.step, len(table.lines))
    return timing._replace(contradiction=contradiction)


def _of_times(table: Table, times: NDArray[np.float64], unit: str) -> Sampling:
    file, stated = table.file, table.statements.step
    if len(times) < 2:
        raise InputError(f"{file.what}: {file.path!r} has one sample; pass at least two samples")
    each = IN_A_SECOND.get(unit)
    if each is None:
        raise InputError(
            f"{file.what}: {file.path!r}: its times are in {unit!r}; convert them to s, ms or us"
        )
    even = spacing(times)
    mean = even.mean / each
    if even.step is None:
        if stated is not None and _are_rounded(times / each, stated.value):
            return Sampling(
                stated.value,
                f"its times are rounded, so the stated step of {stated.value:.6g} s is used",
            )
        return Sampling(None, "", _uneven(table, times, even.worst, mean))
    step = even.step / each
    contradiction = ""
    if stated is not None and not same(step, stated.value):
        contradiction = (
            f"line {stated.line + 1} states {stated.text!r}, a step of {stated.value:g} s, but the "
            f"times have steps of {step:.6g} s; correct one of them"
        )
    if even.is_exact:
        return Sampling(step, contradiction=contradiction)
    note = f"its times are uneven by up to {even.off / each:.3g} s"
    if stated is not None and not contradiction:
        return Sampling(stated.value, f"{note}, so the stated step is used")
    used = f"{note}, so the average step of {step:.6g} s is used"
    return Sampling(step, used, contradiction=contradiction)


def _are_rounded(times: NDArray[np.float64], step: float) -> bool:
    """Return whether times of the stated step were rounded, so that some repeat."""
    changes = np.diff(times)
    if (changes < 0.0).any() or not (changes > 0.0).any():
        return False
    digit = float(changes[changes > 0.0].min())
    grid = times - step * np.arange(len(times))
    return bool(np.ptp(grid) <= max(1.05 * digit, 0.5 * step))


def _uneven(table: Table, times: NDArray[np.float64], worst: int, mean: float) -> str:
    row = table.file.lines[int(table.lines[0])]
    may_be = "," in row and "." not in row and table.file.decimal is None
    hint = "; decimal=',' (--decimal ,) reads decimal commas" if may_be else ""
    in_row = table.arrangement == "rows"
    where = f"sample {worst}" if in_row else f"line {int(table.lines[worst]) + 1}"
    return (
        f"{where}: its time {times[worst]:g} s is not evenly spaced (steps of {mean:g} s on "
        f"average); make the steps equal, or pass step= (--step), which replaces the times{hint}"
    )


def duration_contradiction(stated: Statements, step: float, count: int) -> str:
    """Return why a stated duration contradicts the values, or an empty text."""
    lasts = step * count
    for one in stated.durations:
        if abs(one.value - lasts) <= _BESIDE * step + one.digit:
            return ""
    if not stated.durations:
        return ""
    one = stated.durations[0]
    return (
        f"line {one.line + 1} states {one.text!r}, but {count} samples in steps of {step:g} s last "
        f"{step * (count - 1):g} s; correct this line"
    )
