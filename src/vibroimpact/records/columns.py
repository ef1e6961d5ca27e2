"""Records as plain numbers: one column, or times and values, in columns or in two rows."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model.quantities import ACCELERATION, LENGTH, TIME
from vibroimpact.model.record import Record
from vibroimpact.model.units import one_of, to_si

_EVEN = 0.01
"""By how much of a step a time may be off: files round theirs."""


def read_columns(path: Path | str, step: float | str | None = None, unit: str = "m/s^2") -> Record:
    """Read a record from text: values, or times and values, apart by commas, semicolons or blanks.

    Lines before the first number, and what follows a ``#``, are left out.

    Parameters
    ----------
    path
        The file.
    step
        Time between samples (s, or text with a unit), where the file has no times.
    unit
        Of the values: of an acceleration, such as ``"g"``, or of a displacement of the base, such
        as ``"mm"``, which is differentiated (`Record.from_displacement`).

    Raises
    ------
    InputError
        If the file cannot be read, or its values make no record.
    """
    rows = _numbers(Path(path))
    table = _table(rows, path)
    factor, quantity = one_of(f"1 {unit}", [ACCELERATION, LENGTH], "unit")
    values = table[:, -1] * factor
    if table.shape[1] == 2:
        if step is not None:
            raise InputError(
                f"step: {step!r}, but {str(path)!r} has times of its own; one of the two is "
                "accepted"
            )
        spacing = _spacing(table[:, 0], path)
    elif step is None:
        raise InputError(f"step: missing, and {str(path)!r} has no times; a time is accepted")
    else:
        spacing = to_si(step, TIME, "step", above=0.0)
    made = Record if quantity is ACCELERATION else Record.from_displacement
    try:
        return made(values, spacing)
    except InputError as error:
        raise InputError(f"record: {str(path)!r}: {error}") from None


def _numbers(path: Path) -> list[list[float]]:
    """The numbers of each line, from the first line on that has some."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise InputError(
            f"record: {str(path)!r} cannot be read ({error.strerror or error}); the path of a "
            "text file is accepted"
        ) from None
    except UnicodeDecodeError:
        told = f"record: {str(path)!r} is not text; columns of numbers are accepted"
        raise InputError(told) from None
    rows: list[list[float]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        parts = re.split(r"[,;\s]+", line.split("#")[0].strip())
        if parts in ([""], []):
            continue
        try:
            rows.append([float(part) for part in parts if part])
        except ValueError:
            if rows:
                raise InputError(
                    f"record: {str(path)!r}, line {number}: {line.strip()[:40]!r} is no row of "
                    "numbers; numbers are accepted from the first row of them on"
                ) from None
    return rows


def _table(rows: list[list[float]], path: Path | str) -> NDArray[np.float64]:
    """One or two columns."""
    widths = {len(row) for row in rows}
    if len(rows) == 2 and len(widths) == 1 and widths.pop() > 2:
        return np.array(rows).T
    widths = {len(row) for row in rows}
    if not rows or len(widths) > 1 or max(widths) > 2:
        told = "no numbers" if not rows else f"rows of {sorted(widths)} numbers"
        raise InputError(
            f"record: {str(path)!r} has {told}; one column of values, or times and values, are "
            "accepted"
        )
    return np.array(rows)


def _spacing(times: NDArray[np.float64], path: Path | str) -> float:
    """The time between samples, which must be the same everywhere."""
    if len(times) < 2:
        raise InputError(f"record: {str(path)!r} has one sample; at least 2 are accepted")
    step = float((times[-1] - times[0]) / (len(times) - 1))
    even = times[0] + step * np.arange(len(times))
    off = np.abs(times - even)
    if not step > 0.0 or off.max() > _EVEN * step:
        worst = int(off.argmax()) if step > 0.0 else 0
        raise InputError(
            f"record: {str(path)!r}, sample {worst}: its time {times[worst]:g} s is not evenly "
            f"spaced (steps of {step:g} s on average); equal steps are accepted"
        )
    return step
