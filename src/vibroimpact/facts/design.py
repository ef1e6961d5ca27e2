"""The required gap, a design chart and the best design, as plain values and as text."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from rich.console import RenderableType
from rich.text import Text

from vibroimpact.datasets.description import noted
from vibroimpact.datasets.stops import over_parts, over_stops, plain_values
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.design.design_shaking import fractile_of
from vibroimpact.earthquakes.suites import quantiles
from vibroimpact.facts.number_format import written
from vibroimpact.facts.tables import Column, table_of
from vibroimpact.model import GRAVITY
from vibroimpact.model.parameters import PARAMETERS, in_units, usual
from vibroimpact.model.quantities import LENGTH
from vibroimpact.model.system import System
from vibroimpact.model.units import plain, pretty
from vibroimpact.model.written_units import unitless

_HEADS = {"stiffness_at_restitution": "stops.stiffness"}
_GAPS = ("common_gap", "required_gap")
_ROWS = 8
"""Largest number of designs of the front that are printed."""


def facts(gap: xr.Dataset, data: xr.Dataset, least: xr.Dataset | None) -> dict[str, Any]:
    """Return every number, in SI units."""
    return {
        **{name: plain_values(gap[name]) for name in _GAPS if name in gap},
        **_records_facts(gap),
        "designs": int(data["pareto"].size),
        **_limits_facts(data),
        "front": [
            {str(name): plain_values(value) for name, value in one.items()} for one in _front(data)
        ],
        "best": None
        if least is None
        else {
            **{str(name): plain_values(value) for name, value in least.data_vars.items()},
            "notes": noted(least),
        },
    }


def text(
    rig: System,
    gap: xr.Dataset,
    data: xr.Dataset,
    least: xr.Dataset | None,
    records: list[str],
    *,
    chosen: bool = False,
) -> Iterator[RenderableType]:
    """Return sentences, and a table of the designs that no other design dominates.

    ``chosen`` states whether an option sets the gap of the rig.
    """
    share = fractile_of(gap)
    yield Text()
    if rig.by_mass:
        yield from _gaps_of_stops(rig, gap, records, share)
    else:
        yield from _gap_of_both(rig, gap, records, share)
    rows = list(_front(data))
    dims = [str(dim) for dim in data["pareto"].dims]
    size = " × ".join(str(n) for n in data["pareto"].shape)
    over = " and ".join(_words(dim) for dim in dims)
    yield Text(f"Designs: {size}, over {over}; {_which(data, len(rows))}.")
    if "gap" in dims and rig.stops and least is not None:
        yield Text(f"The designs vary the gap; only the search keeps {_gaps(rig)}.")
    elif "gap" in dims and rig.stops and chosen:
        yield Text(f"The designs vary the gap; {_gaps(rig)} does not affect them.")
    if share is not None:
        yield Text(
            f"All values are {_percent(share)} fractiles over the records, for each quantity "
            "separately; limits apply to these fractiles."
        )
    dampings = data["stops.damping"].values if "stops.damping" in data.data_vars else np.zeros(1)
    beside = ["stops.damping"] if np.ptp(dampings) > 0.0 else []
    if not beside and dampings.any():
        yield Text(
            "All designs keep the bumpers' damping of "
            f"{_value('stops.damping', dampings.flat[0])}; --vary stiffness_at_restitution keeps "
            "their restitution instead."
        )
    if len(rows) > _ROWS:
        yield Text(f"{_ROWS} of the {len(rows)} designs that are not dominated:")
    if rows:
        yield _table(rows, [*dims, *beside])
    if least is not None:
        best = ", ".join(
            f"{_words(name)} {_value(name, float(least[name]))}"
            for name in map(str, least.data_vars)
            if name in PARAMETERS or "." in name
        )
        yield Text()
        of = "" if share is None else f", as {_percent(share)} fractiles"
        yield Text(f"Least acceleration for {_gaps(rig)}: {best}: {_demands(least)}{of}.")
        for note in noted(least):
            yield Text(f"Note on this design: {note}.")


def _gap_of_both(
    rig: System, gap: xr.Dataset, records: list[str], share: float | None
) -> Iterator[Text]:
    """Yield the gap that one mass requires, and whether that of the rig is sufficient."""
    if share is None:
        yield Text(_needed(gap, records))
    else:
        yield Text(_needed_by_share(gap, records, share))
    if rig.stops:
        yield Text(_enough(rig, gap) if share is None else _enough_for_share(rig, gap, share))


def _gaps_of_stops(
    assembly: System, gap: xr.Dataset, records: list[str], share: float | None
) -> Iterator[RenderableType]:
    """Yield a table of the gap that each stop requires."""
    under = f"under {', '.join(records)}" if records else "under the sines"
    of = "" if share is None else f" ({_percent(share)} fractile)"
    yield Text(f"Required gaps for no contact {under}{of}")
    rows = []
    for name, required in plain_values(gap["required_gap"]).items():
        here = assembly.stop_laws[name].gap
        row = {"stop": name, "gap": _length(here), "required": _length(required)}
        row["short"] = "sufficient" if here >= required else f"{_length(required - here)} short"
        if share is not None:
            hits = int((gap["peak_closing"].sel(stop=name) > here).sum())
            row["hits"] = f"{hits} of {gap.sizes['record']}"
        rows.append(row)
    columns = [
        Column("stop", "stop", left=True),
        Column("gap", "gap", units="1"),
        Column("required", "required", units="1"),
        Column("", "short", left=True),
    ]
    if share is not None:
        columns.append(Column("records with contact", "hits", units="1"))
    yield table_of(rows, columns)
    yield Text()


def _records_facts(gap: xr.Dataset) -> dict[str, Any]:
    """The share of the records that count, and what all of them need; nothing of sines."""
    if "record" not in gap.dims:
        return {}
    if "peak_closing" in gap:
        return {"fractile": json.loads(gap.attrs["parameters"])["fractile"]}
    every = _every(gap)
    return {
        "fractile": json.loads(gap.attrs["parameters"])["fractile"],
        # None where no gap is enough: JSON knows no infinity.
        "common_gap_of_all_records": every if math.isfinite(every) else None,
    }


def _every(gap: xr.Dataset) -> float:
    """The gap with no contact under any record; infinite if one moves the mass beyond limits."""
    return max(float(gap["displacement_max"].max()), -float(gap["displacement_min"].min()))


def _needed(gap: xr.Dataset, records: list[str]) -> str:
    under = f"under {', '.join(records)}" if records else "under the sines"
    need = _length(float(gap["common_gap"]))
    sides = " and ".join(_one_sided(gap))
    return f"Required gap: {need} for no contact {under} ({sides})."


def _one_sided(gap: xr.Dataset) -> list[str]:
    """Return the gap that each side requires, in words."""
    required = plain_values(gap["required_gap"])
    return [f"{_length(one)} to the {side}" for side, one in required.items()]


def _needed_by_share(gap: xr.Dataset, records: list[str], share: float) -> str:
    """With what all records need: under the rest of them something is hit."""
    need, every = _length(float(gap["common_gap"])), _every(gap)
    sides = ", ".join(_one_sided(gap))
    whole = (
        f"{_length(every)} for no contact under all of them"
        if math.isfinite(every)
        else "no gap is sufficient for all of them"
    )
    return (
        f"Required gap: {need}, the {_percent(share)} fractile over {', '.join(records)} (each "
        f"side separately: {sides}); {whole}."
    )


def _limits_facts(data: xr.Dataset) -> dict[str, Any]:
    """The limits, and how many designs keep them; nothing if there are none."""
    if "within_limits" not in data:
        return {}
    limits = json.loads(data.attrs["parameters"])["limits"]
    return {"limits": limits, "designs_within_limits": int(data["within_limits"].sum())}


def _which(data: xr.Dataset, front: int) -> str:
    """How many designs keep the limits, and how many of them no other one beats."""
    best = f"{front} {_be(front)} not dominated by another design in displacement and acceleration"
    limit_facts = _limits_facts(data)
    if not limit_facts:
        return best
    limits = " and ".join(
        f"{_words(name)} {pretty(value, in_units(VARIABLES[name.partition('.')[0]].units))}"
        for name, value in limit_facts["limits"].items()
    )
    count = limit_facts["designs_within_limits"]
    kept = f"{count or 'none'} {_be(count or 1)} within {limits}"
    return f"{kept}, and of these {best}" if count else kept


def _be(count: int) -> str:
    return "is" if count == 1 else "are"


def _enough(rig: System, gap: xr.Dataset) -> str:
    """Whether the gaps of the rig suffice."""
    short = {
        side: required - stop.gap
        for side, required in plain_values(gap["required_gap"]).items()
        if (stop := rig.stop_laws.get(side)) is not None
    }
    lacking = {side: by for side, by in short.items() if by > 0.0}
    if not lacking:
        return f"{_gaps(rig).capitalize()} is sufficient."
    shortfalls = " and ".join(f"{_length(by)} short on the {side}" for side, by in lacking.items())
    return f"{_gaps(rig).capitalize()} is {shortfalls}."


def _enough_for_share(rig: System, gap: xr.Dataset, share: float) -> str:
    """The same of a fractile, and how many records hit nevertheless.

    What counts of a record is the side on which it goes farthest beyond: a gap that is enough for
    the fractile of each side may not be for that of both.
    """
    beyond = np.max(
        [
            reached.values - stop.gap
            for reached, stop in (
                (gap["displacement_max"], rig.stop_laws.get("right")),
                (-gap["displacement_min"], rig.stop_laws.get("left")),
            )
            if stop is not None
        ],
        axis=0,
    )
    short = float(quantiles(beyond, [share], 0)[0])
    words = "sufficient" if short <= 0.0 else f"{_length(short)} short"
    hits = int((beyond > 0.0).sum())
    return (
        f"{_gaps(rig).capitalize()} is {words} for the {_percent(share)} fractile; the mass hits a "
        f"stop under {hits or 'none'} of the {len(beyond)} record{'' if len(beyond) == 1 else 's'}."
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:g} %"


def _gaps(rig: System) -> str:
    gaps = list(dict.fromkeys(pretty(stop.gap, LENGTH) for stop in rig.stop_laws.values()))
    return f"the gap of {' and '.join(gaps)}"


def _table(rows: list[xr.Dataset], names: list[str]) -> RenderableType:
    picked = np.unique(np.linspace(0, len(rows) - 1, min(_ROWS, len(rows))).round().astype(int))
    columns: dict[str, tuple[str, Callable[[float], str]]] = {
        **{name: (_HEADS.get(name, _words(name)), partial(_value, name)) for name in names},
        "peak_displacement": ("displacement", _length),
        "peak_acceleration": ("acceleration", _acceleration),
        "peak_force": ("contact force", partial(written, "peak_force")),
    }
    texts = [
        {name: write(float(over_parts(rows[i][name]))) for name, (_, write) in columns.items()}
        for i in picked
    ]
    return table_of(texts, [Column(head, name, units="1") for name, (head, _) in columns.items()])


def _front(data: xr.Dataset) -> Iterator[xr.Dataset]:
    """The designs that no other one beats, by displacement."""
    dims = [str(dim) for dim in data["pareto"].dims]
    at = np.argwhere(data["pareto"].values)
    u = over_parts(data["peak_displacement"]).values[tuple(at.T)]
    for k in np.argsort(u, kind="stable"):
        yield data.isel(dict(zip(dims, map(int, at[k]), strict=True))).reset_coords()


def _demands(one: xr.Dataset) -> str:
    return (
        f"{_acceleration(float(one['peak_acceleration']))}, with a displacement of "
        f"{_length(float(one['peak_displacement']))} and a contact force of "
        f"{written('peak_force', float(over_stops(one['peak_force'])))}"
    )


def _words(name: str) -> str:
    base, _, part = name.partition(".")
    words = base.replace("_", " ")
    return f"{words} of {part}" if part and base in VARIABLES else name.replace("_", " ")


def _value(name: str, value: float) -> str:
    return pretty(float(f"{value:.4g}"), usual(name).quantity)


def _length(value: float) -> str:
    return written("displacement", value)


def _acceleration(value: float) -> str:
    return plain(value, 4) if unitless() else f"{plain(value / GRAVITY, 4)} g"
