"""Branches of periodic orbits and their bifurcations, as plain values and as text."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.tables import Column, table_of, values_along
from vibroimpact.model.units import plain

_DIGITS = 10
"""Significant digits of the value of a bifurcation."""
_OF_A_BIFURCATION = ("branch", "kind", "value", "period", "turns", "contacts")


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return the bifurcations and how each branch ended, in SI units."""
    rows = values_along(data, "bifurcation", _OF_A_BIFURCATION, "bifurcation_")
    # Of several masses, no displacement without stops is the reference.
    eta_d = data["bifurcation_eta_d"].values if "bifurcation_eta_d" in data else [None] * len(rows)
    multipliers = np.stack(
        [data[f"bifurcation_multiplier_{part}"].values for part in ("real", "imag")], axis=-1
    )
    entries = [
        {**row, "turns": bool(row["turns"]), "eta_d": eta, "multipliers": pairs}
        for row, eta, pairs in zip(
            rows, np.asarray(eta_d).tolist(), multipliers.tolist(), strict=True
        )
    ]
    branches = []
    for number in np.unique(data["branch"].values):
        prefix = "" if "closed" in data.attrs else f"branch_{number}_"
        mine = data["branch"].values == number
        branches.append(
            {
                "branch": int(number),
                "points": int(mine.sum()),
                "period": int(data["period"].values[mine][0]),
                "closed": bool(data.attrs[f"{prefix}closed"]),
                "ended_low": data.attrs[f"{prefix}ended_low"],
                "ended_high": data.attrs[f"{prefix}ended_high"],
            }
        )
    return {"parameter": data.attrs["parameter"], "branches": branches, "bifurcations": entries}


def text(data: xr.Dataset) -> RenderableType:
    """Return the branches and their bifurcations as tables."""
    summary = facts(data)
    columns = _columns(data, summary["parameter"])
    parts: list[RenderableType] = []
    for one in summary["branches"]:
        number = one["branch"]
        plural = "" if one["points"] == 1 else "s"
        title = f"Branch {number}: period {one['period']}, {one['points']} orbit{plural}"
        parts += [Text(), Text(title, style="bold")]
        if one["closed"]:
            parts.append(Text("the branch is a closed curve"))
        else:
            parts.append(Text(f"beginning: {one['ended_low']}; end: {one['ended_high']}"))
        mine = [b for b in summary["bifurcations"] if b["branch"] == number]
        parts.append(table_of(mine, columns) if mine else Text("no bifurcation"))
    return Group(*parts)


def bifurcations(data: xr.Dataset) -> RenderableType:
    """Return the bifurcations of all branches in one table, by rising parameter.

    A bifurcation at which several branches meet is listed once.
    """
    summary = facts(data)
    name, entries = summary["parameter"], summary["bifurcations"]
    if not entries:
        return Text("\nNo bifurcation on the branches")
    kind, *others, _, _ = _columns(data, name)
    rows = sorted(entries, key=lambda one: float(one["value"]))
    at_once = {
        (
            one["kind"],
            plain(one["value"], _DIGITS),
            None if one["eta_d"] is None else plain(one["eta_d"]),
        ): one
        for one in rows
    }
    table = table_of(list(at_once.values()), (kind, *others))
    return Group(Text("\nBifurcations on the branches", style="bold"), table)


def _columns(data: xr.Dataset, parameter: str) -> tuple[Column, ...]:
    units = data[parameter].attrs["units"]
    return (
        Column("bifurcation", "kind", left=True),
        Column(parameter, "value", _DIGITS, units),
        *([Column("η_d", "eta_d")] if "bifurcation_eta_d" in data else []),
        Column("largest multipliers", lambda one: _multipliers(*one["multipliers"][:2])),
        Column("", _note),
    )


def _multipliers(first: list[float], second: list[float]) -> str:
    if abs(first[1]) > 1e-9 * abs(first[0]):
        return f"{first[0]:.4f} ± {abs(first[1]):.4f}i"
    return f"{first[0]:.4f}, {second[0]:.4f}"


def _note(one: Mapping[str, Any]) -> str:
    if one["turns"]:
        return "turns back"
    return str(one["contacts"]) if one["kind"] == "grazing" else ""
