"""An ensemble of rigs: fractiles of the peaks and sensitivity indices, as values and as text."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.stops import quantities, quantity
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.facts.number_format import shown_in
from vibroimpact.facts.tables import Column, table_of
from vibroimpact.model.units import plain
from vibroimpact.response.curve_pair import in_contact

_SHARES = (0.05, 0.5, 0.95)
_PEAKS = {
    "eta_a": "largest η_a",
    "eta_d": "largest η_d",
    "peak_acceleration": "largest absolute acceleration",
    "peak_displacement": "largest displacement",
    "peak_force": "largest contact force",
}
_FRACTILES = (
    Column("fractiles over the rigs", "words", left=True),
    *(Column(f"{100 * share:g} %", f"{share}") for share in _SHARES),
    Column("", "symbol", left=True),
)


def facts(
    data: xr.Dataset, distributions: dict[str, str], indices: dict[str, xr.Dataset]
) -> dict[str, Any]:
    """Return fractiles of the peaks over all frequencies, in SI units, and the indices."""
    peaks = _peaks(data)
    touches = in_contact(data).any(("direction", "frequency"))
    return {
        "uncertain": distributions,
        "samples": data.sizes["sample"],
        "shares": list(_SHARES),
        "peaks": {
            name: [float(v) for v in np.quantile(values, _SHARES)] for name, values in peaks.items()
        },
        "touching": float(touches.mean()),
        "sensitivity": {
            name: {
                str(one): {
                    order: float(dataset[order].sel(uncertain_parameter=one))
                    for order in ("first_order", "total_order")
                }
                for one in dataset["uncertain_parameter"].values
            }
            for name, dataset in indices.items()
        },
    }


def _peaks(data: xr.Dataset) -> dict[str, Any]:
    """The largest of each curve, over both directions; what is not known is left out."""
    names = list(_PEAKS)
    if "mass" in data.dims:  # of each mass and each stop
        every = [one.partition(".") for one in quantities(data)]
        names = [f"{name}.{part}" for name, _, part in every if part and name in _PEAKS]
    peaks = {}
    for name in names:
        values = quantity(data, name)
        if np.isinf(values).any():  # of a rigid stop
            name = name.replace("peak_force", "peak_impulse")
            values = quantity(data, name)
        peaks[name] = values.max(("direction", "frequency")).dropna("sample").values
    return {name: values for name, values in peaks.items() if len(values)}


def text(
    data: xr.Dataset, distributions: dict[str, str], indices: dict[str, xr.Dataset]
) -> RenderableType:
    """Return the same as sentences and tables."""
    summary = facts(data, distributions, indices)
    spread = ", ".join(f"{name.replace('_', ' ')} {text}" for name, text in distributions.items())
    parts: list[RenderableType] = [
        Text(),
        Text(f"{summary['samples']} rig{'' if summary['samples'] == 1 else 's'}: {spread}"),
        Text(f"{100.0 * summary['touching']:.3g} % of them touch a stop at some frequency."),
        Text(),
        table_of([_fractiles(*one) for one in summary["peaks"].items()], _FRACTILES),
    ]
    for name, orders in summary["sensitivity"].items():
        rows = [{"parameter": one.replace("_", " "), **shares} for one, shares in orders.items()]
        rows.sort(key=lambda one: -one["total_order"])
        parts += [Text(), table_of(rows, _orders(_PEAKS[name]))]
    return Group(*parts)


def _fractiles(name: str, values: list[float]) -> dict[str, str]:
    name, _, part = name.partition(".")
    scale = shown_in(VARIABLES[name].units, values)
    texts = [plain(value / scale.size, 4) for value in values]
    words = {**_PEAKS, "peak_impulse": "largest impulse"}[name]
    return {
        "words": f"{words}, {part}" if part else words,
        **dict(zip(map(str, _SHARES), texts, strict=True)),
        "symbol": scale.symbol,
    }


def _orders(words: str) -> tuple[Column, ...]:
    return (
        Column(f"share of the variance of the {words}", "parameter", left=True),
        Column("parameter alone", lambda one: round(one["first_order"], 2) + 0.0, "{:.2f}"),
        Column("with interactions", lambda one: round(one["total_order"], 2) + 0.0, "{:.2f}"),
    )
