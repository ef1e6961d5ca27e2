"""Shares of random states by the motion to which they lead, as plain values and as text."""

from __future__ import annotations

from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.tables import Column, table_of

_INTERVAL = ("share_low", "share_high")
_MOST = 12
"""Motions that are printed."""


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
                **{name: here[name].values.tolist() for name in ("share", *_INTERVAL)},
            }
        )
    return {
        "parameter": along,
        "values": data[along].values.tolist(),
        "motions": motions,
        "given_up": int(data["given_up"].sum()),
    }


def text(data: xr.Dataset) -> RenderableType:
    """Return the same as a table, of the motions with the largest shares."""
    summary = facts(data)
    along = summary["parameter"]
    motions = [
        {
            "number": number,
            "kinds": ", ".join(kinds[:3]) + (" ..." if len(kinds) > 3 else ""),
            "from": one["from"],
            "to": one["to"],
            "smallest": min(one["share"]),
            "largest": max(one["share"]),
            **{end: one[end][one["share"].index(max(one["share"]))] for end in _INTERVAL},
        }
        for number, one in enumerate(summary["motions"], 1)
        if (kinds := [f"{kind['motion']} {kind['period'] or ''}".strip() for kind in one["kinds"]])
    ]
    chosen = sorted(motions, key=lambda one: -one["largest"])[:_MOST]
    columns = (
        Column("motion", "number", left=True),
        Column("kind and period", "kinds", left=True),
        Column(along, ("from", "to"), units=data[along].attrs["units"]),
        Column("smallest share", "smallest", "{:.1%}"),
        Column("largest share", "largest", "{:.1%}"),
        Column("95% interval of the largest", _INTERVAL, "{:.1%}"),
    )
    table = table_of(sorted(chosen, key=lambda one: one["number"]), columns)
    lines = [f"states without a result: {summary['given_up']}"]
    if len(motions) > _MOST:
        more = len(motions) - _MOST
        lines.insert(0, f"and {more} motion{'s' if more > 1 else ''} with smaller shares")
    return Group(Text(), table, Text(), Text("\n".join(lines)))
