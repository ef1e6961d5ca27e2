"""A bifurcation diagram: the ranges in which motions are of one kind, as values and as text."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.tables import Column, table_of
from vibroimpact.model.oscillator import SIDES

_MOST = 12
"""Ranges of a start that are printed."""
_NONE = "none"


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return, of each start, the ranges in which motions are of one kind, in SI units."""
    name = data.attrs["parameter"]
    return {
        "parameter": name,
        "starts": {str(start): _ranges(data.sel(start=start)) for start in data["start"].values},
    }


def _ranges(one: xr.Dataset) -> list[dict[str, Any]]:
    """Runs of values with the same kind of motion, the same period and the same contacts.

    The contacts are those of one period; of a motion without a period, 1 means that the stop is
    touched. Those of a motion that was given up are unknown, -1.
    """
    values = one[one.attrs["parameter"]].values
    kind, period = one["motion"].values, one["period"].values
    largest = one["exponents"].values[:, 0]
    per_cycle = one["impacts"].transpose(..., "stop").values
    counts = np.rint(per_cycle * period[:, np.newaxis])
    counts = np.where(period[:, np.newaxis] > 0, counts, per_cycle > 0.0)
    counts = np.where(np.isnan(per_cycle), -1, counts).astype(int)
    changes = np.column_stack([kind[1:] != kind[:-1], np.diff(period), np.diff(counts, axis=0)])
    edges = np.flatnonzero(changes.any(axis=1)) + 1
    stops = one["stop"].values.tolist()
    return [
        {
            "from": float(values[first]),
            "to": float(values[last - 1]),
            "values": int(last - first),
            "motion": str(kind[first]),
            "period": int(period[first]),
            "contacts": dict(zip(stops, counts[first].tolist(), strict=True)),
            "largest_exponent": float(largest[first:last].max()),
        }
        for first, last in itertools.pairwise([0, *edges, len(values)])
    ]


def text(data: xr.Dataset) -> RenderableType:
    """Return the ranges as tables: the widest of many, and all in which nothing was decided."""
    summary = facts(data)
    name = summary["parameter"]
    columns = (
        Column("motion", lambda one: _kind(one["motion"], one["period"]), left=True),
        *([Column("contacts", _contacts, left=True)] if data.sizes["stop"] else []),
        Column(name.replace("_", " "), ("from", "to"), 6, data[name].attrs["units"]),
        Column("values", "values"),
        Column("largest exponent", "largest_exponent", units="1/s"),
    )
    parts: list[RenderableType] = []
    for start, ranges in summary["starts"].items():
        parts += [Text(), Text(start[:1].upper() + start[1:], style="bold")]
        widest = sorted(ranges, key=lambda one: -one["values"])[:_MOST]
        chosen = [one for one in ranges if one in widest or one["motion"] == "undecided"]
        parts.append(table_of(chosen, columns))
        if more := len(ranges) - len(chosen):
            parts.append(Text(f"and {more} narrower range{'s' if more > 1 else ''}"))
    every = [one for ranges in summary["starts"].values() for one in ranges]
    if data.sizes["stop"] and not any(any(one["contacts"].values()) for one in every):
        parts.append(Text(f"\nNote: {_UNTOUCHED}"))
    return Group(*parts)


_UNTOUCHED = (
    "none of these motions touches a stop. Motions that do may coexist: start from random states "
    "(--random), or compute basins of attraction at one value (vibroimpact basins)"
)


def _contacts(one: dict[str, Any]) -> str:
    """Write contacts per period by stop, such as "1R 1L"; without a period, which are touched."""
    counts = one["contacts"]
    if min(counts.values()) < 0:
        return ""
    hit = {name: count for name, count in counts.items() if count}
    if not hit:
        return _NONE
    if set(counts) <= set(SIDES):
        short = {name: name[0].upper() for name in counts}
        return " ".join(
            f"{count}{short[name]}" if one["period"] else short[name]
            for name, count in (counts if one["period"] else hit).items()
        )
    return ", ".join(f"{n} {name}" if one["period"] else name for name, n in hit.items())


def _kind(motion: str, period: int) -> str:
    return f"{motion}, period {period}" if period else motion
