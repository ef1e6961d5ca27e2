"""The scenario of a rig, with the evidence for it."""

from __future__ import annotations

from typing import Any

from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.tables import sheet
from vibroimpact.scenarios.classify import Classification
from vibroimpact.scenarios.scenario import Scenario


def meaning(label: str) -> str:
    """Return what a scenario shows, in a few words."""
    return next(one.meaning for one in Scenario if one.label == label)


def facts(verdict: Classification) -> dict[str, Any]:
    """Return the scenario, its evidence, and the thresholds that matter."""
    used = verdict.thresholds
    return {
        "scenario": verdict.scenario,
        "meaning": meaning(verdict.scenario),
        "confidence": verdict.confidence,
        "evidence": verdict.evidence.split("; "),
        "alternatives": [
            {"threshold": name, "value": value, "scenario": other}
            for (name, value), other in verdict.alternatives.items()
        ],
        "thresholds": {name: getattr(used, name) for name in used.names()},
        "features": verdict.features,
    }


def text(verdict: Classification) -> RenderableType:
    """Return the same for reading."""
    lines = sheet(("", line) for line in verdict.evidence.split("; "))
    others = [
        Text(f"  with --{name} {value:g}: {other}")
        for (name, value), other in verdict.alternatives.items()
    ]
    return Group(
        Text(f"{verdict.scenario}: {meaning(verdict.scenario)}", style="bold"),
        lines,
        Text(
            f"Confidence {verdict.confidence:.0%}: this share of the halved and doubled thresholds "
            "gives the same scenario (over the swept frequencies)"
        ),
        *others,
    )
