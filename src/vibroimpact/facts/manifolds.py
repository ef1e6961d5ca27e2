"""Stable and unstable manifolds of saddles, as plain values and as text."""

from __future__ import annotations

from collections import Counter
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.datasets.description import noted
from vibroimpact.facts.number_format import LENGTHS, SPEEDS, fitting, plain, with_unit


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return the saddles, the curves and the number of their crossings."""
    return {
        "saddles": [
            {
                name: data[f"saddle_{name}"].values[number].item()
                for name in ("displacement", "velocity", "period")
            }
            | {
                f"multiplier_{name}": data[f"multiplier_{name}"].values[number].item()
                for name in ("growing", "dying")
            }
            for number in range(data.sizes["saddle"])
        ],
        "curves": [
            {
                name: data[f"curve_{name}"].values[number].item()
                for name in ("kind", "saddle", "length", "ended")
            }
            for number in range(data.sizes["curve"])
        ],
        "crossings": data.sizes["crossing"],
        "notes": noted(data),
    }


def text(data: xr.Dataset) -> RenderableType:
    """Return the saddles as a table, and the curves as lines."""
    found = facts(data)
    saddles, curves = found["saddles"], found["curves"]
    if not saddles:
        none = "\nno saddle was found on the borders between basins"
        return Text("\n".join([none, *found["notes"]]))
    far = fitting((one["displacement"] for one in saddles), LENGTHS)
    fast = fitting((one["velocity"] for one in saddles), SPEEDS)
    table = Table(box=None, pad_edge=False, padding=(0, 2))
    table.add_column("saddle")
    for heading in (
        with_unit("displacement", far.symbol),
        with_unit("velocity", fast.symbol),
        "period",
        "multipliers",
    ):
        table.add_column(heading, justify="right")
    for number, one in enumerate(saddles):
        table.add_row(
            str(number + 1),
            plain(one["displacement"] / far.size, 4),
            plain(one["velocity"] / fast.size, 4),
            str(one["period"]),
            f"{one['multiplier_growing']:.4g}, {one['multiplier_dying']:.4g}",
        )
    lines = []
    for kind in ("stable", "unstable"):
        mine = [one for one in curves if one["kind"] == kind]
        ends = Counter(one["ended"] for one in mine)
        length = sum(one["length"] for one in mine)
        lines.append(f"{kind} manifolds, total length {length:.3g} window widths:")
        lines += [f"  {count} of {len(mine)}: {why}" for why, count in ends.most_common()]
    crossed = found["crossings"]
    lines.append(
        f"stable and unstable manifolds cross {'once' if crossed == 1 else f'{crossed} times'}, so "
        "motions look chaotic before they settle"
        if crossed
        else "stable and unstable manifolds do not cross"
    )
    return Group(Text(), table, Text(), Text("\n".join([*lines, *found["notes"]])))
