"""A bifurcation diagram: the ranges in which motions are of one kind, as values and as text."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.tables import Column, table_of

_MOST = 12
"""Ranges of a start that are printed."""


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


def text(data: xr.Dataset) -> RenderableType:
    """Return the ranges as tables, the widest of many."""
    told = facts(data)
    name = told["parameter"]
    columns = (
        Column("motion", lambda one: _kind(one["motion"], one["period"]), left=True),
        Column(name.replace("_", " "), ("from", "to"), 6, data[name].attrs["units"]),
        Column("values", "values"),
        Column("largest exponent", "largest_exponent", units="1/s"),
    )
    parts: list[RenderableType] = []
    for start, ranges in told["starts"].items():
        parts += [Text(), Text(start[:1].upper() + start[1:], style="bold")]
        chosen = sorted(ranges, key=lambda one: -one["values"])[:_MOST]
        parts.append(table_of([one for one in ranges if one in chosen], columns))
        if len(ranges) > _MOST:
            more = len(ranges) - _MOST
            parts.append(Text(f"and {more} narrower range{'s' if more > 1 else ''}"))
    return Group(*parts)


def _kind(motion: str, period: int) -> str:
    return f"{motion}, period {period}" if period else motion
