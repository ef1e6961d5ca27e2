"""A bifurcation diagram: the ranges in which motions are of one kind, as values and as text."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.facts.number_format import heading, plain, with_unit


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return, of each start, the ranges in which motions are of one kind, in SI units."""
    name = data.attrs["parameter"]
    return {
        "parameter": name,
        "starts": {str(start): _ranges(data.sel(start=start)) for start in data["start"].values},
    }


def _ranges(one: xr.Dataset) -> list[dict[str, Any]]:
    """Runs of values with the same kind of motion and the same period."""
    values = one[one.attrs["parameter"]].values
    kind, period = one["motion"].values, one["period"].values
    largest = one["exponents"].values[:, 0]
    edges = np.flatnonzero((kind[1:] != kind[:-1]) | (period[1:] != period[:-1])) + 1
    return [
        {
            "from": float(values[first]),
            "to": float(values[last - 1]),
            "values": int(last - first),
            "motion": str(kind[first]),
            "period": int(period[first]),
            "largest_exponent": float(largest[first:last].max()),
        }
        for first, last in itertools.pairwise([0, *edges, len(values)])
    ]


_MOST = 12
"""Ranges of a start that are printed."""


def text(data: xr.Dataset) -> RenderableType:
    """Return the ranges as tables, the widest of many."""
    told = facts(data)
    units = data[told["parameter"]].attrs["units"]
    unit, words = heading(told["parameter"], units, data[told["parameter"]].values)
    parts: list[RenderableType] = []
    for start, ranges in told["starts"].items():
        parts += [Text(), Text(start[:1].upper() + start[1:], style="bold")]
        chosen = sorted(ranges, key=lambda one: -one["values"])[:_MOST]
        parts.append(_table([one for one in ranges if one in chosen], words, unit))
        if len(ranges) > _MOST:
            more = len(ranges) - _MOST
            parts.append(Text(f"and {more} narrower range{'s' if more > 1 else ''}"))
    return Group(*parts)


def _table(ranges: list[dict[str, Any]], words: str, unit: Any) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 2), header_style="dim")
    table.add_column("motion")
    table.add_column(words, justify="right")
    for name in ("values", with_unit("largest exponent", "1/s")):
        table.add_column(name, justify="right")
    for one in ranges:
        period = f", period {one['period']}" if one["period"] else ""
        ends = [plain(one[end] / unit.size, 6) for end in ("from", "to")]
        table.add_row(
            one["motion"] + period,
            ends[0] if ends[0] == ends[1] else " to ".join(ends),
            str(one["values"]),
            plain(one["largest_exponent"], 4),
        )
    return table
