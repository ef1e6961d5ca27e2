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
from vibroimpact.facts.assembly import assembly_of
from vibroimpact.facts.number_format import plain, shown_in, with_unit
from vibroimpact.facts.tables import titled_table
from vibroimpact.model import RigidStop
from vibroimpact.model.frequency_text import forcing, forcing_heading, forcings

_PROMINENCE = 0.02
"""Smallest prominence of a resonance, as a share of the largest value of its curve."""
_APART = 1e-3
"""Difference between the sweeps, as a share of the largest value, above which they differ."""
_DIGITS = 4


def facts(data: xr.Dataset, advice: list[str]) -> dict[str, Any]:
    """Return what a sweep of an assembly shows as nested plain values, in SI units."""
    frequency = data["frequency"].values
    return {
        "frequencies": {
            "from": float(frequency[0]),
            "to": float(frequency[-1]),
            "count": len(frequency),
        },
        "directions": [str(direction) for direction in data["direction"].values],
        "largest": _largest(data),
        "resonances": _resonances(data),
        "contact": [
            {"stop": str(stop), **one}
            for stop in data["stop"].values
            for one in _ranges(data, _hit(data).sel(stop=stop))
        ],
        "sweeps_differ": _differing(data),
        "unsettled": _ranges(data, data["motion"] != "periodic"),
        "advice": advice,
    }


def _hit(data: xr.Dataset) -> xr.DataArray:
    """Return where stops are touched. The force of a rigid stop that is hit is infinite."""
    return data["peak_force"] > 0.0


def _largest(data: xr.Dataset) -> dict[str, Any]:
    """Return the largest values by mass and stop, with frequency and direction."""

    def most(name: str, part: str, dim: str) -> dict[str, Any] | None:
        values = data[name].sel({dim: part}).transpose("direction", "frequency").values
        if not np.isfinite(values).any():
            return None
        # Of sweeps that agree to rounding, the first one.
        top = float(np.nanmax(values))
        d, f = np.unravel_index(np.argmax(values >= top - 1e-9 * abs(top)), values.shape)
        return {
            "value": float(values[d, f]),
            "frequency": float(data["frequency"][f]),
            "direction": str(data["direction"].values[d]),
        }

    stops = {}
    for name, stop in assembly_of(data).stops.items():
        what = "peak_impulse" if isinstance(stop.law, RigidStop) else "peak_force"
        stops[name] = {what: most(what, name, "stop")}
    return {
        "masses": {
            str(mass): {
                what: most(what, str(mass), "mass")
                for what in ("peak_displacement", "peak_acceleration")
            }
            for mass in data["mass"].values
        },
        "stops": stops,
    }


def _resonances(data: xr.Dataset) -> list[dict[str, Any]]:
    """Return the local maxima of the largest displacement of each mass."""
    frequency = data["frequency"].values
    found = []
    for mass in data["mass"].values:
        for direction in data["direction"].values:
            curve = data["peak_displacement"].sel(mass=mass, direction=direction).values
            curve = np.nan_to_num(curve)  # of holds that were given up
            least = _PROMINENCE * float(curve.max(initial=0.0))
            shaken = data["peak_acceleration"].sel(mass=mass, direction=direction).values
            found += [
                {
                    "mass": str(mass),
                    "direction": str(direction),
                    "frequency": float(frequency[i]),
                    "peak_displacement": float(curve[i]),
                    "peak_acceleration": float(shaken[i]),
                }
                for i in scipy.signal.find_peaks(curve, prominence=least or None)[0]
            ]
    return found


def _ranges(data: xr.Dataset, where: xr.DataArray) -> list[dict[str, Any]]:
    """Return the ranges of frequencies in which something is true, by direction."""
    found = []
    for direction in data["direction"].values:
        for low, high in _runs(data, where.sel(direction=direction).values):
            found.append({"direction": str(direction), "low": low, "high": high})
    return found


def _runs(data: xr.Dataset, where: NDArray[np.bool_]) -> list[tuple[float, float]]:
    frequency = data["frequency"].values
    edges = np.flatnonzero(np.diff(np.concatenate([[0], where.astype(int), [0]])))
    return [(float(frequency[a]), float(frequency[b - 1])) for a, b in edges.reshape(-1, 2)]


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


