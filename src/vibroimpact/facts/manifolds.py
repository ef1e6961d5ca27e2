"""Stable and unstable manifolds of saddles, as plain values and as text."""

from __future__ import annotations

from collections import Counter
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.description import noted
from vibroimpact.facts.tables import Column, table_of, values_along

_COLUMNS = (
    Column("saddle", "number", left=True),
    Column("displacement", "displacement"),
    Column("velocity", "velocity"),
    Column("period", "period"),
    Column(
        "multipliers",
        lambda one: f"{one['multiplier_growing']:.4g}, {one['multiplier_dying']:.4g}",
    ),
)


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return the saddles, the curves and the number of their crossings."""
    return {
        "saddles": [
            one | other
            for one, other in zip(
                values_along(data, "saddle", ("displacement", "velocity", "period"), "saddle_"),
                values_along(data, "saddle", ("multiplier_growing", "multiplier_dying")),
                strict=True,
            )
        ],
        "curves": values_along(data, "curve", ("kind", "saddle", "length", "ended"), "curve_"),
        "crossings": data.sizes["crossing"],
        "notes": noted(data),
    }


def text(data: xr.Dataset) -> RenderableType:
    """Return the saddles as a table, and the curves as lines."""
    summary = facts(data)
    saddles, curves = summary["saddles"], summary["curves"]
    if not saddles:
        none = "\nno saddle was found on the borders between basins"
        return Text("\n".join([none, *summary["notes"]]))
    table = table_of([{"number": i, **one} for i, one in enumerate(saddles, 1)], _COLUMNS)
    lines = []
    for kind in ("stable", "unstable"):
        mine = [one for one in curves if one["kind"] == kind]
        ends = Counter(one["ended"] for one in mine)
        length = sum(one["length"] for one in mine)
        lines.append(f"{kind} manifolds, total length {length:.3g} window widths:")
        lines += [f"  {count} of {len(mine)}: {why}" for why, count in ends.most_common()]
    crossed = summary["crossings"]
    lines.append(
        f"stable and unstable manifolds cross {'once' if crossed == 1 else f'{crossed} times'}, so "
        "motions look chaotic before they settle"
        if crossed
        else "stable and unstable manifolds do not cross"
    )
    return Group(Text(), table, Text(), Text("\n".join([*lines, *summary["notes"]])))
