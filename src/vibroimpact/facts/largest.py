"""What a sweep asks of a rig at most: displacements, acceleration, and the forces of the stops."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from rich.console import RenderableType
from rich.table import Table

from vibroimpact.datasets.description import base_at_rest, own_outputs
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

_ROWS: dict[str, tuple[str, str, float, Quantity]] = {
    "displacement_right": ("displacement to the right", "displacement_max", 1.0, LENGTH),
    "displacement_left": ("displacement to the left", "displacement_min", -1.0, LENGTH),
    "acceleration": ("absolute acceleration", "peak_acceleration", 1.0, ACCELERATION),
    "transmitted_force": ("transmitted force", "peak_transmitted_force", 1.0, FORCE),
    "transmissibility": ("transmissibility", "transmissibility", 1.0, DIMENSIONLESS),
    "force_right": ("force of the right stop", "peak_force_right", 1.0, FORCE),
    "force_left": ("force of the left stop", "peak_force_left", 1.0, FORCE),
    "impulse_right": ("impulse of the right stop", "peak_impulse_right", 1.0, IMPULSE),
    "impulse_left": ("impulse of the left stop", "peak_impulse_left", 1.0, IMPULSE),
}
"""In words, and which variable, with which sign."""
_UNDER_A_FORCE = ("transmitted_force", "transmissibility")
"""If the base moves, they are in proportion to the absolute acceleration."""


def facts(data: xr.Dataset) -> dict[str, Any]:
    """The largest of each over all holds, in SI units, and where; of stops that are touched.

    Under a force on the mass, the force transmitted to the base and its ratio to that force are
    added. A rigid stop that is struck has an impulse, and no finite force. Own outputs have their
    names.
    """
    found: dict[str, Any] = {}
    still = base_at_rest(data)
    rows = {name: row[1:3] for name, row in _ROWS.items() if still or name not in _UNDER_A_FORCE}
    own = own_outputs(data)
    rows |= {name: (name, 1.0) for name in own}
    for name, (variable, sign) in rows.items():
        values = sign * data[variable].transpose("direction", "frequency").values
        if np.isnan(values).all():
            continue
        most = float(np.nanmax(values))
        if name not in own and name.startswith(("force", "impulse")) and not 0.0 < most < math.inf:
            continue
        # Of sweeps that agree to rounding the forward one is named.
        d, f = np.unravel_index(np.argmax(values >= most - _SAME * abs(most)), values.shape)
        found[name] = {
            "value": float(values[d, f]) + 0.0,
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
            words, _, _, quantity = _ROWS[name]
            size = pretty(one["value"], quantity, _DIGITS)
        else:
            about = data[name].attrs
            words, units = about["long_name"], about["units"].removeprefix("1")
            size = f"{plain(one['value'], _DIGITS)} {units}".strip()
        table.add_row(words, size, f"at {forcing(one['frequency'])}, {one['direction']}")
    return table
