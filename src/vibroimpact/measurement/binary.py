"""Files of other programs: MAT, HDF5, UFF58 and TDMS."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.measurement.columns import Column, Columns, of_one_length
from vibroimpact.measurement.text import parted


def read_mat(path: Path) -> list[Columns]:
    """Vectors of a MATLAB file, those of its structures too; version 7.3 is an HDF5 file."""
    import scipy.io

    try:
        found = scipy.io.loadmat(str(path), simplify_cells=True)
    except NotImplementedError:
        return read_hdf5(path)
    except Exception as error:  # scipy raises whatever it meets in a damaged file
        raise _damaged(path, "MAT", error) from None
    groups: dict[str, dict[str, Any]] = {}
    _gather(found, "", groups)
    return [_columns(path, group) for group in groups.values()] or [_columns(path, {})]


def _gather(found: Mapping[str, Any], name: str, groups: dict[str, dict[str, Any]]) -> None:
    for key, value in found.items():
        if key.startswith("__"):
            continue
        if isinstance(value, Mapping):
            _gather(value, key, groups)
        else:
            groups.setdefault(name, {})[key] = value


def read_hdf5(path: Path) -> list[Columns]:
    """Vectors of an HDF5 file, a table for each group; units from their attributes."""
    import h5py

    groups: dict[str, dict[str, Any]] = {}
    units: dict[str, str] = {}

    def visit(name: str, item: Any) -> None:
        if not isinstance(item, h5py.Dataset):
            return
        group, _, last = name.rpartition("/")
        groups.setdefault(group, {})[last] = item[()]
        for key in ("units", "unit", "Unit", "Units"):
            if key in item.attrs:
                units[name] = _text(item.attrs[key])

    try:
        with h5py.File(path, "r") as file:
            file.visititems(visit)
            said = {key: _text(value) for key, value in file.attrs.items()}
    except OSError as error:
        raise _damaged(path, "HDF5", error) from None
    return [
        _columns(path, group, {k: units.get(f"{at}/{k}" if at else k) for k in group}, said)
        for at, group in groups.items()
    ] or [_columns(path, {})]


def read_uff(path: Path) -> list[Columns]:
    """Functions of a universal file (58): a table for all that share their abscissa."""
    pyuff = _library("pyuff", "uff", path)
    try:
        sets = pyuff.UFF(str(path)).read_sets()
    except Exception as error:  # pyuff raises whatever it meets in a damaged file
        raise _damaged(path, "universal (UFF)", error) from None
    sets = [one for one in (sets if isinstance(sets, list) else [sets]) if one.get("type") == 58]
    tables: list[tuple[Any, list[Column]]] = []
    for one in sets:
        x, y = np.asarray(one["x"], dtype=float), np.asarray(one["data"])
        name = str(one.get("id1") or one.get("ordinate_axis_lab") or "").strip()
        if name in ("", "NONE"):
            name = str(one.get("ordinate_axis_lab", "")).strip()
        bare, unit = parted(name)
        unit = unit or _known(one.get("ordinate_axis_units_lab"))
        column = Column(bare, unit, y.real if np.iscomplexobj(y) else y.astype(float))
        for axis, columns in tables:
            if len(axis) == len(x) and np.array_equal(axis, x):
                columns.append(column)
                break
        else:
            spectral = int(one.get("abscissa_spec_data_type", 17)) == 18
            at = Column("frequency" if spectral else "time", "Hz" if spectral else "s", x)
            tables.append((x, [at, column]))
    return [Columns(str(path), tuple(columns), {}) for _, columns in tables]


def read_tdms(path: Path) -> list[Columns]:
    """Channels of a TDMS file, a table for each group; time from the channels' increment."""
    nptdms = _library("nptdms", "tdms", path)
    try:
        file = nptdms.TdmsFile.read(str(path))
    except Exception as error:  # npTDMS raises whatever it meets in a damaged file
        raise _damaged(path, "TDMS", error) from None
    said = {str(key).lower(): str(value) for key, value in file.properties.items()}
    tables = []
    for group in file.groups():
        columns: list[Column] = []
        for channel in group.channels():
            bare, unit = parted(channel.name)
            unit = unit or _known(channel.properties.get("unit_string"))
            if not columns and "wf_increment" in channel.properties:
                columns.append(Column("time", "s", np.asarray(channel.time_track(), dtype=float)))
            values = np.asarray(channel[:])
            if values.dtype.kind not in "fiub":
                values = values.astype(str)
            columns.append(Column(bare, unit, _numbers(values)))
        if columns:
            tables.append(Columns(str(path), of_one_length(str(path), columns), said))
    return tables


def _columns(
    path: Path,
    group: Mapping[str, Any],
    units: Mapping[str, str | None] | None = None,
    said: Mapping[str, str] | None = None,
) -> Columns:
    """Vectors as columns; single numbers and texts are what stands beside them."""
    beside = {str(k).lower(): v for k, v in (said or {}).items()}
    columns = []
    for name, value in group.items():
        values = np.asarray(value)
        if values.dtype.kind == "O":
            values = np.array([_text(one) for one in values.ravel()])
        values = np.squeeze(values)
        if values.dtype.kind == "S":
            values = np.char.decode(values, "utf-8")
        if values.ndim == 0 or values.dtype.kind not in "fiubU":
            beside[name.lower()] = _text(value)
        elif values.ndim == 1:
            bare, unit = parted(name)
            unit = unit or (units or {}).get(name)
            columns.append(Column(bare, unit, _numbers(values)))
        else:
            longest = int(np.argmax(values.shape))
            table = np.moveaxis(values, longest, 0).reshape(values.shape[longest], -1).astype(float)
            columns += [Column(f"{name} {i + 1}", None, one) for i, one in enumerate(table.T)]
    return Columns(str(path), of_one_length(str(path), columns), beside)


def _numbers(values: NDArray[Any]) -> NDArray[Any]:
    """Words as they are, numbers as floats."""
    return values if values.dtype.kind == "U" else values.astype(float)


def _known(value: Any) -> str | None:
    text = "" if value is None else _text(value).strip()
    return None if text.upper() in ("", "NONE") else text


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _library(name: str, extra: str, path: Path) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise InputError(
            f"measurement: {str(path)!r} is read by {name}, which is not installed; "
            f"pip install 'vibroimpact[{extra}]' installs it"
        ) from None


def _damaged(path: Path, kind: str, error: Exception) -> InputError:
    reason = (str(error).splitlines() or [type(error).__name__])[0]
    return InputError(
        f"measurement: {str(path)!r} is damaged or no {kind} file ({reason}); "
        "a whole one is accepted"
    )
