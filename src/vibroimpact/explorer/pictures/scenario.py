"""The scenario, with its evidence in words."""

from __future__ import annotations

from typing import Any

import xarray as xr

from vibroimpact.explorer.pictures.numbers import one
from vibroimpact.explorer.state import PageState
from vibroimpact.facts import scenario as facts_of
from vibroimpact.model.rig import Rig
from vibroimpact.model.written_units import as_first_argument
from vibroimpact.scenarios.classification import scenario
from vibroimpact.scenarios.classify import classify
from vibroimpact.scenarios.evidence import evidence
from vibroimpact.scenarios.evidence_text import in_words
from vibroimpact.scenarios.thresholds import Thresholds
from vibroimpact.tasks.threads import Progress


@as_first_argument
def quick(state: PageState, data: xr.Dataset) -> dict[str, Any]:
    """Return the scenario of a coarse sweep, while a knob is turned."""
    used = Thresholds()
    sweep_evidence = evidence(Rig(state.oscillator, state.shaking), data, 0.5 * used.prominence)
    label = scenario(sweep_evidence, used).label
    return {
        "picture": "scenario",
        "fine": False,
        "scenario": label,
        "meaning": facts_of.meaning(label),
        "confidence": None,
        "evidence": in_words(sweep_evidence, used).split("; "),
    }


@as_first_argument
def careful(state: PageState, progress: Progress) -> dict[str, Any]:
    """Return the result of `vibroimpact.classify_scenario`, which selects its own frequencies."""
    summary = facts_of.facts(classify(state.rig, progress=progress))
    return {
        "picture": "scenario",
        "fine": True,
        "scenario": summary["scenario"],
        "meaning": summary["meaning"],
        "confidence": one(summary["confidence"]),
        "evidence": summary["evidence"],
    }
