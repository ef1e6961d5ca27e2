"""The evidence for a scenario in words."""

from __future__ import annotations

import math

from vibroimpact.model.frequency_text import forcing, forcings
from vibroimpact.response.resonance import Hysteresis
from vibroimpact.scenarios.evidence import Evidence
from vibroimpact.scenarios.thresholds import Thresholds

_REMEDIES = {
    "displacement": "end the frequencies lower",
    "unbalance": "classify the rig over a base with the displacement m e/M, under which the mass "
    "moves alike relative to the base",
}
"""What to do if the growth of η_a hides the primary resonance, by the kind of amplitude."""


def in_words(evidence: Evidence, thresholds: Thresholds) -> str:
    """Describe the curves, beginning with the features that determine the scenario."""
    if evidence.contact is None:
        room = (
            "there is no bumper"
            if math.isinf(evidence.gap_ratio)
            else f"the gap is {evidence.gap_ratio:.3g} times the amplitude of free flight"
        )
        return f"no contact from {_span(*evidence.swept)}; {room}"
    parts = []
    if evidence.attached:
        parts.append("bumpers attached to the mass at rest")
    elif evidence.gap_ratio >= 1.0 - thresholds.touch:
        parts.append(
            f"the gap is {evidence.gap_ratio:.3g} times the amplitude of free flight, and the mass "
            f"penetrates by {evidence.penetration:.2g} of the gap"
        )
    sides = [("right", item) for item in evidence.right] + [
        ("left", item) for item in evidence.left
    ]
    narrow = evidence.extent(thresholds.prominence) < thresholds.extent
    parts += [
        f"{side} hysteresis {_span(*_ends(evidence, item))}"
        + (" (too narrow for S4)" if side == "left" and narrow else "")
        for side, item in sides
    ]
    if not evidence.right and (hidden := _hidden(evidence)):
        parts.append(f"right hysteresis {hidden}, between two frequencies of the sweep")
    parts += _irregular(evidence, thresholds)
    parts += [
        f"secondary resonance at {forcing(frequency, 3)} (prominence {share:.0%})"
        for frequency, share in evidence.secondary_resonances(thresholds.prominence)
    ]
    parts += [f"non-regular motion where contact begins, {_span(*span)}" for span in evidence.onset]
    if not evidence.jumping:
        parts.append("no jumps")
    if math.isfinite(evidence.resonance):
        parts.append(f"resonance at {evidence.resonance:.3g} times that of free flight")
    if evidence.hidden_by is not None:
        parts.append(
            "undecided: η_a grows with the frequency without contact, which hides the primary "
            f"resonance; {_REMEDIES[evidence.hidden_by]}"
        )
    elif evidence.primary_beyond:
        parts.append("the primary resonance lies outside the frequency range of the sweep")
    elif not evidence.within:
        parts.append("the resonance of free flight lies outside the frequency range of the sweep")
    if not evidence.known:
        parts.append("at most frequencies, the motion has not settled or has no value")
    parts.append(f"contact {_span(*evidence.contact)}")
    return "; ".join(parts)


def _irregular(evidence: Evidence, thresholds: Thresholds) -> list[str]:
    """Ranges that are not regular, where overlapping ranges of both directions are merged."""
    lines = []
    for item in evidence.irregular_once:
        kinds = " and ".join(item.kinds)
        what = (
            f"{kinds} resonance" if item.prominence >= thresholds.prominence else f"{kinds} motions"
        )
        lines.append(f"{what} {_span(item.low, item.high)}")
    return lines


def _ends(evidence: Evidence, item: Hysteresis) -> tuple[float, float]:
    """Ends of a hysteresis: turning points of the branch between its last two frequencies."""
    low, high = item.ends
    below = item.low if item.below is None else item.below
    above = item.high if item.above is None else item.above
    folds = evidence.folds or ()
    low = next((f for f in folds if below <= f <= item.low), low)
    high = next((f for f in folds if item.high <= f <= above), high)
    return low, high


def _hidden(evidence: Evidence) -> str:
    above = [fold for fold in evidence.folds or () if fold > evidence.top]
    return _span(min(above), max(above)) if above else ""


def _span(low: float, high: float) -> str:
    """A range of frequencies, with as many digits as distinguish its ends."""
    digits = 3
    while digits < 8 and low != high and f"{low:.{digits}g}" == f"{high:.{digits}g}":
        digits += 1
    return forcings(low, high, digits, to="–")
