"""A sweep of several masses: resonances, largest values, contacts, and where sweeps differ."""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy
import xarray as xr
from numpy.typing import NDArray
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.description import noted
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.facts.assembly import assembly_of
from vibroimpact.facts.largest import largest, place
from vibroimpact.facts.number_format import heading as unit_heading
from vibroimpact.facts.sweeps import jump_columns, ranges, steep_steps, steps, steps_text
from vibroimpact.facts.tables import Column, table_of
from vibroimpact.model.frequency_text import forcings
from vibroimpact.model.units import plain
from vibroimpact.response.mass_jumps import MassJumps
from vibroimpact.response.resonance import runs

_PROMINENCE = 0.02
"""Smallest prominence of a resonance, as a share of the largest value of its curve."""
_APART = 1e-3
"""Difference between the sweeps, as a share of the largest value, above which they differ."""
_WORDS = {
    "peak_displacement": "displacement",
    "peak_acceleration": "acceleration",
    "peak_force": "force",
    "peak_impulse": "impulse",
}
_RESONANCES = (
    Column("mass", "mass", left=True),
    Column("sweep", "direction", left=True),
    Column("frequency", "frequency", 6),
    Column("displacement", "peak_displacement"),
    Column("acceleration", "peak_acceleration"),
)


def facts(data: xr.Dataset, jumps: MassJumps, advice: list[str]) -> dict[str, Any]:
    """Return what a sweep of an assembly shows as nested plain values, in SI units."""
    return {
        **steps(data),
        "largest": _largest(data),
        "resonances": _resonances(data),
        "contact": [
            {"stop": str(stop), **one}
            for stop in data["stop"].values
            # The force of a rigid stop that is hit is infinite.
            for one in _ranges(data, data["peak_force"].sel(stop=stop) > 0.0)
        ],
        "jumps": [one._asdict() for one in jumps.jumps],
        "steep": [one._asdict() for one in jumps.steep],
        "sweeps_differ": _differing(data),
        "unsettled": _ranges(data, data["motion"] != "periodic"),
        "advice": advice,
    }


def _largest(data: xr.Dataset) -> dict[str, Any]:
    """Return the largest values by mass and stop, with frequency and direction."""
    stops = {}
    for name, stop in assembly_of(data).stops.items():
        what = "peak_impulse" if stop.stop.rigid else "peak_force"
        stops[name] = {what: largest(data[what].sel(stop=name))}
    return {
        "masses": {
            str(mass): {
                what: largest(data[what].sel(mass=mass))
                for what in ("peak_displacement", "peak_acceleration")
            }
            for mass in data["mass"].values
        },
        "stops": stops,
    }


def _resonances(data: xr.Dataset) -> list[dict[str, Any]]:
    """Return the local maxima of the largest displacement of each mass."""
    frequency = data["frequency"].values
    resonances = []
    for mass in data["mass"].values:
        for direction in data["direction"].values:
            curve = data["peak_displacement"].sel(mass=mass, direction=direction).values
            curve = np.nan_to_num(curve)  # of holds that were given up
            least = _PROMINENCE * float(curve.max(initial=0.0))
            shaken = data["peak_acceleration"].sel(mass=mass, direction=direction).values
            resonances += [
                {
                    "mass": str(mass),
                    "direction": str(direction),
                    "frequency": float(frequency[i]),
                    "peak_displacement": float(curve[i]),
                    "peak_acceleration": float(shaken[i]),
                }
                for i in scipy.signal.find_peaks(curve, prominence=least or None)[0]
            ]
    return resonances


def _jumps_table(jumps: list[dict[str, Any]]) -> RenderableType:
    """Return the jumps as a table, and where to look for their folds."""
    if not jumps:
        return Text("Jumps: none")
    columns = jump_columns(
        Column("mass", "mass", left=True),
        *(_ends(jumps, name) for name in ("peak_displacement", "peak_acceleration")),
    )
    hint = "vibroimpact branch locates the folds between these frequencies"
    title = "Jumps, of the mass that changes most"
    return Group(table_of(jumps, columns, title), Text(hint))


