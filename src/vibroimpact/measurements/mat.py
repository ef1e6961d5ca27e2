"""MATLAB files: vectors, including those in structures. Version 7.3 is an HDF5 file."""

from __future__ import annotations

import math
import struct
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements import hdf5
from vibroimpact.measurements.channel_attributes import Stated, stated
from vibroimpact.measurements.columns import Columns
from vibroimpact.measurements.tables import damaged, tables
from vibroimpact.tables.limits import MOST_BYTES, unpacked, within

_HEADER, _TAG = 128, 8
_DIMENSIONS, _ARRAY, _PACKED = 5, 14, 15
_KINDS = {*range(1, 8), 9, *range(12, 19)}
"""Kinds of elements: numbers, arrays, compressed elements and texts."""
_NUMERIC = {4: 4, 5: 5} | dict.fromkeys(range(6, 16), 4)
"""Number of parts of text, sparse and full arrays, by class. Complex arrays have one more part."""
_COMPLEX = 0x800
_DEEPEST = 50
"""Largest depth of nested arrays."""


def read(path: Path) -> list[Columns]:
    """Read the tables of a file.

    Raises
    ------
    InputError
        If the file is damaged or too large.
    """
    import scipy.io

    groups: dict[str, dict[str, Any]] = {}
    about: dict[str, Stated] = {}
    try:
        _checked(path)
        contents = scipy.io.loadmat(str(path), simplify_cells=True)
        _gather(path, contents, "", groups, about)
    except NotImplementedError:
        return hdf5.read(path)
    except InputError:
        raise
    except Exception as error:  # scipy raises whatever it meets in a damaged file
        raise damaged(path, "MAT", error) from None
    return tables(path, groups, about)


def _checked(path: Path) -> None:
    """Check that the variables of a file are complete, and not too large when decompressed.

    SciPy does not check the kinds of elements, so that a damaged file may crash the process.

    Raises
    ------
    InputError
        If the variables are too large.
    ValueError, struct.error, zlib.error, EOFError
        If the file is damaged.
    """
    data = path.read_bytes()
    order = {b"IM": "<", b"MI": ">"}.get(data[126:128])
    if order is None:  # of another version
        return
    size = 0
    for kind, at, length in _elements(data, _HEADER, len(data), order):
        part, first = data, at
        if kind == _PACKED:
            part = unpacked(data[at : at + length], path, "measurement", gzip=False)
            first, length = 0, len(part)
        size += length
        within(size, path, "measurement")
        if kind == _PACKED:
            for inner, where, inside in _elements(part, 0, len(part), order):
                _check_array(path, part, inner, where, where + inside, order)
        else:
            _check_array(path, part, kind, first, first + length, order)


def _elements(data: bytes, at: int, end: int, order: str) -> Iterator[tuple[int, int, int]]:
    """Yield the kind, the position and the length of each element.

    Raises
    ------
    ValueError
        If an element has an unknown kind, or if it is longer than its container.
    """
    while at + _TAG <= end:
        kind, length = struct.unpack_from(f"{order}2I", data, at)
        first, step = at + _TAG, length if kind == _PACKED else length + -length % _TAG
        if kind >> 16:  # up to four bytes within the tag itself
            kind, length, first, step = kind & 0xFFFF, kind >> 16, at + 4, 0
            if length > 4:
                raise ValueError(f"{length} bytes in an element of 4")
        if kind not in _KINDS or first + length > end:
            raise ValueError(f"an element of kind {kind} and {length} bytes")
        yield kind, first, length
        at += _TAG + step


def _check_array(
    path: Path, data: bytes, kind: int, at: int, end: int, order: str, depth: int = 0
) -> None:
    if kind != _ARRAY:
        return
    if depth > _DEEPEST:
        raise ValueError(f"arrays within arrays, more than {_DEEPEST} deep")
    parts = list(_elements(data, at, end, order))
    if not parts:  # an empty cell
        return
    flags = struct.unpack_from(f"{order}I", data, parts[0][1])[0]
    numeric = _NUMERIC.get(flags & 0xFF)
    if numeric and len(parts) < numeric + bool(flags & _COMPLEX):
        raise ValueError(f"an array of {len(parts)} parts")
    for number, (inner, first, length) in enumerate(parts):
        if number == 1 and inner == _DIMENSIONS:
            sizes = struct.unpack_from(f"{order}{length // 4}i", data, first)
            within(8 * math.prod(map(abs, sizes)), path, "measurement")
        if numeric and inner == _ARRAY:
            raise ValueError("an array in place of numbers")
        _check_array(path, data, inner, first, first + length, order, depth + 1)


def _gather(
    path: Path,
    contents: Mapping[str, Any],
    name: str,
    groups: dict[str, dict[str, Any]],
    about: dict[str, Stated],
) -> None:
    for key, value in contents.items():
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
    """Return a value. A sparse matrix is converted to a full matrix."""
    if not hasattr(value, "toarray"):
        return value
    within(8 * int(np.prod(value.shape, dtype=float)), path, "measurement")
    if value.format == "csc":
        # SciPy writes where the indices say; a damaged one is outside of the matrix.
        value.check_format(full_check=True)
    return value.toarray()


def _records(value: Any) -> bool:
    return 0 < len(value) < MOST_BYTES and all(isinstance(one, Mapping) for one in np.ravel(value))


def _signal(record: Mapping[str, Any]) -> tuple[str, Any, dict[str, Any]] | None:
    """Return name, values and other fields of a structure that Simulink saves as a channel."""
    names = [key for key in ("label", "name") if isinstance(record.get(key), str)]
    values = [key for key in ("values", "data") if key in record]
    if not names or not values or not record[names[0]]:
        return None
    others = {key: value for key, value in record.items() if key not in (names[0], values[0])}
    return record[names[0]], record[values[0]], others
