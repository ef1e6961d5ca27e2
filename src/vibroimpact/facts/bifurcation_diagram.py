"""A bifurcation diagram: the ranges in which motions are of one kind, as values and as text."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.number_format import heading
from vibroimpact.facts.tables import Column, table_of
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.units import plain
from vibroimpact.response.resonance import runs

_MOST = 12
"""Ranges of a start that are printed."""
_EQUAL = 1e-4
"""Difference between the extremes of one settled motion, divided by its size, that is surely error:
a hundred times that of a motion that settles slowly near a bifurcation."""
_NONE = "none"


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return, of each start, the ranges in which motions are of one kind, in SI units.

    Also the ranges in which different starts lead to different periodic motions.
    """
    name = data.attrs["parameter"]
    return {
        "parameter": name,
        "starts": {str(start): _ranges(data.sel(start=start)) for start in data["start"].values},
        "different_motions": _different(data),
    }


def _different(data: xr.Dataset) -> list[dict[str, Any]]:
    """Runs of values at which the periodic motions of two starts have other displacements."""
    name, motion = data.attrs["parameter"], data["motion"].transpose("start", ...).values
    values = data[name].values
    high, low = (
        data[end].transpose("start", name, ...).values.reshape(*motion.shape, -1)
        for end in ("displacement_max", "displacement_min")
    )
    periodic = (motion == "periodic")[..., np.newaxis]
    size = np.where(periodic, high - low, 0.0).max(axis=(0, 2))
    spread = np.max(
        [
            np.where(periodic, end, -np.inf).max(0) - np.where(periodic, end, np.inf).min(0)
            for end in (high, low)
        ],
        axis=(0, 2),
    )
    differs = spread > _EQUAL * size
    return [
        {"from": float(values[first]), "to": float(values[last]), "values": last - first + 1}
        for first, last in runs(differs)
    ]


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
        Column(name, ("from", "to"), 6, data[name].attrs["units"]),
        Column("values", "values"),
        Column("exponent at most", "largest_exponent", units="1/s"),
    )
    parts: list[RenderableType] = []
    for start, ranges in summary["starts"].items():
        parts += [Text(), Text(start[:1].upper() + start[1:], style="bold")]
        widest = sorted(ranges, key=lambda one: -one["values"])[:_MOST]
        chosen = [one for one in ranges if one in widest or one["motion"] == "undecided"]
        parts.append(table_of(chosen, columns))
        if more := len(ranges) - len(chosen):
            parts.append(Text(f"and {more} narrower range{'s' if more > 1 else ''}"))
    if summary["different_motions"]:
        parts.append(Text(f"\n{_different_text(summary['different_motions'], data[name])}"))
    every = [one for ranges in summary["starts"].values() for one in ranges]
    if data.sizes["stop"] and not any(any(one["contacts"].values()) for one in every):
        parts.append(Text(f"\nNote: {_UNTOUCHED}"))
    return Group(*parts)


_UNTOUCHED = (
    "none of these motions touches a stop. Motions that do may coexist: start from random states "
    "(--random), or compute basins of attraction at one value (vibroimpact basins)"
)


def _different_text(ranges: list[dict[str, Any]], along: xr.DataArray) -> str:
    """Write the ranges of different motions, in the unit of the tables."""
    ends = [one[end] for one in ranges for end in ("from", "to")]
    scale, words = heading(str(along.name), along.attrs["units"], ends)
    texts = [
        " to ".join(dict.fromkeys(plain(one[end] / scale.size) for end in ("from", "to")))
        for one in ranges[:_MOST]
    ]
    before = "ω = " if words == "ω" else ""
    more = f" and {len(ranges) - _MOST} more ranges" if len(ranges) > _MOST else ""
    return (
        f"Different periodic motions from different starts: "
        f"{before}{', '.join(texts)} {scale.symbol}"
    ).rstrip() + more


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
