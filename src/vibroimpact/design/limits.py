"""What a design must not exceed."""

from __future__ import annotations

import json
from typing import Any

import xarray as xr

from vibroimpact.arguments import check_mapping
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.design.design_shaking import PEAKS
from vibroimpact.errors import InputError, unknown
from vibroimpact.model import to_si
from vibroimpact.model.parameters import in_units

_EXAMPLE = 'a dict of limits by name, such as {"peak_force": "2 MN"}'


def limits_of(limits: Any) -> dict[str, float]:
    """Read limits by name, in SI units.

    Raises
    ------
    InputError
        If one is of nothing that is known of a design, or has a wrong unit.
    """
    accepted = [name for name in PEAKS if name != "peak_acceleration"]
    found = {}
    given = check_mapping({} if limits is None else limits, "limits", _EXAMPLE)
    for name, value in given.items():
        key = name.replace("-", "_")
        if key not in accepted:
            raise InputError(f"limits: {unknown(name, accepted)}")
        quantity = in_units(VARIABLES[key].units)
        found[key] = to_si(value, quantity, f"limits[{name!r}]", minimum=0.0)
    return found


def excesses(data: xr.Dataset) -> list[xr.DataArray]:
    """By how much designs exceed each limit, as a share of it; above 0 where they do.

    Of a limit of 0 it is the value itself. The list is empty if a dataset does not state what its
    limits are.
    """
    limits = json.loads(data.attrs.get("parameters", "{}")).get("limits", {})
    return [(data[name] - most) / (most or 1.0) for name, most in limits.items() if name in data]
