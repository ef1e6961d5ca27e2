"""What a design must not exceed."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.arguments import check_mapping
from vibroimpact.datasets.stops import has_stops, over_parts, quantity
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.design.design_shaking import PEAKS
from vibroimpact.errors import InputError, unknown
from vibroimpact.model import to_si
from vibroimpact.model.parameters import in_units

_LEFT = "displacement_min"
_EXAMPLE = 'a dict of limits by name, such as {"peak_force": "2 MN"}'


def limits_of(
    limits: Any,
    known: Sequence[str] = PEAKS,
    parts: Mapping[str, Sequence[str]] = MappingProxyType({}),
) -> dict[str, float]:
    """Read limits by name, in SI units.

    Parameters
    ----------
    parts
        Names of the masses, links or stops of which a result has one each. Such a result may be
        limited for one of them, such as ``"peak_drift.storey"``.

    Raises
    ------
    InputError
        If one is of nothing that is known of a design, or has a wrong unit.
    """
    accepted = [name for name in known if name != "peak_acceleration"]
    accepted += [f"{name}.{part}" for name in accepted for part in parts.get(name, ())]
    bounds = {}
    entries = check_mapping({} if limits is None else limits, "limits", _EXAMPLE)
    for name, value in entries.items():
        key = underscored(name)
        if key not in accepted:
            raise InputError(f"limits: {unknown(name, accepted)}")
        base = key.partition(".")[0]
        ends = {"maximum": 0.0} if base == _LEFT else {"minimum": 0.0}
        bounds[key] = to_si(value, in_units(VARIABLES[base].units), f"limits[{name!r}]", **ends)
    return bounds


def underscored(name: str) -> str:
    """Return the name of a result with underscores; the name of its part is kept."""
    base, dot, part = name.partition(".")
    return base.replace("-", "_") + dot + part


def severity(name: str, values: Any) -> Any:
    """Return what a limit bounds from above: minus the end on the left, the largest of all parts.

    Designs are along the first axis of the values, and stops, masses and links along the last one.
    """
    severities = _sense(name) * values
    if np.ndim(severities) > 1 or (has_stops(name) and np.ndim(severities)):
        severities = severities.max(axis=-1)
    return severities


def _sense(name: str) -> float:
    return -1.0 if name.partition(".")[0] == _LEFT else 1.0


def excesses(data: xr.Dataset) -> list[xr.DataArray]:
    """By how much designs exceed each limit, as a share of it; above 0 where they do.

    Of a limit of 0 it is the value itself. The list is empty if a dataset does not state what its
    limits are.
    """
    limits = json.loads(data.attrs.get("parameters", "{}")).get("limits", {})
    return [
        (_sense(name) * (over_parts(quantity(data, name)) - most)) / (abs(most) or 1.0)
        for name, most in limits.items()
        if name.partition(".")[0] in data
    ]
