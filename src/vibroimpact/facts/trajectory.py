"""A simulated motion: where it ended, and how often it touched the stops."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.description import motion_parameters
from vibroimpact.datasets.stops import SIDES
from vibroimpact.facts.number_format import plain
from vibroimpact.facts.status import status_facts
from vibroimpact.facts.tables import plain_table
from vibroimpact.model import RigidStop
from vibroimpact.model.quantities import LENGTH, VELOCITY
from vibroimpact.model.units import pretty
from vibroimpact.model.written_units import unit

_LAST_CYCLES = 10.0
"""Cycles at the end over which contacts are counted."""


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return the last state, and contacts per cycle over the last cycles, in SI units."""
    if "cycle" not in data:
        return _record_facts(data)
    last = float(data["cycle"].values[-1])
    lately = min(_LAST_CYCLES, last)
    frequency = json.loads(data.attrs["parameters"])["frequency"]
    when = data["event_cycle"] + data["event_cycle_time"] * frequency
    begins = (data["event_contact"] >= 1) & (when > last - lately)
    return {
        "frequency": frequency,
        "cycles": last,
        "time": float(data["time"].values[-1]),
        "final_state": _final(data),
        "contacts": {
            "over_cycles": lately,
            "per_cycle": {
                stop: count / lately for stop, count in _counts(data, begins.values).items()
            },
        },
        **status_facts(data),
    }


def _final(data: xr.Dataset) -> dict[str, float]:
    """The state at the end, by component."""
    values = zip(data["component"].values, data["final_state"].values.tolist(), strict=True)
    return {str(component): value + 0.0 for component, value in values}  # no negative zeros


def _record_facts(data: xr.Dataset) -> dict[str, Any]:
    """The same of a motion through a record, which has no cycles."""
    begins = data["event_contact"] >= 1
    return {
        "time": float(data["time"].values[-1]),
        "final_state": _final(data),
        "contacts": _counts(data, begins.values),
        **status_facts(data),
    }


def _counts(data: xr.Dataset, begins: NDArray[np.bool_]) -> dict[str, int]:
    """How many of the events are at each stop."""
    of = data["event_stop"].values[begins]
    return {stop: int((of == stop).sum()) for stop in data["stop"].values.tolist()}


def _deformable(data: xr.Dataset) -> list[str]:
    """Return the sides with a stop that has a deformation: rigid stops have none."""
    oscillator = motion_parameters(data)["oscillator"]
    stops = {side: oscillator[side] for side in ("right", "left")}
    return [side for side, stop in stops.items() if stop and stop.get("kind") != RigidStop.kind]


def text(data: xr.Dataset) -> RenderableType:
    """Return the same as lines."""
    found = facts(data)
    state, contacts = found["final_state"], found["contacts"]
    touching = {1: "right stop", -1: "left stop", 0: "none", 2: "both stops"}[int(state["contact"])]
    table = plain_table()
    rows = [
        ("displacement", pretty(state["displacement"], LENGTH)),
        ("velocity", pretty(state["velocity"], VELOCITY)),
        *(
            (f"{side} bumper", f"deformed by {pretty(abs(state[f'deformation.{side}']), LENGTH)}")
            for side in _deformable(data)
        ),
        ("contact", touching),
    ]
    if "cycles" in found:
        rows.insert(-1, ("phase", f"{plain(state['phase'], 6)} rad"))
    for row in rows:
        table.add_row(*row, "")
    if "cycles" not in found:
        return Group(
            Text(f"State after {plain(found['time'], 6)}{unit(' s')}"),
            table,
            Text(f"Contacts: {_both(contacts)}"),
        )
    return Group(
        Text(
            f"State after {plain(found['cycles'])} cycles ({plain(found['time'], 6)}{unit(' s')})"
        ),
        table,
        Text(
            f"Contacts per cycle, over the last {plain(contacts['over_cycles'])}: "
            f"{_both(contacts['per_cycle'])}"
        ),
    )


def _both(counts: dict[str, Any]) -> str:
    """Return counts by stop in words."""
    return ", ".join(f"{plain(counts.get(side, 0))} {side}" for side in SIDES)
