"""What a sweep asks of a rig at most: displacements, acceleration, and the forces of the stops."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from rich.console import RenderableType

from vibroimpact.datasets.description import base_at_rest, own_outputs
from vibroimpact.datasets.stops import quantities, quantity
from vibroimpact.facts.number_format import written
from vibroimpact.facts.tables import Column, table_of
from vibroimpact.model.frequency_text import forcing
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.units import plain

_SAME = 1e-9


class _Line(NamedTuple):
    """A line of the table."""

    words: str
    quantity: str
    sign: float = 1.0
    """Sign of the quantity in these words."""
    under_a_force: bool = False
    """Whether it is written only if a force shakes the mass: if the base moves, it is in proportion
    to the absolute acceleration."""


_LINES = (
    _Line("displacement to the right", "displacement_max"),
    _Line("displacement to the left", "displacement_min", -1.0),
    _Line("absolute acceleration", "peak_acceleration"),
    _Line("transmitted force", "peak_transmitted_force", under_a_force=True),
    _Line("transmissibility", "transmissibility", under_a_force=True),
    *(_Line(f"force of the {side} stop", f"peak_force.{side}") for side in SIDES),
    *(_Line(f"impulse of the {side} stop", f"peak_impulse.{side}") for side in SIDES),
)
_OF = {one.quantity: one for one in _LINES}
_COLUMNS = (Column("", "words", left=True), Column("", "size"), Column("", "at", left=True))


def largest(data: xr.DataArray, sign: float = 1.0) -> dict[str, Any] | None:
    """Return the largest value of all holds with its frequency and direction; None if all are NaN.

    Of sweeps that agree to rounding, the first one is named.
    """
    values = sign * data.transpose("direction", "frequency").values
    if np.isnan(values).all():
        return None
    most = float(np.nanmax(values))
    least = most - _SAME * abs(most) if math.isfinite(most) else most
    d, f = np.unravel_index(np.argmax(values >= least), values.shape)
    return {
        "value": sign * float(values[d, f]) + 0.0,
        "frequency": float(data["frequency"][f]),
        "direction": str(data["direction"].values[d]),
    }


def place(one: Mapping[str, Any]) -> str:
    """Return the frequency and the direction of a largest value as text."""
    return f"at {forcing(one['frequency'])}, {one['direction']}"


def facts(data: xr.Dataset) -> dict[str, Any]:
    """The largest of each over all holds, in SI units, and where; of stops that are touched.

    Under a force on the mass, the force transmitted to the base and its ratio to that force are
    added. A rigid stop that is struck has an impulse, and no finite force. Own outputs have their
    names.
    """
    known, at_rest, own = set(quantities(data)), base_at_rest(data), own_outputs(data)
    lines = [one for one in _LINES if one.quantity in known and (at_rest or not one.under_a_force)]
    extremes: dict[str, Any] = {}
    for name, sign in [*((one.quantity, one.sign) for one in lines), *((one, 1.0) for one in own)]:
        one = largest(quantity(data, name), sign)
        of_stop = name not in own and "." in name
        if one and (not of_stop or 0.0 < one["value"] < math.inf):
            extremes[name] = one
    return extremes


def text(data: xr.Dataset) -> RenderableType:
    """The same as a table."""
    rows = [{**_row(data, name, one), "at": place(one)} for name, one in facts(data).items()]
    return table_of(rows, _COLUMNS, "Largest")


def _row(data: xr.Dataset, name: str, one: Mapping[str, Any]) -> dict[str, str]:
    value = one["value"]
    if name in _OF:
        size = written(name.partition(".")[0], _OF[name].sign * value + 0.0)
        return {"words": _OF[name].words, "size": size}
    about = data[name].attrs
    units = about["units"].removeprefix("1")
    return {"words": about["long_name"], "size": f"{plain(value, 4)} {units}".strip()}
