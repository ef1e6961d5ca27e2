"""A rig as a node of a map."""

from __future__ import annotations

import vibroimpact as vi
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.map_node import classified
from vibroimpact.scenarios.scenario import Scenario
from vibroimpact.scenarios.thresholds import Thresholds


def in_map(rig: vi.Rig) -> str:
    return Scenario(int(classified([one_sine(rig)], Thresholds(), 0.01, None)["scenario"][0])).label
