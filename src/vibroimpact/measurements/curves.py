"""Stepped-sine curves from a table, with all values of each frequency and direction."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.measurements.columns import Array, Columns
from vibroimpact.measurements.names import CURVES, Meaning, direction_of
from vibroimpact.response.curve_pair import DIRECTIONS, Direction

Known = dict[int, tuple[Meaning, Array]]
"""Meaning of columns and their values in SI units, by number of the column."""


def curves(
    table: Columns, known: Known, direction: str | None, notes: list[str], facts: list[str]
) -> xr.Dataset:
    """Arrange measured values by direction and frequency.

    Parameters
    ----------
    direction
        Direction of all rows, if the file does not state it.
    notes
        List to which notes on assumptions, and on what was left out, are added.
    facts
        List to which facts are added: what the file does not contain, or contains more than once.

    Returns
    -------
    xarray.Dataset
        The dims are ``direction`` and ``frequency`` (Hz, rising). If a frequency was measured more
        than once, there is a last dim ``repeat``. Values are NaN where nothing was measured.

    Raises
    ------
    InputError
        If the direction of a row is unknown, or if no values are left.
    """
    at = next(values for meaning, values in known.values() if meaning.variable == "frequency")
    ways = _directions(table, known, at, direction, notes)
    usable = np.isfinite(at) & (at > 0.0)
    if not usable.all():
        rows = ", ".join(table.row(int(i)) for i in np.flatnonzero(~usable)[:5])
        notes.append(f"rows without a frequency were left out: {int((~usable).sum())} ({rows})")
    points: dict[tuple[str, str, float], list[float]] = {}
    empty = 0
    for meaning, values in known.values():
        if meaning.variable not in CURVES:
            continue
        for i in np.flatnonzero(usable):
            if not np.isfinite(values[i]):
                empty += 1
                continue
            key = (meaning.variable, meaning.direction or ways[int(i)], float(at[i]))
            points.setdefault(key, []).append(float(values[i]))
    if not points:
        raise InputError(
            f"measurement: {table.path!r}: no row has both a frequency greater than 0 and a "
            "measured value; pass a file with at least one such row"
        )
    if empty:
        facts.append(f"missing values: {empty}")
    frequency = np.array(sorted({key[2] for key in points}))
    present: list[str] = [way for way in DIRECTIONS if any(key[1] == way for key in points)]
    most = max(len(values) for values in points.values())
    if most > 1:
        held = len({key[1:] for key, values in points.items() if len(values) > 1})
        what = "1 frequency was" if held == 1 else f"{held} frequencies were"
        facts.append(f"{what} measured up to {most} times; all values are kept")
    data = xr.Dataset(coords={"direction": present, "frequency": frequency})
    for name in dict.fromkeys(key[0] for key in points):
        grid = np.full((len(present), len(frequency), most), np.nan)
        for (variable, way, f), held_there in points.items():
            if variable == name:
                place = present.index(way), int(np.searchsorted(frequency, f))
                grid[place][: len(held_there)] = held_there
        dims = ("direction", "frequency", "repeat")
        data[name] = (dims, grid) if most > 1 else (dims[:2], grid[..., 0])
    file = Path(table.path).name
    facts += [f"{file}: no {way} sweep was measured" for way in DIRECTIONS if way not in present]
    if len(frequency) == 1:
        notes.append("there is only one frequency, so jumps cannot be detected")
    return data


def _directions(
    table: Columns, known: Known, at: Array, direction: str | None, notes: list[str]
) -> Sequence[Direction]:
    """Return the direction of each row. It is used if the name of a column does not state it."""
    column = next((i for i, (meaning, _) in known.items() if meaning.variable == "direction"), None)
    if direction is not None:
        return [direction_of(direction, table.path, "direction")] * len(at)
    if column is not None:
        words: NDArray[np.generic] = table.columns[column].values
        return [direction_of(word, table.path, table.row(i)) for i, word in enumerate(words)]
    if all(meaning.direction for meaning, _ in known.values() if meaning.variable in CURVES):
        return ["forward"] * len(at)  # asked of none
    f = at[np.isfinite(at)]
    change = np.diff(f)
    turns = np.flatnonzero(np.diff(np.sign(change[change != 0.0])))
    if len(f) > 1 and f[-1] < f[0] and not len(turns):
        notes.append(
            "no column states the sweep direction, and the frequencies fall, so backward was "
            "assumed"
        )
        return ["backward"] * len(at)
    top = int(np.nanargmax(at)) if len(f) else 0
    if len(turns) == 1 and 0 < top < len(at) - 1:
        notes.append(
            "no column states the sweep direction, so forward was assumed while the frequencies "
            f"rise, and backward from {table.row(top + 1)}"
        )
        return ["forward" if i <= top else "backward" for i in range(len(at))]
    if len(turns):
        raise InputError(
            f"measurement: {table.path!r}: the sweep direction is unknown, because the frequencies "
            "rise and fall several times; add a column 'direction' with forward or backward in "
            "each row, or pass direction='forward' if it applies to all rows"
        )
    notes.append("no column states the sweep direction, so forward was assumed")
    return ["forward"] * len(at)
