"""Files of other programs: MAT, HDF5, UFF58 and TDMS."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.measurement.beside import with_unit
from vibroimpact.measurement.columns import Column, Columns, of_one_length
from vibroimpact.measurement.names import meaning
from vibroimpact.measurement.text import parted

_ORDINATES = {8: "displacement", 9: "force", 11: "velocity", 12: "acceleration"}
"""What a universal file's number of an ordinate's kind means."""


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
    return _tables(path, groups)


def _gather(found: Mapping[str, Any], name: str, groups: dict[str, dict[str, Any]]) -> None:
    for key, value in found.items():
        if key.startswith("__"):
            continue
        for one in value if isinstance(value, list | np.ndarray) and _records(value) else [value]:
            if not isinstance(one, Mapping):
                groups.setdefault(name, {})[key] = one
            elif (signal := _signal(one)) is not None:
                groups.setdefault(name, {})[signal[0]] = signal[1]
            else:
                _gather(one, key, groups)


def _records(value: Any) -> bool:
    return len(value) > 0 and all(isinstance(one, Mapping) for one in np.ravel(value))


def _signal(record: Mapping[str, Any]) -> tuple[str, Any] | None:
    """Name and values of a record that is one channel, as Simulink's scopes save it."""
    name = next((record[key] for key in ("label", "name") if key in record), None)
    values = next((record[key] for key in ("values", "data") if key in record), None)
    return None if values is None or not isinstance(name, str) or not name else (name, values)


def read_hdf5(path: Path) -> list[Columns]:
    """Vectors of an HDF5 file, a table for each group; units from their attributes."""
    import h5py

    groups: dict[str, dict[str, Any]] = {}
    units: dict[str, str] = {}
    said: dict[str, dict[str, str]] = {}

    def visit(name: str, item: Any) -> None:
        group, _, last = name.rpartition("/")
        if not isinstance(item, h5py.Dataset):
            said[name] = _attributes(item)
            return
        values = item[()]
        if item.attrs.get("MATLAB_class") == b"char":  # its letters, as numbers
            values = "".join(chr(letter) for letter in np.ravel(values))
        groups.setdefault(group, {})[last] = values
        beside = _attributes(item)
        for key in ("units", "unit", "Unit", "Units"):
            if key in beside:
                units[name] = beside.pop(key)
        said[group] = beside | said.get(group, {})

    try:
        with h5py.File(path, "r") as file:
            said[""] = _attributes(file)
            file.visititems(visit)
    except OSError as error:
        raise _damaged(path, "HDF5", error) from None
    return _tables(path, groups, units, said)


def _attributes(item: Any) -> dict[str, str]:
    """Single values that stand beside a group or a dataset."""
    return {k: _text(np.asarray(v).squeeze()[()]) for k, v in item.attrs.items() if np.size(v) == 1}


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
        bare, unit = parted(_called(one))
        unit = unit or _known(one.get("ordinate_axis_units_lab"))
        column = Column(bare, unit, y.real if np.iscomplexobj(y) else y.astype(float))
        for axis, columns in tables:
            if len(axis) == len(x) and np.array_equal(axis, x):
                if bare in [other.name for other in columns]:
                    column = column._replace(name=f"{bare} of node {one.get('rsp_node')}")
                columns.append(column)
                break
        else:
            spectral = int(one.get("abscissa_spec_data_type", 17)) == 18
            at = Column("frequency" if spectral else "time", "Hz" if spectral else "s", x)
            tables.append((x, [at, column]))
    return [Columns(str(path), tuple(columns), {}) for _, columns in tables]


def _called(one: Mapping[str, Any]) -> str:
    """The first of what a function of a universal file is called that tells what it holds."""
    line, place, label = (
        _known(one.get(key)) or "" for key in ("id1", "rsp_ent_name", "ordinate_axis_lab")
    )
    kind = _ORDINATES.get(int(one.get("ordinate_spec_data_type", 0)), "")
    names = [line, f"{place} {label}".strip(), f"{place} {kind}".strip(), label, kind]
    return next((name for name in names if meaning(parted(name)[0])), line or label)


def read_tdms(path: Path) -> list[Columns]:
    """Channels of a TDMS file, a table for each group; time from the channels' increment."""
    nptdms = _library("nptdms", "tdms", path)
    try:
        file = nptdms.TdmsFile.read(str(path))
    except Exception as error:  # npTDMS raises whatever it meets in a damaged file
        raise _damaged(path, "TDMS", error) from None
    said = dict(_told(str(key), str(value)) for key, value in file.properties.items())
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
            named = {**said, "group": group.name}
            tables.append(Columns(str(path), of_one_length(str(path), columns), named))
    return tables


