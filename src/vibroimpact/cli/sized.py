"""What a design asks for and what it gives, for people and for programs."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.cli.numbers import plain
from vibroimpact.model import GRAVITY, Oscillator
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.model.quantities import FORCE, LENGTH
from vibroimpact.model.units import pretty
from vibroimpact.response.vocabulary import VARIABLES
from vibroimpact.sizing.limits import QUANTITIES

_HEADS = {"stiffness_at_restitution": "bumper stiffness"}
_ROWS = 8
"""Designs of the front that are told, at most."""


def facts(gap: xr.Dataset, data: xr.Dataset, least: xr.Dataset | None) -> dict[str, Any]:
    """Every number, in SI units."""
    names = ("required_gap", "required_gap_right", "required_gap_left")
    return {
        **{name: float(gap[name]) for name in names},
        "designs": int(data["pareto"].size),
        **_limits_facts(data),
        "front": [{str(name): _item(value) for name, value in one.items()} for one in _front(data)],
        "best": None
        if least is None
        else {str(name): value.item() for name, value in least.data_vars.items()},
    }


def text(
    rig: Oscillator,
    gap: xr.Dataset,
    data: xr.Dataset,
    least: xr.Dataset | None,
    records: list[str],
) -> Iterator[RenderableType]:
    """Sentences, and a table of what no other design beats."""
    under = f"under {', '.join(records)}" if records else "under the sines"
    need = float(gap["required_gap"])
    yield Text()
    sides = " and ".join(
        f"{_length(float(gap[f'required_gap_{side}']))} to the {side}" for side in ("right", "left")
    )
    yield Text(f"Required gap: {_length(need)} to hit nothing {under} ({sides}).")
    if rig.stops:
        yield Text(_enough(rig, gap))
    rows = list(_front(data))
    dims = [str(dim) for dim in data["pareto"].dims]
    size = " × ".join(str(n) for n in data["pareto"].shape)
    over = " and ".join(_words(dim) for dim in dims)
    yield Text(f"Designs: {size}, over {over}; {_which(data, len(rows))}.")
    dampings = data["bumper_damping"].values if "bumper_damping" in data.data_vars else np.zeros(1)
    beside = ["bumper_damping"] if np.ptp(dampings) > 0.0 else []
    if not beside and dampings.any():
        yield Text(
            f"All keep the bumpers' damping of {_value('bumper_damping', dampings.flat[0])}; "
            "--vary stiffness-at-restitution keeps their restitution instead."
        )
    if rows:
        yield _table(rows, [*dims, *beside])
    if least is not None:
        chosen = ", ".join(
            f"{_words(name)} {_value(name, float(least[name]))}"
            for name in map(str, least.data_vars)
            if name in PARAMETERS
        )
        yield Text()
        yield Text(f"Least acceleration for {_gaps(rig)}: {chosen}: {_demands(least)}.")


def _limits_facts(data: xr.Dataset) -> dict[str, Any]:
    """The limits, and how many designs keep them; nothing if there are none."""
    if "within_limits" not in data:
        return {}
    limits = json.loads(data.attrs["parameters"])["limits"]
    return {"limits": limits, "designs_within_limits": int(data["within_limits"].sum())}


def _which(data: xr.Dataset, front: int) -> str:
    """How many designs keep the limits, and how many of them no other one beats."""
    best = f"{front} {_be(front)} beaten by no other in both displacement and acceleration"
    told = _limits_facts(data)
    if not told:
        return best
    limits = " and ".join(
        f"{_words(name)} {pretty(value, QUANTITIES[VARIABLES[name].units])}"
        for name, value in told["limits"].items()
    )
    count = told["designs_within_limits"]
    kept = f"{count or 'none'} {_be(count or 1)} within {limits}"
    return f"{kept}, and of these {best}" if count else kept


def _be(count: int) -> str:
    return "is" if count == 1 else "are"


def _enough(rig: Oscillator, gap: xr.Dataset) -> str:
    """Whether the gaps of the rig suffice."""
    short = {
        side: float(gap[f"required_gap_{side}"]) - stop.gap
        for side, stop in (("right", rig.right), ("left", rig.left))
        if stop is not None
    }
    lacking = {side: by for side, by in short.items() if by > 0.0}
    if not lacking:
        return f"{_gaps(rig).capitalize()} is enough."
    told = " and ".join(f"{_length(by)} short on the {side}" for side, by in lacking.items())
    return f"{_gaps(rig).capitalize()} is {told}."


def _gaps(rig: Oscillator) -> str:
    gaps = list(dict.fromkeys(pretty(stop.gap, LENGTH) for stop in rig.stops))
    return f"the gap of {' and '.join(gaps)}"


def _table(rows: list[xr.Dataset], names: list[str]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2), header_style="")
    heads = [_HEADS.get(name, _words(name)) for name in names]
    for head in (*heads, "displacement", "acceleration", "contact force"):
        table.add_column(head, justify="right")
    picked = np.unique(np.linspace(0, len(rows) - 1, min(_ROWS, len(rows))).round().astype(int))
    for i in picked:
        one = rows[i]
        table.add_row(
            *(_value(name, float(one[name])) for name in names),
            _length(float(one["peak_displacement"])),
            f"{plain(float(one['peak_acceleration']) / GRAVITY, 4)} g",
            _force(float(one["peak_force"])),
        )
    return table


def _front(data: xr.Dataset) -> Iterator[xr.Dataset]:
    """The designs that no other one beats, by displacement."""
    dims = [str(dim) for dim in data["pareto"].dims]
    at = np.argwhere(data["pareto"].values)
    u = data["peak_displacement"].values[tuple(at.T)]
    for k in np.argsort(u, kind="stable"):
        yield data.isel(dict(zip(dims, map(int, at[k]), strict=True))).reset_coords()


def _demands(one: xr.Dataset) -> str:
    size = float(one["peak_acceleration"])
    return (
        f"{plain(size / GRAVITY, 4)} g, with a displacement of "
        f"{_length(float(one['peak_displacement']))} and a contact force of "
        f"{_force(float(one['peak_force']))}"
    )


def _words(name: str) -> str:
    return name.replace("_", " ")


def _value(name: str, value: float) -> str:
    return pretty(float(f"{value:.4g}"), PARAMETERS[name].quantity)


def _length(value: float) -> str:
    return pretty(float(f"{value:.4g}"), LENGTH)


def _force(value: float) -> str:
    return pretty(float(f"{value:.4g}"), FORCE)


def _item(value: Any) -> Any:
    return value.item()
