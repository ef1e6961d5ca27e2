"""The resonance curves of both sweep directions, coarse or fine, with jumps and hysteresis."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.explorer.pictures.numbers import axis, forcing, forcings, one, short
from vibroimpact.explorer.state import PageState
from vibroimpact.facts import sweeps as facts_of
from vibroimpact.facts.tables import as_text
from vibroimpact.figures.resonance_panels import Drawn, normalised, physical_curves
from vibroimpact.model.written_units import as_first_argument
from vibroimpact.response import resonance
from vibroimpact.response.analytic_free_response import beside_resonance
from vibroimpact.response.sweep import advice, sweep
from vibroimpact.tasks.threads import Progress

COARSE = 46
"""Number of frequencies while a knob is turned, as in the published tests."""
FINE = 181
"""Number of frequencies of a fine sweep. Every fourth one is a frequency of the coarse sweep."""
AXIS = "frequency (Hz)"
PATIENCE, WINDOW = 300, 100
"""Cycles that a coarse hold waits, and those it is measured over, where it does not settle."""


def swept(state: PageState, fine: bool, progress: Progress | None = None) -> xr.Dataset:
    """Sweep the rig over the frequency range of the page."""
    count = FINE if fine else COARSE
    frequencies = beside_resonance(state.oscillator, np.linspace(*state.span, count))
    few: dict[str, Any] = {} if fine else {"max_cycles": PATIENCE, "window": WINDOW}
    data = sweep(state.rig, frequencies, progress=progress, **few)
    data.attrs["title"] = state.name
    return data


@as_first_argument
def curves(state: PageState, data: xr.Dataset, fine: bool) -> dict[str, Any]:
    """Return the curves of a sweep as two or three panels."""
    features = resonance.features(data)
    panels = physical_curves(data) if state.physical else normalised(data)
    words = as_text(facts_of.text(data, features, advice(data))) if fine else None
    return {
        "picture": "curves",
        "fine": fine,
        "words": words,
        "physical": state.physical,
        "frequency": forcings(data["frequency"].values),
        "axis": axis(AXIS),
        "panels": [_panel(panel) for panel in panels],
        "jumps": [
            {
                "direction": jump.direction,
                "before": forcing(jump.before),
                "after": forcing(jump.after),
                "upward": bool(jump.upward),
            }
            for jump in features.jumps
        ],
        "hysteresis": [
            {"low": forcing(item.low), "high": forcing(item.high), "side": item.side}
            for item in features.hysteresis
        ],
    }


def _panel(drawn: Drawn) -> dict[str, Any]:
    return {
        "name": drawn.name,
        "label": axis(drawn.label).split("\n"),
        "curves": {direction: short(values) for direction, values in drawn.curves.items()},
        "free": None if drawn.free is None else short(drawn.free),
        "levels": [{"value": one(level.value), "label": level.label} for level in drawn.levels],
    }
