"""Basins of attraction: the motions, the shares of their states, and measures of the borders."""

from __future__ import annotations

import math
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.datasets.stops import plain_values
from vibroimpact.facts.number_format import LENGTHS, fitting, plain, with_unit

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


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return the motions with the shares of their states, and how the basins are mixed."""
    motions = [
        {name: plain_values(data[name].isel(attractor=number)) for name in _OF_A_MOTION}
        for number in range(data.sizes["attractor"])
    ]
    labels = data["basin"].values
    return {
        "motions": motions,
        "states": int(labels.size),
        "given_up": int((labels == -1).sum()),
        "lattice": data.attrs["lattice"],
        **{name: float(data[name]) for name in _MEASURES},
    }


def text(data: xr.Dataset) -> RenderableType:
    """Return the same as a table and a line about the borders."""
    found = facts(data)
    motions = found["motions"]
    unit = fitting((one["displacement_excursion"] for one in motions), LENGTHS)
    table = Table(box=None, pad_edge=False, padding=(0, 2))
    for heading in (
        "motion",
        "kind",
        "period",
        with_unit("excursion", unit.symbol),
        "share",
        "95% interval",
        with_unit("distance to border", unit.symbol),
    ):
        table.add_column(heading, justify="left" if heading in ("motion", "kind") else "right")
    for number, one in enumerate(motions):
        far = one["border_distance"]
        table.add_row(
            str(number + 1),
            one["motion"],
            str(one["period"]) if one["period"] else "",
            plain(one["displacement_excursion"] / unit.size, 4),
            f"{one['share']:.1%}",
            f"{one['share_low']:.1%} to {one['share_high']:.1%}",
            plain(far / unit.size, 3) if math.isfinite(far) else "",
        )
    lines = [f"{found['lattice']}; states without a result: {found['given_up']}"]
    if math.isfinite(found["uncertainty_exponent"]):
        lines += [
            f"uncertainty exponent {found['uncertainty_exponent']:.3f} ± "
            f"{found['uncertainty_exponent_error']:.3f} (1 for a smooth border)",
            f"basin entropy {found['basin_entropy']:.3f}, border entropy "
            f"{found['border_entropy']:.3f}",
        ]
    return Group(Text(), table, Text(), Text("\n".join(lines)))
