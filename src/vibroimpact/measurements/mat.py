"""MATLAB's files: vectors, those of structures too; version 7.3 is an HDF5 file."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements import hdf5
from vibroimpact.measurements.columns import Columns
from vibroimpact.measurements.stated import Stated, stated
from vibroimpact.measurements.tables import damaged, tables
from vibroimpact.records.guard import MOST_BYTES, unpacked, within

_HEADER, _TAG, _PACKED = 128, 8, 15


def read(path: Path) -> list[Columns]:
    """The tables of a file.

    Raises
    ------
    InputError
        If it is damaged, or holds too much.
    """
    import scipy.io

    try:
        _bounded(path)
        found = scipy.io.loadmat(str(path), simplify_cells=True)
    except NotImplementedError:
        return hdf5.read(path)
    except InputError:
        raise
    except Exception as error:  # scipy raises whatever it meets in a damaged file
        raise damaged(path, "MAT", error) from None
    groups: dict[str, dict[str, Any]] = {}
    about: dict[str, Stated] = {}
    _gather(path, found, "", groups, about)
    return tables(path, groups, about)


def _bounded(path: Path) -> None:
    """See to it that the variables of a file do not become too large when they are unpacked.

    Raises
    ------
    InputError
        If they do.
    """
    data = path.read_bytes()
    order = {b"IM": "<", b"MI": ">"}.get(data[126:128])
    if order is None:  # of another version
        return
    at = _HEADER
    size = 0
    while at + _TAG <= len(data):
        kind, length = struct.unpack_from(f"{order}2I", data, at)
        at += _TAG
        if kind == _PACKED:
            size += len(unpacked(data[at : at + length], path, "measurement", gzip=False))
        else:
            size += length
        within(size, path, "measurement")
        at += length


def _gather(
    path: Path,
    found: Mapping[str, Any],
    name: str,
    groups: dict[str, dict[str, Any]],
    about: dict[str, Stated],
) -> None:
    for key, value in found.items():
        if key.startswith("__"):
            continue
        many = isinstance(value, list | np.ndarray) and _records(value)
        every: Iterable[Any] = value if many else [value]
        for number, one in enumerate(every, 1):
            place = f"{name}.{key}" if name else key
            if not isinstance(one, Mapping):
                groups.setdefault(name, {})[key] = _whole(path, one)
            elif (signal := _signal(one)) is not None:
                title, values, others = signal
                at = f"{name}/{title}" if name else title
                groups.setdefault(name, {})[title] = values
                about[at] = stated(others)
            else:
                own = f"{place}({number})" if many and len(value) > 1 else place
                _gather(path, one, own, groups, about)


def _whole(path: Path, value: Any) -> Any:
    """A value; a sparse matrix with its zeros."""
    if not hasattr(value, "toarray"):
        return value
    within(8 * int(np.prod(value.shape, dtype=float)), path, "measurement")
    return value.toarray()


def _records(value: Any) -> bool:
    return 0 < len(value) < MOST_BYTES and all(isinstance(one, Mapping) for one in np.ravel(value))


def _signal(record: Mapping[str, Any]) -> tuple[str, Any, dict[str, Any]] | None:
    """Name, values and the rest of a record that is one channel, as Simulink's scopes save it."""
    names = [key for key in ("label", "name") if isinstance(record.get(key), str)]
    values = [key for key in ("values", "data") if key in record]
    if not names or not values or not record[names[0]]:
        return None
    others = {key: value for key, value in record.items() if key not in (names[0], values[0])}
    return record[names[0]], record[values[0]], others
