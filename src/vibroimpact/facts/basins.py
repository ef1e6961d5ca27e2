"""Basins of attraction: the motions, the shares of their states, and measures of the borders."""

from __future__ import annotations

import math
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.tables import Column, table_of, values_along

_MEASURES = (
    "basin_entropy",
    "border_entropy",
    "uncertainty_exponent",
    "uncertainty_exponent_error",
)
_OF_A_MOTION = (
    "motion",
    "period",
    "displacement_excursion",
    "eccentricity",
    "impacts",
    "states",
    "share",
    "share_low",
    "share_high",
    "border_distance",
    "mirror_image",
)

_COLUMNS = (
    Column("motion", "number", left=True),
    Column("kind", "motion", left=True),
    Column("period", lambda one: one["period"] or None),
    Column("excursion", "displacement_excursion"),
    Column("share", "share", "{:.1%}"),
    Column("95% interval", ("share_low", "share_high"), "{:.1%}"),
)
_EXCURSION = 3
_BORDER = Column(
    "distance to border",
    lambda one: one["border_distance"] if math.isfinite(one["border_distance"]) else None,
    3,
    "m",
    like=("displacement_excursion",),
)


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return the motions with the shares of their states, and how the basins are mixed."""
    labels = data["basin"].values
    known = [name for name in _OF_A_MOTION if name in data]
    return {
        "motions": values_along(data, "attractor", known),
        "states": int(labels.size),
        "given_up": int((labels == -1).sum()),
        "lattice": data.attrs["lattice"],
        **{name: float(data[name]) for name in _MEASURES},
    }


def text(data: xr.Dataset) -> RenderableType:
    """Return the same as a table and a line about the borders."""
    summary = facts(data)
    motions = [{"number": i, **one} for i, one in enumerate(summary["motions"], 1)]
    columns = [*_COLUMNS, *([_BORDER] if "border_distance" in data else [])]
    if "mass" in data.dims:
        for one in motions:
            one["displacement_excursion"] = max(one["displacement_excursion"].values())
        columns[_EXCURSION] = columns[_EXCURSION]._replace(name="largest excursion")
    table = table_of(motions, columns)
    lines = [f"{summary['lattice']}; states without a result: {summary['given_up']}"]
    if math.isfinite(summary["uncertainty_exponent"]):
        lines += [
            f"uncertainty exponent {summary['uncertainty_exponent']:.3f} ± "
            f"{summary['uncertainty_exponent_error']:.3f} (1 for a smooth border)",
            f"basin entropy {summary['basin_entropy']:.3f}, border entropy "
            f"{summary['border_entropy']:.3f}",
        ]
    return Group(Text(), table, Text(), Text("\n".join(lines)))
