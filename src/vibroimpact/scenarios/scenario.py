"""The scenarios (the paper's Sections 4.3 and 6)."""

from __future__ import annotations

from enum import IntEnum
from typing import Any


class Scenario(IntEnum):
    """What a pair of resonance curves shows; its value is the number in datasets."""

    S0 = 0
    S1 = 1
    S2 = 2
    S3 = 3
    S4 = 4
    S5 = 5
    S6 = 6
    UNCLASSIFIED = 7

    @property
    def label(self) -> str:
        """``"S4"``, or ``"unclassified"``."""
        return "unclassified" if self is Scenario.UNCLASSIFIED else self.name

    @property
    def meaning(self) -> str:
        """What is seen, in a few words."""
        return _MEANINGS[self]


FLAGS: dict[str, Any] = {
    "flag_values": [int(one) for one in Scenario],
    "flag_meanings": " ".join(one.label for one in Scenario),
}
"""What says in a dataset which number is which scenario."""

_MEANINGS = {
    Scenario.S0: "free flight",
    Scenario.S1: "grazing",
    Scenario.S2: "primary resonance with right hysteresis",
    Scenario.S3: "right hysteresis and a secondary resonance",
    Scenario.S4: "left hysteresis or non-regular resonances",
    Scenario.S5: "bumpers attached, smooth curves",
    Scenario.S6: "curves bent to the right, without jumps",
    Scenario.UNCLASSIFIED: "none of S0 to S6",
}
