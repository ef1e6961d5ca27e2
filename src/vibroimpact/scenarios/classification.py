"""From the evidence to the scenario (the paper's Sections 4.3 and 6)."""

from __future__ import annotations

import math

from vibroimpact.scenarios.evidence import Evidence
from vibroimpact.scenarios.scenario import Scenario
from vibroimpact.scenarios.thresholds import Thresholds


def scenario(evidence: Evidence, thresholds: Thresholds) -> Scenario:
    """Name the scenario; the first that fits, in this order.

    0. Unclassified if too little is known, or if the growth of η_a with the frequency hides the
       resonance; if the resonance lies beyond the frequencies swept, only S4 can be recognised.
    1. S0: no bumper is hit.
    2. S5: the bumpers touch the mass at rest, and the curves are smooth.
    3. S1: the gap is nearly free flight's amplitude, and the bumpers are hardly deformed.
    4. S4: left hystereses and non-regular resonances, below the primary one and beyond the
       onset of contact, cover some width.
    5. S2 or S3: right hysteresis, without or with a secondary resonance.
    6. S6: neither jumps nor secondary resonances, and the resonance has moved upwards.
    7. Otherwise unclassified; so, too, where the primary resonance itself is not regular.
    """
    secondary = [
        peak for peak in evidence.secondary if peak.prominence >= thresholds.prominence * peak.value
    ]
    extent = evidence.extent(thresholds.prominence)
    smooth = not (evidence.jumping or extent or secondary) and evidence.primary_regular
    if math.isinf(evidence.gap_ratio):  # there is no bumper
        return Scenario.S0
    if not evidence.known or evidence.hidden_by is not None:
        return Scenario.UNCLASSIFIED
    if not evidence.within:
        return Scenario.S4 if extent >= thresholds.extent else Scenario.UNCLASSIFIED
    if evidence.contact is None:
        return Scenario.S0
    if evidence.attached:
        if smooth:
            return Scenario.S5
    elif (
        1.0 - evidence.gap_ratio <= thresholds.touch
        and evidence.penetration <= thresholds.deformation
    ):
        return Scenario.S1
    if extent >= thresholds.extent:
        return Scenario.S4
    if not evidence.primary_regular:
        return Scenario.UNCLASSIFIED
    if primary_jumps(evidence):
        return Scenario.S3 if secondary else Scenario.S2
    if smooth and evidence.resonance >= 1.0 and not evidence.attached:
        return Scenario.S6
    return Scenario.UNCLASSIFIED


def primary_jumps(evidence: Evidence) -> bool:
    """Whether the primary resonance ends in a jump: right hysteresis, however narrow.

    One that hides between two neighbouring frequencies shows in the branch, which turns back
    above the resonance; where no branch was followed, as a jump of both directions at one place.
    """
    if evidence.right:
        return True
    if evidence.folds is not None:
        return any(fold > evidence.top for fold in evidence.folds)
    down = {
        jump.direction
        for jump in evidence.jumps
        if jump.settled
        and jump.frequency >= evidence.top
        and (jump.direction == "forward") == (not jump.upward)
    }
    return len(down) == 2


def alternatives(evidence: Evidence, thresholds: Thresholds) -> dict[tuple[str, float], Scenario]:
    """The variations of the thresholds that give another scenario, by threshold and its value."""
    named = scenario(evidence, thresholds)
    return {
        (name, getattr(other, name)): there
        for name, other in thresholds.variations()
        if (there := scenario(evidence, other)) is not named
    }


def confidence(evidence: Evidence, thresholds: Thresholds) -> float:
    """Share of the threshold's variations (each halved, each doubled) with the same scenario.

    1 means that no threshold matters by a factor of two; it says nothing of what lies outside
    the frequencies that were swept.
    """
    return 1.0 - len(alternatives(evidence, thresholds)) / len(list(thresholds.variations()))
