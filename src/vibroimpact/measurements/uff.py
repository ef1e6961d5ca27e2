"""Universal files: functions (set 58) with their own units, or with those of set 164."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.measurements.channel_attributes import known
from vibroimpact.measurements.columns import ChannelColumn, Columns
from vibroimpact.measurements.names import meaning
from vibroimpact.measurements.scaling import agreed
from vibroimpact.measurements.tables import damaged, library
from vibroimpact.tables.units import parted, spelled

_ORDINATES = {8: "displacement", 9: "force", 11: "velocity", 12: "acceleration"}
"""Meanings of the numbers for the kind of an ordinate."""
_FACTORS = {8: "length", 9: "force", 11: "length", 12: "length"}
"""Factor of set 164 for each kind. Values in SI units times this factor are in the units of the
file."""
_SI = {8: "m", 9: "N", 11: "m/s", 12: "m/s^2"}
_FREQUENCY = 18


def read(path: Path) -> list[Columns]:
    """Read the functions of a file. Functions with the same abscissa form a table.

    Raises
    ------
    InputError
        If the file is damaged or truncated.
    """
    pyuff = library("pyuff", path)
    _whole(path)
    try:
        contents = pyuff.UFF(str(path)).read_sets()
    except Exception as error:  # pyuff raises whatever it meets in a damaged file
        raise damaged(path, "universal (UFF)", error) from None
    sets = contents if isinstance(contents, list) else [contents]
    factors: Mapping[str, Any] = next((one for one in sets if one.get("type") == 164), {})
    tables: list[tuple[Any, list[ChannelColumn]]] = []
    for one in (one for one in sets if one.get("type") == 58):
        x, y = np.asarray(one["x"], dtype=float), np.asarray(one["data"])
        if len(y) != int(one.get("num_pts") or len(y)):
            raise _truncated(path)
        bare, unit = parted(_called(one))
        unit, doubt = agreed(unit, one.get("ordinate_axis_units_lab"))
        kind = int(one.get("ordinate_spec_data_type", 0))
        if unit is None and factors and kind in _FACTORS:
            factor = float(factors.get(_FACTORS[kind]) or 1.0)
            y, unit = y / factor, _SI[kind]
        column = ChannelColumn(
            bare, unit, y if np.iscomplexobj(y) else y.astype(float), doubt=doubt
        )
        axis = _axis(one, x)
        for other, columns in tables:
            if len(other.values) == len(x) and other.unit == axis.unit:
                if not np.array_equal(other.values, x):
                    continue
                if bare in [each.name for each in columns]:
                    column = column._replace(name=f"{bare} of node {one.get('rsp_node')}")
                columns.append(column)
                break
        else:
            tables.append((axis, [axis, column]))
    return [Columns(str(path), tuple(columns), {}) for _, columns in tables]


def _axis(one: Mapping[str, Any], x: Any) -> ChannelColumn:
    """Return the abscissa of a function, in the stated unit."""
    stated = known(one.get("abscissa_axis_units_lab"))
    spectral = int(one.get("abscissa_spec_data_type", 17)) == _FREQUENCY
    usual = "Hz" if spectral else "s"
    unit = spelled(stated) if stated else usual
    return ChannelColumn("frequency" if spectral or unit == "rpm" else "time", unit, x)


_BINARY = re.compile(rb"^\s*58b\s", re.MULTILINE)
"""Header of a set of binary numbers."""


def _whole(path: Path) -> None:
    """Check that each set has an end mark."""
    raw = path.read_bytes()
    lines = [line for one in raw.splitlines() if (line := one.strip())]
    if _BINARY.search(raw):
        # The mark stands behind the last number, with no line of its own; pyuff counts the numbers.
        if not raw.rstrip().endswith(b"    -1"):
            raise _truncated(path)
        return
    marks = lines.count(b"-1")
    if marks and (marks % 2 or lines[-1] != b"-1"):
        raise _truncated(path)


def _truncated(path: Path) -> InputError:
    return InputError(
        f"measurement: {str(path)!r} ends within a dataset, so it is incomplete; copy or export "
        "the file again"
    )


def _called(one: Mapping[str, Any]) -> str:
    """Return the first name of a function whose meaning is understood."""
    line, place, label = (
        known(one.get(key)) or "" for key in ("id1", "rsp_ent_name", "ordinate_axis_lab")
    )
    kind = _ORDINATES.get(int(one.get("ordinate_spec_data_type", 0)), "")
    names = [line, f"{place} {label}".strip(), f"{place} {kind}".strip(), label, kind]
    return next((name for name in names if meaning(parted(name)[0])), line or label)
