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


def facts(found: Classification) -> dict[str, Any]:
    """Return the scenario, its evidence, and the thresholds that matter."""
    used = found.thresholds
    return {
        "scenario": found.scenario,
        "meaning": meaning(found.scenario),
        "confidence": found.confidence,
        "evidence": found.evidence.split("; "),
        "alternatives": [
            {"threshold": name, "value": value, "scenario": other}
            for (name, value), other in found.alternatives.items()
        ],
        "thresholds": {name: getattr(used, name) for name in used.names()},
        "features": found.features,
    }


def text(found: Classification) -> RenderableType:
    """Return the same for reading."""
    lines = sheet(("", line) for line in found.evidence.split("; "))
    others = [
        Text(f"  with --{name} {value:g}: {other}")
        for (name, value), other in found.alternatives.items()
    ]
    return Group(
        Text(f"{found.scenario}: {meaning(found.scenario)}", style="bold"),
        lines,
        Text(
            f"Confidence {found.confidence:.0%}: this share of the halved and doubled thresholds "
            "gives the same scenario (over the swept frequencies)"
        ),
        *others,
    )