def _ends(jumps: list[dict[str, Any]], name: str) -> Column:
    """Return the column of a quantity before and after each jump."""
    numbers = [end for one in jumps for end in one[name]]
    scale, words = unit_heading(_WORDS[name], VARIABLES[name].units, numbers)
    return Column(
        words,
        lambda one: " → ".join(plain(end / scale.size, 4) for end in one[name]),
        left=True,
    )


def _ranges(data: xr.Dataset, where: xr.DataArray) -> list[dict[str, Any]]:
    """Return the ranges of frequencies in which something is true, by direction."""
    intervals = []
    for direction in data["direction"].values:
        for low, high in _runs(data, where.sel(direction=direction).values):
            intervals.append({"direction": str(direction), "low": low, "high": high})
    return intervals


def _runs(data: xr.Dataset, where: NDArray[np.bool_]) -> list[tuple[float, float]]:
    frequency = data["frequency"].values
    return [(float(frequency[first]), float(frequency[last])) for first, last in runs(where)]


def _differing(data: xr.Dataset) -> list[dict[str, float]]:
    """Return the ranges in which the two sweeps reach different periodic motions."""
    if data.sizes["direction"] < 2:
        return []
    values = data["peak_displacement"].transpose("direction", "frequency", "mass").values
    scale = np.nanmax(np.abs(values), axis=(0, 1))
    apart = np.abs(values[0] - values[1]) > _APART * scale
    # Extremes of a motion that has not settled depend on how long it is measured.
    settled = (data["motion"] == "periodic").all("direction").values
    apart &= settled[:, np.newaxis]
    return [{"low": low, "high": high} for low, high in _runs(data, apart.any(axis=1))]


def text(data: xr.Dataset, jumps: MassJumps, advice: list[str]) -> RenderableType:
    """Return what a sweep of an assembly shows as tables."""
    summary = facts(data, jumps, advice)
    parts: list[RenderableType] = [
        steps_text(data),
        Text(),
        _largest_table("mass", summary["largest"]["masses"]),
    ]
    if summary["largest"]["stops"]:
        parts += [Text(), _largest_table("stop", summary["largest"]["stops"])]
    resonances: RenderableType = Text("Resonances: none in this range")
    if summary["resonances"]:
        resonances = table_of(summary["resonances"], _RESONANCES, "Resonances, by mass")
    differ = ", ".join(forcings(one["low"], one["high"]) for one in summary["sweeps_differ"])
    if len(summary["directions"]) < 2:
        differ = "not computed, because it needs both sweep directions"
    contact = [
        (f"{one['stop']}, {one['direction']}", one["low"], one["high"])
        for one in summary["contact"]
    ]
    unsettled = [(one["direction"], one["low"], one["high"]) for one in summary["unsettled"]]
    lines = [
        Text(f"Hysteresis: {differ or 'none'}"),
        ranges("Contact", contact),
        ranges("Motion not settled", unsettled),
        *(Text(f"Note: {line}") for line in noted(data)),
        *(Text(f"Advice: {line}", style="yellow") for line in advice),
    ]
    table = [_jumps_table(summary["jumps"]), *steep_steps(jumps.steep)]
    return Group(*parts, Text(), resonances, Text(), *table, Text(), *lines)


def _largest_table(part: str, by_name: dict[str, Any]) -> RenderableType:
    """Return a table with two columns for each quantity: its largest value, and where it is."""
    rows = [
        {
            part: name,
            **{key: one["value"] for key, one in values.items() if one},
            **{f"{key} at": place(one) for key, one in values.items() if one and one["value"]},
        }
        for name, values in by_name.items()
    ]
    columns = [Column(part, part, left=True)]
    for key in dict.fromkeys(key for values in by_name.values() for key in values):
        columns += [Column(_WORDS[key], key), Column("", f"{key} at", left=True)]
    return table_of(rows, columns, f"Largest, by {part}")
