"""Common functions of the readers of binary files: groups of vectors become tables."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.measurements.channel_attributes import Stated, as_text, kind_of, known
from vibroimpact.measurements.columns import ChannelColumn, Columns
from vibroimpact.measurements.file_entries import with_unit
from vibroimpact.measurements.scaling import agreed, completed, doubtful
from vibroimpact.tables.limits import few_columns
from vibroimpact.tables.units import parted


def tables(
    path: Path,
    groups: Mapping[str, dict[str, Any]],
    about: Mapping[str, Stated] | None = None,
    said: Mapping[str, Mapping[str, str]] | None = None,
) -> list[Columns]:
    """Return a table for each group, or one table if each group has only one channel."""
    group_tables: list[Columns] = []
    about, said = about or {}, said or {}
    common = {**said.get("", {}), **columns(path, groups.get("", {}), {}, {}).said}
    for at, group in groups.items():
        names = {key: f"{at}/{key}" if at else key for key in group}
        own = {key: about[name] for key, name in names.items() if name in about}
        beside = {**common, **said.get(at, {})}
        group_tables.append(columns(path, group, own, {**beside, "group": at} if at else beside))
    group_tables = [table for table in group_tables if table.columns]
    lengths = {len(column.values) for table in group_tables for column in table.columns}
    if (
        len(group_tables) > 1
        and len(lengths) == 1
        and all(len(table.columns) == 1 for table in group_tables)
    ):
        group_tables = [_together(path, group_tables)]
    return group_tables or [columns(path, {}, {}, {})]


def _together(path: Path, tables: list[Columns]) -> Columns:
    """Join groups with one channel to one table. Each channel gets the name of its group."""
    channels: list[ChannelColumn] = []
    beside: dict[str, str] = {}
    for table in tables:
        (column,) = table.columns
        said = dict(table.said)
        channels.append(column._replace(name=said.pop("group", column.name)))
        beside |= said
    return Columns(str(path), tuple(channels), beside)


def columns(
    path: Path,
    group: Mapping[str, Any],
    about: Mapping[str, Stated],
    said: Mapping[str, str],
) -> Columns:
    """Return vectors as columns. Single numbers and texts become entries next to the columns.

    Parameters
    ----------
    about
        Statements about some of the values.
    said
        Entries next to the columns.

    Raises
    ------
    InputError
        If a matrix has too many columns.
    """
    beside = dict(key_and_text(name, value) for name, value in said.items())
    vectors: dict[str, NDArray[Any]] = {}
    for name, value in group.items():
        values = np.asarray(value)
        if values.dtype.names and set(values.dtype.names) == {"real", "imag"}:
            values = np.zeros(values.shape, dtype=complex)  # as MATLAB keeps complex numbers
        if values.dtype.kind == "O":
            values = np.array([as_text(one) for one in values.ravel()])
        values = np.squeeze(values)
        if values.dtype.kind == "S":
            values = np.char.decode(values, "latin-1")
        if values.ndim == 0 or values.dtype.kind not in "fiubUc":
            unit = about.get(name, Stated()).unit
            beside |= [key_and_text(name, with_unit(as_text(values[()]), unit))]
        else:
            vectors[name] = about.get(name, Stated()).holes(values)
    all_columns: list[ChannelColumn] = []
    used: set[str] = set()
    for name, values in vectors.items():
        if values.ndim == 1 or values.dtype.kind in "Uc":
            continue
        longest = int(np.argmax(values.shape))
        table = np.moveaxis(values, longest, 0).reshape(values.shape[longest], -1).astype(float)
        few_columns(table.shape[1], path, "measurement")
        called, in_units = _words(vectors, table.shape[1])
        used |= called.keys() | in_units.keys()
        names = next(iter(called.values()), [f"{name} {i + 1}" for i in range(table.shape[1])])
        each = next(iter(in_units.values()), [None] * table.shape[1])
        own = about.get(name, Stated())
        for one, unit, column in zip(names, each, table.T, strict=True):
            bare, stated = parted(one)
            all_columns.append(described(bare, column, own, stated, known(unit)))
    for name, values in vectors.items():
        if (values.ndim == 1 or values.dtype.kind == "c") and name not in used:
            bare, unit = parted(name)
            own = about.get(name, Stated())
            values = values.ravel() if values.dtype.kind in "Uc" else values.astype(float)
            all_columns.append(described(bare, values, own, unit))
    return completed(Columns(str(path), tuple(all_columns), beside))


def described(name: str, values: NDArray[Any], own: Stated, *units: str | None) -> ChannelColumn:
    """Return a channel with the statements about it."""
    unit, doubt = agreed(*units, own.unit)
    column = ChannelColumn(
        name, unit, values, own.step, own.start, own.scale, own.offset, own.doubt
    )
    return doubtful(column, doubt)


def key_and_text(name: str, text: str) -> tuple[str, str]:
    """Return an entry next to the columns, with the unit at the end of its name."""
    bare, unit = parted(name)
    return bare, with_unit(text, unit)


def _words(
    vectors: Mapping[str, NDArray[Any]], count: int
) -> tuple[dict[str, list[str]], dict[str, list[str]]]:
    """Find lists of words that are the names or the units of the columns of a table."""
    lists = {
        name: [str(word).strip() for word in values]
        for name, values in vectors.items()
        if values.ndim == 1 and values.dtype.kind == "U" and len(values) == count
    }
    unit_lists = {name: words for name, words in lists.items() if kind_of(name)[0] == "unit"}
    return {name: words for name, words in lists.items() if name not in unit_lists}, unit_lists


def library(name: str, path: Path) -> Any:
    """Import an optional library, which must be installed."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise InputError(
            f"measurement: {str(path)!r} is read by {name}, which is not installed; install "
            f"it with: pip install {name}"
        ) from None


def damaged(path: Path, kind: str, error: Exception) -> InputError:
    """Return the error for an unreadable file, with the shortened message of its library."""
    reason = (str(error).splitlines() or [""])[0][:120] or type(error).__name__
    return InputError(
        f"measurement: {str(path)!r} is damaged or not a {kind} file ({reason}); copy or export "
        "the file again"
    )