def text(data: xr.Dataset, advice: list[str]) -> RenderableType:
    """Return what a sweep of an assembly shows as tables."""
    found = facts(data, advice)
    about, directions = found["frequencies"], " and ".join(found["directions"])
    parts: list[RenderableType] = [
        Text(
            f"{about['count']} frequencies from {forcings(about['from'], about['to'])}, "
            f"{directions}"
            if about["count"] > 1
            else f"1 frequency, {forcing(about['from'])}, {directions}"
        ),
        Text(),
        _largest_table("Largest, by mass", "mass", found["largest"]["masses"]),
    ]
    if found["largest"]["stops"]:
        stops = _largest_table("Largest, by stop", "stop", found["largest"]["stops"])
        parts += [Text(), stops]
    parts += [Text(), _resonance_table(found["resonances"]), Text()]
    differ = ", ".join(forcings(one["low"], one["high"]) for one in found["sweeps_differ"])
    if len(found["directions"]) < 2:
        parts.append(Text("Hysteresis: not computed, because it needs both sweep directions"))
    else:
        parts.append(Text(f"Hysteresis: {differ or 'none'}"))
    parts.append(_spans("Contact", found["contact"], "stop"))
    parts.append(_spans("Motion not settled", found["unsettled"]))
    parts += [Text(f"Note: {line}") for line in noted(data)]
    parts += [Text(f"Advice: {line}", style="yellow") for line in advice]
    return Group(*parts)


_COLUMNS = {
    "peak_displacement": ("displacement", "m"),
    "peak_acceleration": ("acceleration", "m s-2"),
    "peak_force": ("force", "N"),
    "peak_impulse": ("impulse", "N s"),
}


def _largest_table(title: str, what: str, rows: dict[str, Any]) -> RenderableType:
    table = titled_table(title, what)
    columns = list(dict.fromkeys(key for row in rows.values() for key in row))
    scales = {}
    for key in columns:
        words, units = _COLUMNS[key]
        known = [row[key]["value"] for row in rows.values() if row.get(key)]
        scales[key] = shown_in(units, known or [0.0])
        table.add_column(with_unit(words, scales[key].symbol), justify="right")
        table.add_column("")
    for name, row in rows.items():
        cells: list[str] = []
        for key in columns:
            one = row.get(key)
            if one is None:
                cells += ["", ""]
            else:
                at = f"at {forcing(one['frequency'])}, {one['direction']}" if one["value"] else ""
                cells += [plain(one["value"] / scales[key].size, _DIGITS), at]
        table.add_row(name, *cells)
    return table


def _resonance_table(found: list[dict[str, Any]]) -> RenderableType:
    if not found:
        return Text("Resonances: none in this range")
    turn, heading = forcing_heading()
    table = titled_table("Resonances, by mass", "mass", "sweep")
    keys = ("peak_displacement", "peak_acceleration")
    scales = {key: shown_in(_COLUMNS[key][1], [one[key] for one in found]) for key in keys}
    for words in (heading, *(with_unit(_COLUMNS[key][0], scales[key].symbol) for key in keys)):
        table.add_column(words, justify="right")
    for one in found:
        table.add_row(
            one["mass"],
            one["direction"],
            plain(turn * one["frequency"]),
            *(plain(one[key] / scales[key].size, _DIGITS) for key in keys),
        )
    return table


def _spans(title: str, ranges: list[dict[str, Any]], by: str = "") -> RenderableType:
    if not ranges:
        return Text(f"{title}: at no frequency")
    lines = [title]
    groups = dict.fromkeys((one.get(by, ""), one["direction"]) for one in ranges)
    for name, direction in groups:
        mine = [
            forcings(one["low"], one["high"])
            for one in ranges
            if (one.get(by, ""), one["direction"]) == (name, direction)
        ]
        lines.append(f"  {f'{name}, ' if name else ''}{direction}: {', '.join(mine)}")
    return Text("\n".join(lines))
