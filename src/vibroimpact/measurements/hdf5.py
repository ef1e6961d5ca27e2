"""HDF5 files: each group of vectors is a table; attributes state units, scales and steps."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements.channel_attributes import Stated, as_text, kind_of, known, stated
from vibroimpact.measurements.columns import Columns
from vibroimpact.measurements.tables import damaged, tables
from vibroimpact.tables.limits import within

_HEAP = b"GCOL\x01\0\0\0"
"""Signature of a heap of texts."""


def read(path: Path) -> list[Columns]:
    """Read the tables of a file.

    Raises
    ------
    InputError
        If the file is damaged, is too large, or has its data in another file.
    """
    import h5py

    groups: dict[str, dict[str, Any]] = {}
    about: dict[str, Stated] = {}
    said: dict[str, dict[str, str]] = {}
    size = 0

    def visit(name: str, item: Any) -> None:
        nonlocal size
        group, _, last = name.rpartition("/")
        if not isinstance(item, h5py.Dataset):
            said[name] = _attributes(item)
            return
        if item.external or item.is_virtual:
            raise InputError(
                f"measurement: {str(path)!r}, {name!r}: its data are in other files; copy the data "
                "into this file"
            )
        size += int(item.size or 0) * item.dtype.itemsize
        within(size, path, "measurement")
        values = item[()]
        if item.attrs.get("MATLAB_class") == b"char":  # its letters, as numbers
            values = "".join(chr(letter) for letter in np.ravel(values))
        own, each = _lists(item)
        fields = item.dtype.names or ()
        if fields and set(fields) != {"real", "imag"}:
            # A table of a compound type is a group of its fields.
            groups[name] = {field: values[field] for field in fields}
            for field, unit in zip(fields, each or [""] * len(fields), strict=True):
                about[f"{name}/{field}"] = Stated(known(unit))
            said[name] = {key: _joined(value) for key, value in own.items()}
            return
        statement = stated(own)
        if each:
            parts = np.moveaxis(values, int(np.argmax(values.shape)), 0)
            for i, unit in enumerate(each):
                groups.setdefault(group, {})[f"{last} {i + 1}"] = parts[:, i]
                field = f"{group}/{last} {i + 1}".removeprefix("/")
                about[field] = statement._replace(unit=known(unit))
            return
        groups.setdefault(group, {})[last] = values
        about[name] = statement
        said[group] = dict(statement.others) | said.get(group, {})

    try:
        _check_heaps(path.read_bytes())
        with h5py.File(path, "r") as file:
            said[""] = _attributes(file)
            file.visititems(visit)
    except InputError:
        raise
    except Exception as error:  # h5py raises whatever it meets in a damaged file
        raise damaged(path, "HDF5", error) from None
    return tables(path, groups, about, said)


def _check_heaps(data: bytes) -> None:
    """Raise a ValueError if a heap of texts has free space of size 0, where HDF5 never ends."""
    at = data.find(_HEAP)
    while at >= 0:
        end = min(at + int.from_bytes(data[at + 8 : at + 16], "little"), len(data))
        item = at + 16
        while item + 16 <= end:
            number = int.from_bytes(data[item : item + 2], "little")
            size = int.from_bytes(data[item + 8 : item + 16], "little")
            if number == 0 and size == 0:
                raise ValueError("free space without a size")
            item += size if number == 0 else 16 + size + -size % 8
        at = data.find(_HEAP, at + 1)


def _attributes(item: Any) -> dict[str, str]:
    """Return the attributes of a group: single values, and lists of units or scales."""
    return {
        name: _joined(value)
        for name, value in item.attrs.items()
        if np.size(value) == 1 or kind_of(name)[0]
    }


def _joined(value: Any) -> str:
    return ", ".join(as_text(one) for one in np.ravel(np.asarray(value)))


def _lists(item: Any) -> tuple[dict[str, Any], list[str]]:
    """Return the attributes of a dataset, and the units of its columns if they are listed."""
    own: dict[str, Any] = {}
    each: list[str] = []
    fields = item.dtype.names
    count = len(fields) if fields else min(item.shape) if item.ndim == 2 else 0
    for name, value in item.attrs.items():
        listed = np.ravel(np.asarray(value))
        if kind_of(name)[0] == "unit" and listed.size == count > 1 and listed.dtype.kind in "OSU":
            each = [as_text(one).strip() for one in listed]
        else:
            own[name] = value
    return own, each