def _tables(
    path: Path,
    groups: Mapping[str, dict[str, Any]],
    units: Mapping[str, str] | None = None,
    said: Mapping[str, Mapping[str, str]] | None = None,
) -> list[Columns]:
    """A table for each group; or one of all groups, where each is one channel."""
    found = []
    units, said = units or {}, said or {}
    common = {**said.get("", {}), **_columns(path, groups.get("", {}), {}, {}).said}
    for at, group in groups.items():
        own = {key: units.get(f"{at}/{key}" if at else key) for key in group}
        beside = {**common, **said.get(at, {})}
        found.append(_columns(path, group, own, {**beside, "group": at} if at else beside))
    found = [table for table in found if table.columns]
    lengths = {len(column.values) for table in found for column in table.columns}
    if len(found) > 1 and len(lengths) == 1 and all(len(table.columns) == 1 for table in found):
        found = [_together(path, found)]
    return found or [_columns(path, {}, {}, {})]


def _together(path: Path, tables: list[Columns]) -> Columns:
    """One table of groups of one channel, whose name and unit are those of the group."""
    columns: list[Column] = []
    beside: dict[str, str] = {}
    for table in tables:
        (column,) = table.columns
        said = {key if key.lower() != "unit" else "unit": text for key, text in table.said.items()}
        name, unit = said.pop("group", column.name), said.pop("unit", None)
        columns.append(Column(name, column.unit or unit, column.values))
        beside |= said
    return Columns(str(path), tuple(columns), beside)


def _columns(
    path: Path,
    group: Mapping[str, Any],
    units: Mapping[str, str | None],
    said: Mapping[str, str],
) -> Columns:
    """Vectors as columns; single numbers and texts are what stands beside them."""
    beside = dict(_told(name, text) for name, text in said.items())
    vectors: dict[str, NDArray[Any]] = {}
    for name, value in group.items():
        values = np.asarray(value)
        if values.dtype.names:  # a compound type, a field a column
            vectors |= {field: np.squeeze(values[field]) for field in values.dtype.names}
            continue
        if values.dtype.kind == "O":
            values = np.array([_text(one) for one in values.ravel()])
        values = np.squeeze(values)
        if values.dtype.kind == "S":
            values = np.char.decode(values, "utf-8")
        if values.ndim == 0 or values.dtype.kind not in "fiubU":
            beside |= [_told(name, with_unit(_text(values[()]), units.get(name)))]
        else:
            vectors[name] = values
    columns = []
    used: set[str] = set()
    for name, values in vectors.items():
        if values.ndim == 1 or values.dtype.kind == "U":
            continue
        longest = int(np.argmax(values.shape))
        table = np.moveaxis(values, longest, 0).reshape(values.shape[longest], -1).astype(float)
        called, in_units = _words(vectors, table.shape[1])
        used |= called.keys() | in_units.keys()
        names = next(iter(called.values()), [f"{name} {i + 1}" for i in range(table.shape[1])])
        each = next(iter(in_units.values()), [None] * table.shape[1])
        for one, unit, column in zip(names, each, table.T, strict=True):
            bare, own = parted(one)
            columns.append(Column(bare, own or _known(unit), column))
    for name, values in vectors.items():
        if values.ndim == 1 and name not in used:
            bare, unit = parted(name)
            columns.append(Column(bare, unit or units.get(name), _numbers(values)))
    return Columns(str(path), of_one_length(str(path), columns), beside)


def _told(name: str, text: str) -> tuple[str, str]:
    """What stands beside the numbers, with the unit that its name ends in."""
    bare, unit = parted(name)
    return bare, with_unit(text, unit)


def _words(
    vectors: Mapping[str, NDArray[Any]], count: int
) -> tuple[dict[str, list[str]], dict[str, list[str]]]:
    """Lists of as many words as a table has columns: their names, and their units."""
    lists = {
        name: [str(word).strip() for word in values]
        for name, values in vectors.items()
        if values.ndim == 1 and values.dtype.kind == "U" and len(values) == count
    }
    told = {name: words for name, words in lists.items() if name.lower().startswith("unit")}
    return {name: words for name, words in lists.items() if name not in told}, told


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
