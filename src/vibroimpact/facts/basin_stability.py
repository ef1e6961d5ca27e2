"""Shares of random states by the motion to which they lead, as plain values and as text."""

from __future__ import annotations

from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.facts.number_format import heading, plain


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return where each motion exists, its kind there, and its shares, in SI units."""
    along = str(data["share"].dims[0])
    motions = []
    for number in range(data.sizes["attractor"]):
        one = data.isel(attractor=number)
        there = one["motion"].values != ""
        here = one.isel({along: there})
        kinds = zip(here["motion"].values, here["period"].values, strict=True)
        motions.append(
            {
                "from": float(here[along][0]),
                "to": float(here[along][-1]),
                "values": here[along].values.tolist(),
                "kinds": [
                    {"motion": str(kind), "period": int(period)}
                    for kind, period in dict.fromkeys(kinds)
                ],
                **{
                    name: here[name].values.tolist()
                    for name in ("share", "share_low", "share_high")
                },
            }
        )
    return {
        "parameter": along,
        "values": data[along].values.tolist(),
        "motions": motions,
        "given_up": int(data["given_up"].sum()),
    }


_MOST = 12
"""Motions that are printed."""


def text(data: xr.Dataset) -> RenderableType:
    """Return the same as a table, of the motions with the largest shares."""
    found = facts(data)
    along = found["parameter"]
    unit, words = heading(along, data[along].attrs["units"], data[along].values)
    table = Table(box=None, pad_edge=False, padding=(0, 2))
    table.add_column("motion")
    table.add_column("kind and period")
    for name in (words, "smallest share", "largest share", "95% interval of the largest"):
        table.add_column(name, justify="right")
    motions = list(enumerate(found["motions"], 1))
    chosen = sorted(motions, key=lambda one: -max(one[1]["share"]))[:_MOST]
    for number, one in sorted(chosen):
        kinds = [f"{kind['motion']} {kind['period'] or ''}".strip() for kind in one["kinds"]]
        ends = [plain(one[end] / unit.size, 4) for end in ("from", "to")]
        most = max(range(len(one["share"])), key=one["share"].__getitem__)
        table.add_row(
            str(number),
            ", ".join(kinds[:3]) + (" ..." if len(kinds) > 3 else ""),
            ends[0] if ends[0] == ends[1] else " to ".join(ends),
            f"{min(one['share']):.1%}",
            f"{one['share'][most]:.1%}",
            f"{one['share_low'][most]:.1%} to {one['share_high'][most]:.1%}",
        )
    lines = [f"states without a result: {found['given_up']}"]
    if len(motions) > _MOST:
        more = len(motions) - _MOST
        lines.insert(0, f"and {more} motion{'s' if more > 1 else ''} with smaller shares")
    return Group(Text(), table, Text(), Text("\n".join(lines)))
