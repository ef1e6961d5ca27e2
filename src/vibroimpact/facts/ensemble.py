"""An ensemble of rigs: fractiles of the peaks and sensitivity indices, as values and as text."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.datasets.stops import over_stops
from vibroimpact.facts.number_format import ACCELERATIONS, FORCES, LENGTHS, fitting, plain
from vibroimpact.response.curve_pair import in_contact

_SHARES = (0.05, 0.5, 0.95)
_PEAKS = {
    "eta_a": ("largest η_a", None),
    "eta_d": ("largest η_d", None),
    "peak_acceleration": ("largest absolute acceleration", ACCELERATIONS),
    "peak_displacement": ("largest displacement", LENGTHS),
    "peak_force": ("largest contact force", FORCES),
}


def facts(
    data: xr.Dataset, given: dict[str, str], indices: dict[str, xr.Dataset]
) -> dict[str, Any]:
    """Return fractiles of the peaks over all frequencies, in SI units, and the indices."""
    peaks = _peaks(data)
    touches = in_contact(data).any(("direction", "frequency"))
    return {
        "uncertain": given,
        "samples": data.sizes["sample"],
        "shares": list(_SHARES),
        "peaks": {
            name: [float(v) for v in np.quantile(values, _SHARES)] for name, values in peaks.items()
        },
        "touching": float(touches.mean()),
        "sensitivity": {
            name: {
                str(one): {
                    order: float(found[order].sel(uncertain_parameter=one))
                    for order in ("first_order", "total_order")
                }
                for one in found["uncertain_parameter"].values
            }
            for name, found in indices.items()
        },
    }


def _peaks(data: xr.Dataset) -> dict[str, Any]:
    """The largest of each curve, over both directions; what is not known is left out."""
    every = {name: over_stops(data[name]).max(("direction", "frequency")) for name in _PEAKS}
    found = {name: one.dropna("sample").values for name, one in every.items()}
    return {name: values for name, values in found.items() if len(values)}


def text(data: xr.Dataset, given: dict[str, str], indices: dict[str, xr.Dataset]) -> RenderableType:
    """Return the same as sentences and tables."""
    told = facts(data, given, indices)
    spread = ", ".join(f"{name.replace('_', ' ')} {text}" for name, text in given.items())
    parts: list[RenderableType] = [
        Text(),
        Text(f"{told['samples']} rig{'' if told['samples'] == 1 else 's'}: {spread}"),
        Text(f"{100.0 * told['touching']:.3g} % of them touch a stop at some frequency."),
        Text(),
        _fractiles(told["peaks"]),
    ]
    for name, orders in told["sensitivity"].items():
        parts += [Text(), _orders(_PEAKS[name][0], orders)]
    return Group(*parts)


def _fractiles(peaks: dict[str, list[float]]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 2), header_style="dim")
    table.add_column("fractiles over the rigs")
    for share in _SHARES:
        table.add_column(f"{100 * share:g} %", justify="right")
    table.add_column("")
    for name, values in peaks.items():
        words, scales = _PEAKS[name]
        finite = [value for value in values if np.isfinite(value)]
        unit = None if scales is None or not finite else fitting(finite, scales)
        size = 1.0 if unit is None else unit.size
        table.add_row(
            words, *(plain(v / size, 4) for v in values), "" if unit is None else unit.symbol
        )
    return table


def _orders(words: str, orders: dict[str, dict[str, float]]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 2), header_style="dim")
    table.add_column(f"share of the variance of the {words}")
    for name in ("parameter alone", "with interactions"):
        table.add_column(name, justify="right")
    for name, one in sorted(orders.items(), key=lambda item: -item[1]["total_order"]):
        table.add_row(
            name.replace("_", " "), *(f"{round(value, 2) + 0.0:.2f}" for value in one.values())
        )
    return table
