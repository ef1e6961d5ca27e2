"""A simulated motion: where it ended, and how often it touched the stops."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.description import motion_parameters, status_facts
from vibroimpact.facts.number_format import written
from vibroimpact.facts.tables import sheet
from vibroimpact.model import Oscillator
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.units import plain
from vibroimpact.model.written_units import unit

_LAST_CYCLES = 10.0
"""Cycles at the end over which contacts are counted."""


def facts(data: xr.Dataset) -> dict[str, Any]:
    """Return the last state, and the contacts, in SI units.

    Contacts are those per cycle over the last cycles. A record has no cycles: all are counted.
    """
    begins = (data["event_contact"] >= 1).values
    components = zip(data["component"].values, data["final_state"].values.tolist(), strict=True)
    summary: dict[str, Any] = {
        "time": float(data["time"].values[-1]),
        "final_state": {str(name): value + 0.0 for name, value in components},  # no negative zeros
        "contacts": _counts(data, begins),
        **status_facts(data),
    }
    if "cycle" not in data:
        return summary
    last = float(data["cycle"].values[-1])
    lately = min(_LAST_CYCLES, last)
    frequency = motion_parameters(data)["frequency"]
    when = data["event_cycle"].values + data["event_cycle_time"].values * frequency
    counts = _counts(data, begins & (when > last - lately))
    per_cycle = {stop: count / lately for stop, count in counts.items()}
    contacts = {"over_cycles": lately, "per_cycle": per_cycle}
    return {"frequency": frequency, "cycles": last, **summary, "contacts": contacts}


def _counts(data: xr.Dataset, begins: NDArray[np.bool_]) -> dict[str, int]:
    """How many of the events are at each stop."""
    of = data["event_stop"].values[begins]
    return {stop: int((of == stop).sum()) for stop in data["stop"].values.tolist()}


def _deformable(data: xr.Dataset) -> list[str]:
    """Return the sides with a stop that has a deformation: rigid stops have none."""
    oscillator = Oscillator.model_validate(motion_parameters(data)["oscillator"])
    stops = {side: getattr(oscillator, side) for side in SIDES}
    return [side for side, stop in stops.items() if stop is not None and not stop.rigid]


def text(data: xr.Dataset) -> RenderableType:
    """Return the same as lines."""
    summary = facts(data)
    state, contacts = summary["final_state"], summary["contacts"]
    touched = [f"{side} stop" for side in SIDES if state[f"touching.{side}"]]
    touching = "both stops" if len(touched) == 2 else "".join(touched) or "none"
    rows = [
        *((name, written(name, state[name], digits=6)) for name in ("displacement", "velocity")),
        *(
            (f"{side} bumper", f"deformed by {_depth(state[f'deformation.{side}'])}")
            for side in _deformable(data)
        ),
    ]
    span = f"{plain(summary['time'], 6)}{unit(' s')}"
    over = ""
    if "cycles" in summary:
        rows.append(("phase", f"{plain(state['phase'], 6)} rad"))
        span = f"{plain(summary['cycles'])} cycles ({span})"
        over = f" per cycle, over the last {plain(contacts['over_cycles'])}"
        contacts = contacts["per_cycle"]
    counts = ", ".join(f"{plain(contacts.get(side, 0))} {side}" for side in SIDES)
    return Group(
        Text(f"State after {span}"),
        sheet([*rows, ("contact", touching)]),
        Text(f"Contacts{over}: {counts}"),
    )


def _depth(deformation: float) -> str:
    return written("deformation", abs(deformation), digits=6)
