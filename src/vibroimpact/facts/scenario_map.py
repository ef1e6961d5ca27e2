"""A map of scenarios: the share of each, the border of jumps, and what is not varied."""

from __future__ import annotations

import math
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.tables import Column, table_of
from vibroimpact.model import Rig, to_dimensionless
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.model.quantities import LENGTH, STIFFNESS
from vibroimpact.model.units import pretty
from vibroimpact.scenarios.axes import ONE_QUANTITY
from vibroimpact.scenarios.scenario import Scenario

_SYMBOLS = {"acceleration": "A =", "displacement": "X =", "force": "F =", "unbalance": "m e ="}

_SHARES = (
    Column("", "label", left=True),
    Column("", "share", "{:.1%}"),
    Column("", "meaning", left=True),
)


def facts(data: xr.Dataset, border: xr.Dataset | None) -> dict[str, Any]:
    """Return the shares of the nodes and the points of the border, in SI units."""
    y, x = (str(name) for name in data["scenario"].dims)
    points: list[dict[str, float]] = []
    if border is not None:
        pairs = zip(border[x].values, border[y].values, strict=True)
        points = [{x: float(p), y: float(q)} for p, q in pairs]
    return {
        "x": x,
        "y": y,
        "nodes": int(data["scenario"].size),
        "computed": int((data["level"].values >= 0).sum()),
        "shares": _shares(data),
        "border": points,
    }


def text(data: xr.Dataset, refine: int) -> RenderableType:
    """Return the shares as a table; the first grid was refined so often."""
    summary = facts(data, None)
    kinds = {one.label: one.meaning for one in Scenario}
    shares = [
        {"label": label, "share": share, "meaning": kinds[label]}
        for label, share in summary["shares"].items()
    ]
    rows, columns = (((size - 1) >> refine) + 1 for size in data["scenario"].shape)
    refined = {0: "", 1: ", refined once"}.get(refine, f", refined {refine} times")
    line = (
        f"{columns} × {rows} nodes{refined}: {summary['computed']} of {summary['nodes']} computed; "
        "shares of the scenarios:"
    )
    return Group(Text(line), table_of(shares, _SHARES))


def constants(rig: Rig, x: str, y: str) -> str:
    """Return the parameters that the map does not vary, with their values."""
    varied = {x, y}
    stops, shaken = rig.oscillator.stops.values(), rig.periodic
    bumpers = [one for stop in stops if (one := stop.spring_and_dashpot)]
    restitutions = PARAMETERS["stops.restitution"].numbers(rig)
    for pair in ONE_QUANTITY:
        varied |= pair if varied & pair else set()
    if "stops.stiffness" in (x, y):
        varied.add("relaxation_time")  # the damping is held
    rest = {
        "stops.restitution": ("e =", [f"{e:.3g}" for e in restitutions]),
        "relaxation_time": (
            "τ =",
            [f"{rig.oscillator.angular_frequency * c / k:.3g}" for k, c in bumpers],
        ),
        "damping_ratio": ("ξ =", [f"{rig.oscillator.damping_ratio:.3g}"]),
    }
    if any(PARAMETERS[name].physical for name in (x, y)):
        quantities = {
            "gap": ("gap", [pretty(stop.gap, LENGTH) for stop in stops]),
            "proportional_stiffness": (
                "bumpers",
                [pretty(k, STIFFNESS) for k, _ in bumpers],
            ),
            "amplitude": (_SYMBOLS[shaken.of], [pretty(shaken.amplitude, shaken.quantity)]),
            **rest,
        }
    else:
        group = to_dimensionless(rig)
        halves = [b for b in (group.right, group.left) if b is not None]
        quantities = {
            "stiffness_ratio": ("λ =", [_ratio(b.stiffness_ratio) for b in halves]),
            "gap_ratio": ("δ0 =", [f"{b.gap:.4g}" for b in halves]),
            **rest,
        }
    return ", ".join(
        f"{symbol} {' and '.join(dict.fromkeys(values))}"
        for name, (symbol, values) in quantities.items()
        if values and name not in varied
    )


def _ratio(value: float) -> str:
    """λ; that of a rigid stop is infinite."""
    return f"{value:.4g}" if math.isfinite(value) else "∞"


def _shares(data: xr.Dataset) -> dict[str, float]:
    """Share of the nodes by scenario, those that occur."""
    kinds = data["scenario"].values
    return {s.label: float((kinds == s).mean()) for s in Scenario if (kinds == s).any()}
