"""Doubts about the values of a record: its peak, its times and its last value."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from vibroimpact.tables.file import File
from vibroimpact.tables.units import spelled

GRAVITY = 9.80665
PEAKS = (0.001, 5.0)
"""Usual range of peaks in g. Few records have a lower peak, and no known record a higher one."""
STEPS = (1e-4, 0.1)
"""Usual range of time steps in s."""
LONGEST = 1800.0
"""Longest usual duration in s."""
_USUAL = {"m/s^2": 1.0, "g": GRAVITY, "cm/s^2": 0.01, "mm/s^2": 0.001, "gal": 0.01}
_FAR = 10.0
"""Change to the last value that is doubted, divided by the largest change before it."""
_LAST = 50
_SMALL = 0.01
"""Largest change that is never doubted, as a share of the peak."""
_WIDE = 8
"""Largest number of columns. A line with more numbers is one row of values."""
_FORM = re.compile(r"[+-]?\d*(?:\.(?P<decimals>\d*))?(?:[eEdD][+-]?(?P<exponent>\d+))?")


def of_size(peak: float, unit: str) -> list[str]:
    """Return doubts about a peak (m/s²) of values in a unit. `unit` is empty for displacements."""
    unit = spelled(unit)
    size = peak / GRAVITY
    if peak == 0.0 or PEAKS[0] <= size <= PEAKS[1]:
        return []
    relation = "less than" if size < PEAKS[0] else "more than"
    bound = PEAKS[0] if size < PEAKS[0] else PEAKS[1]
    doubt = f"the peak is {size:.3g} g, {relation} the {bound:g} g of usual records"
    taken = _USUAL.get(unit)
    for other, factor in _USUAL.items():
        if other != unit and taken and PEAKS[0] <= size * factor / taken <= PEAKS[1]:
            return [f"{doubt}: is its unit {other}?"]
    return [doubt]


def of_times(step: float, count: int) -> list[str]:
    """Return doubts about the step (s), and about the duration of the record."""
    doubts = []
    lasts = step * (count - 1)
    if not STEPS[0] * (1.0 - 1e-9) <= step <= STEPS[1] * (1.0 + 1e-9):
        side = "less" if step < STEPS[0] else "more"
        bound = STEPS[0] if step < STEPS[0] else STEPS[1]
        doubts.append(f"the step is {step:.6g} s, {side} than the {bound:g} s of usual records")
    if lasts > LONGEST:
        doubts.append(f"it lasts {lasts:.6g} s, more than the {LONGEST:g} s of usual records")
    if doubts:
        doubts[-1] += ": are its times in s?"
    return doubts


def of_end(values: NDArray[np.float64]) -> list[str]:
    """Return doubts about a last value that is far from the values before it."""
    if len(values) < 10:
        return []
    changes = np.abs(np.diff(values[-_LAST - 1 :]))
    if changes[-1] <= max(_FAR * changes[:-1].max(), _SMALL * float(np.abs(values).max())):
        return []
    return [
        f"the last value, {values[-1]:.6g}, is far from the one before it, {values[-2]:.6g}: is "
        "the file incomplete?"
    ]


def of_last_line(file: File) -> list[str]:
    """Return doubts about a last number without a line break that has other digits than usual."""
    if file.ends_whole or not file.lines:
        return []
    cells = _cells(file.lines[-1])
    forms = [_form(cell) for cell in cells]
    if not cells or None in forms:
        return []
    others = forms[:-1] if len(forms) > _WIDE else []
    for line in reversed(file.lines[-_LAST:-1]):
        above = [_form(cell) for cell in _cells(line)]
        if not above or None in above:
            break
        others.append(above[-1])
    # A number that was cut has fewer digits than the others, where all have as many.
    if others and set(others) == {forms[-1]} and forms[-1] != (0, 0):
        return []
    return [
        f"the file ends with {cells[-1][:20]!r} and without a line break: is it incomplete "
        "within a number?"
    ]


def _cells(line: str) -> list[str]:
    return [cell for cell in re.split(r"[,;\s]+", line) if cell]


def _form(cell: str) -> tuple[int, int] | None:
    """How many decimals a number has, and how many digits its exponent."""
    match = _FORM.fullmatch(cell.strip("\"'"))
    if match is None or not any(sign.isdigit() for sign in cell):
        return None
    return len(match["decimals"] or ""), len(match["exponent"] or "")
