"""Branches of periodic orbits and their bifurcations, as plain values and as text."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.facts.number_format import heading, plain

_DIGITS = 10
"""Significant digits of the value of a bifurcation."""


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return the bifurcations and how each branch ended, in SI units."""
    found = []
    for i in range(data.sizes["bifurcation"]):
        row = data.isel(bifurcation=i)
        found.append(
            {
                "branch": int(row["bifurcation_branch"]),
                "kind": row["bifurcation_kind"].item(),
                "value": float(row["bifurcation_value"]),
                "period": int(row["bifurcation_period"]),
                "turns": bool(row["bifurcation_turns"]),
                "contacts": row["bifurcation_contacts"].item(),
                # Of several masses, no displacement without stops is the reference.
                "eta_d": float(row["bifurcation_eta_d"]) if "bifurcation_eta_d" in row else None,
                "multipliers": [
                    [float(real), float(imaginary)]
                    for real, imaginary in zip(
                        row["bifurcation_multiplier_real"].values,
                        row["bifurcation_multiplier_imag"].values,
                        strict=True,
                    )
                ],
            }
        )
    branches = []
    for number in np.unique(data["branch"].values):
        prefix = _prefix(data, int(number))
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
    return {"parameter": data.attrs["parameter"], "branches": branches, "bifurcations": found}


def text(data: xr.Dataset) -> RenderableType:
    """Return the branches and their bifurcations as tables."""
    told = facts(data)
    units = data[told["parameter"]].attrs["units"]
    parts: list[RenderableType] = []
    for one in told["branches"]:
        number = one["branch"]
        plural = "" if one["points"] == 1 else "s"
        title = f"Branch {number}: period {one['period']}, {one['points']} orbit{plural}"
        parts += [Text(), Text(title, style="bold")]
        if one["closed"]:
            parts.append(Text("the branch is a closed curve"))
        else:
            parts.append(Text(f"beginning: {one['ended_low']}; end: {one['ended_high']}"))
        mine = [b for b in told["bifurcations"] if b["branch"] == number]
        parts.append(_table(mine, told["parameter"], units) if mine else Text("no bifurcation"))
    return Group(*parts)


def bifurcations(data: xr.Dataset) -> RenderableType:
    """Return the bifurcations of all branches in one table, by rising parameter.

    A bifurcation at which several branches meet is listed once.
    """
    told = facts(data)
    name, found = told["parameter"], told["bifurcations"]
    if not found:
        return Text("\nNo bifurcation on the branches")
    unit, words = heading(name, data[name].attrs["units"], [one["value"] for one in found])
    table = Table("bifurcation", box=None, pad_edge=False, padding=(0, 2, 0, 2), header_style="dim")
    for column in (words, "η_d"):
        table.add_column(column, justify="right")
    rows = [
        (one["kind"], plain(one["value"] / unit.size, _DIGITS), plain(one["eta_d"], 4))
        for one in sorted(found, key=lambda one: float(one["value"]))
    ]
    for row in dict.fromkeys(rows):
        table.add_row(*row)
    return Group(Text("\nBifurcations on the branches", style="bold"), table)


def _table(found: list[dict[str, Any]], parameter: str, units: str) -> Table:
    table = Table("bifurcation", box=None, pad_edge=False, padding=(0, 2, 0, 2), header_style="dim")
    unit, words = heading(parameter, units, [one["value"] for one in found])
    has_eta = any(one["eta_d"] is not None for one in found)
    for name in (words, *(["η_d"] if has_eta else []), "largest multipliers", ""):
        table.add_column(name, justify="right")
    for one in found:
        first, second = one["multipliers"][:2]
        if abs(first[1]) > 1e-9 * abs(first[0]):
            largest = f"{first[0]:.4f} ± {abs(first[1]):.4f}i"
        else:
            largest = f"{first[0]:.4f}, {second[0]:.4f}"
        table.add_row(
            one["kind"],
            f"{plain(one['value'] / unit.size, _DIGITS)}",
            *([f"{plain(one['eta_d'], 4)}"] if has_eta else []),
            largest,
            _note(one),
        )
    return table


def _note(one: dict[str, Any]) -> str:
    if one["turns"]:
        return "turns back"
    return str(one["contacts"]) if one["kind"] == "grazing" else ""


def _prefix(data: xr.Dataset, number: int) -> str:
    return "" if "closed" in data.attrs else f"branch_{number}_"
