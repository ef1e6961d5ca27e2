"""Curves of bifurcations in two parameters, as plain values and as text."""

from __future__ import annotations

import math
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.model.written_units import unitless


def facts(kind: str, names: tuple[str, str], curves: dict[str, xr.Dataset]) -> dict[str, Any]:
    """Return the curves with their cusps and how each ended, in SI units."""
    return {
        "bifurcation": kind,
        "parameters": list(names),
        "curves": [
            {
                "points": data.sizes["point"],
                "cusps": [list(cusp) for cusp in _cusps(data)],
                "ended_low": data.attrs["ended_low"],
                "ended_high": data.attrs["ended_high"],
            }
            for data in curves.values()
        ],
    }


def text(kind: str, names: tuple[str, str], curves: dict[str, xr.Dataset]) -> RenderableType:
    """Return the same as lines."""
    plural = "s" if len(curves) > 1 else ""
    lines = [Text(), Text(f"{len(curves)} {kind} curve{plural}", style="bold")]
    for name, data in curves.items():
        lines.append(
            Text(
                f"  {name}: {data.sizes['point']} point{'' if data.sizes['point'] == 1 else 's'}; "
                f"beginning: {data.attrs['ended_low']}; end: {data.attrs['ended_high']}"
            )
        )
        for cusp in _cusps(data):
            place = ", ".join(map(_at, names, cusp))
            lines.append(Text(f"    cusp at {place}"))
    return Group(*lines)


def _at(name: str, value: float) -> str:
    if name == "frequency" and unitless():
        return f"ω {math.tau * value:.9g}"
    return f"{name} {value:.9g}"


def _cusps(data: xr.Dataset) -> list[tuple[float, float]]:
    pairs = zip(data["cusp_first"].values, data["cusp_second"].values, strict=True)
    return [(float(p), float(q)) for p, q in pairs]
