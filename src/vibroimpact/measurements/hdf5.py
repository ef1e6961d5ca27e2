"""HDF5 files: vectors, a table for each group; units, scales and steps from their attributes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements.columns import Columns
from vibroimpact.measurements.stated import Stated, stated
from vibroimpact.measurements.tables import as_text, damaged, tables
from vibroimpact.records.guard import within


def read(path: Path) -> list[Columns]:
    """The tables of a file.

    Raises
    ------
    InputError
        If it is damaged, holds too much, or has its data elsewhere.
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
                f"measurement: {str(path)!r}, {name!r}: its data are in other files; data in the "
                "file itself are accepted"
            )
        size += int(item.size or 0) * item.dtype.itemsize
        within(size, path, "measurement")
        values = item[()]
        if item.attrs.get("MATLAB_class") == b"char":  # its letters, as numbers
            values = "".join(chr(letter) for letter in np.ravel(values))
        where = f"measurement: {str(path)!r}, {name!r}"
        own, each = _lists(item)
        if each and isinstance(values, np.ndarray):
            titles = values.dtype.names
            if titles:
                for field, unit in zip(titles, each, strict=False):
                    groups.setdefault(group, {})[field] = values[field]
                    about[f"{group}/{field}" if group else field] = Stated(unit=unit or None)
                return
            parts = np.moveaxis(values, int(np.argmax(values.shape)), 0)
            if values.ndim == 2 and parts.shape[1] == len(each):
                for i, unit in enumerate(each):
                    field = f"{last} {i + 1}"
                    groups.setdefault(group, {})[field] = parts[:, i]
                    about[f"{group}/{field}" if group else field] = Stated(unit=unit or None)
                return
        found = stated(own, where)
        groups.setdefault(group, {})[last] = values
        about[name] = found
        said[group] = dict(found.others) | said.get(group, {})

    try:
        with h5py.File(path, "r") as file:
            said[""] = _attributes(file)
            file.visititems(visit)
    except InputError:
        raise
    except Exception as error:  # h5py raises whatever it meets in a damaged file
        raise damaged(path, "HDF5", error) from None
    return tables(path, groups, about, said)


def _attributes(item: Any) -> dict[str, str]:
    """Single values that stand beside a group."""
    found = {}
    for name, value in item.attrs.items():
        if np.size(value) == 1:
            found[name] = as_text(np.asarray(value).squeeze()[()])
    return found


def _lists(item: Any) -> tuple[dict[str, Any], list[str]]:
    """The attributes of a dataset; and the units of its columns, if a list of them is one."""
    fields = item.dtype.names
    own = {}
    each: list[str] = []
    count = len(fields) if fields else min(item.shape, default=0) if item.ndim == 2 else 0
    for name, value in item.attrs.items():
        listed = np.ravel(np.asarray(value))
        if "unit" in name.lower() and listed.size == count > 1 and listed.dtype.kind in "OSU":
            each = [as_text(one).strip() for one in listed]
        else:
            own[name] = as_text(value) if isinstance(value, bytes) else value
    return own, each
