"""A rig as a node of a map."""

from __future__ import annotations

import vibroimpact as vi
from vibroimpact.scenario.axes import one_sine
from vibroimpact.scenario.cell import classified
from vibroimpact.scenario.kinds import Scenario
from vibroimpact.scenario.thresholds import Thresholds


def in_map(rig: vi.Rig) -> str:
    return Scenario(
        int(classified([one_sine(*rig, "rig")], Thresholds(), 0.01, None)["scenario"][0])
    ).label
