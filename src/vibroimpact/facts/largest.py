"""What a sweep asks of a rig at most: displacements, acceleration, and the forces of the stops."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from rich.console import RenderableType
from rich.table import Table

from vibroimpact.datasets.description import base_at_rest, own_outputs
from vibroimpact.datasets.stops import SIDES, quantities, quantity
from vibroimpact.model.frequency_text import forcing
from vibroimpact.model.quantities import (
    ACCELERATION,
    DIMENSIONLESS,
    FORCE,
    IMPULSE,
    LENGTH,
    Quantity,
)
from vibroimpact.model.units import plain, pretty

_DIGITS = 4
_SAME = 1e-9

_ROWS: dict[str, tuple[str, float, Quantity]] = {
    "displacement_max": ("displacement to the right", 1.0, LENGTH),
    "displacement_min": ("displacement to the left", -1.0, LENGTH),
    "peak_acceleration": ("absolute acceleration", 1.0, ACCELERATION),
    "peak_transmitted_force": ("transmitted force", 1.0, FORCE),
    "transmissibility": ("transmissibility", 1.0, DIMENSIONLESS),
    **{f"peak_force.{side}": (f"force of the {side} stop", 1.0, FORCE) for side in SIDES},
    **{f"peak_impulse.{side}": (f"impulse of the {side} stop", 1.0, IMPULSE) for side in SIDES},
}
"""In words, and with which sign in these words."""
_UNDER_A_FORCE = ("peak_transmitted_force", "transmissibility")
"""If the base moves, they are in proportion to the absolute acceleration."""


def facts(data: xr.Dataset) -> dict[str, Any]:
    """The largest of each over all holds, in SI units, and where; of stops that are touched.

    Under a force on the mass, the force transmitted to the base and its ratio to that force are
    added. A rigid stop that is struck has an impulse, and no finite force. Own outputs have their
    names.
    """
    found: dict[str, Any] = {}
    still = base_at_rest(data)
    known = quantities(data)
    own = own_outputs(data)
    rows = {
        name: row[1]
        for name, row in _ROWS.items()
        if name in known and (still or name not in _UNDER_A_FORCE)
    } | dict.fromkeys(own, 1.0)
    for name, sign in rows.items():
        values = sign * quantity(data, name).transpose("direction", "frequency").values
        if np.isnan(values).all():
            continue
        most = float(np.nanmax(values))
        if name not in own and "." in name and not 0.0 < most < math.inf:
            continue
        # Of sweeps that agree to rounding the forward one is named.
        d, f = np.unravel_index(np.argmax(values >= most - _SAME * abs(most)), values.shape)
        found[name] = {
            "value": sign * float(values[d, f]) + 0.0,
            "frequency": float(data["frequency"][f]),
            "direction": str(data["direction"].values[d]),
        }
    return found


def text(data: xr.Dataset) -> RenderableType:
    """The same as a table."""
    table = Table(
        title="Largest",
        title_justify="left",
        title_style="",
        box=None,
        show_header=False,
        pad_edge=False,
        padding=(0, 2, 0, 2),
    )
    table.add_column()
    table.add_column(justify="right")
    table.add_column()
    for name, one in facts(data).items():
        if name in _ROWS:
            words, sign, unit = _ROWS[name]
            size = pretty(sign * one["value"] + 0.0, unit, _DIGITS)
        else:
            about = data[name].attrs
            words, units = about["long_name"], about["units"].removeprefix("1")
            size = f"{plain(one['value'], _DIGITS)} {units}".strip()
        table.add_row(words, size, f"at {forcing(one['frequency'])}, {one['direction']}")
    return table
