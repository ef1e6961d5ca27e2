"""Section 4.2: the heights of the resonances, and the effects of gap, acceleration and bumper."""

from __future__ import annotations

import numpy as np

from paper.claim import Finding
from paper.claims.reading import (
    ALONG_ACCELERATION,
    ALONG_BUMPER,
    ALONG_GAP,
    BOTH,
    FALLING_GAPS,
    Sequences,
    backward_less,
    claim,
    listed,
    peak,
    peak_trend,
    trend,
)
from paper.study import PublishedStudy
from vibroimpact.response.curve_pair import Direction


def _maxima(study: PublishedStudy, pair: str, direction: Direction) -> list[float]:
    bumper, acceleration = pair.split("-")
    codes = [f"{bumper}-{gap}-{acceleration}" for gap in FALLING_GAPS]
    return [peak(study, code, "eta_a", direction).value for code in codes]


def _less(forward: list[float], backward: list[float]) -> bool:
    """Return whether the maxima of the backward sweep have the smaller range."""
    return bool(np.ptp(backward) < np.ptp(forward))


def _describe(forward: list[float], backward: list[float]) -> str:
    return f"G4 to G1: forward {listed(forward, '.3f')}; backward {listed(backward, '.3f')}"


@claim(
    "bell-in-the-middle",
    "4.2, Fig. 5",
    "In B2-A3, the maxima of η_a first rise and then fall as the gap falls from G4 to G1 (a bell). "
    "The maxima of the backward sweep do so to a lesser extent.",
    "In each direction, the largest of the four maxima of η_a must be at G2 or G3. The backward "
    "maxima must have the smaller range.",
)
def bell(study: PublishedStudy) -> Finding:
    """Check the maxima of both sweep directions."""
    both = [_maxima(study, "B2-A3", way) for way in BOTH]
    holds = all(int(np.argmax(values)) in (1, 2) for values in both)
    return Finding(holds and _less(*both), _describe(*both))


@claim(
    "bell-ascending",
    "4.2, Fig. 5",
    "In B1-A1 (the softest bumper and the smallest acceleration), only the rising side of the bell "
    "appears as the gap falls. The maxima of the backward sweep show it to a lesser extent.",
    "In both directions, the maximum of η_a must rise with each step to a smaller gap. The "
    "backward maxima must have the smaller range.",
)
def ascending(study: PublishedStudy) -> Finding:
    """Check the maxima of both sweep directions."""
    both = [_maxima(study, "B1-A1", way) for way in BOTH]
    holds = all((np.diff(values) > 0).all() for values in both)
    return Finding(holds and _less(*both), _describe(*both))


@claim(
    "bell-descending",
    "4.2, Fig. 5",
    "In B4-A3 (the stiffest bumper and the largest acceleration), only the falling side of the "
    "bell appears as the gap falls. The maxima of the backward sweep show it to a lesser extent.",
    "In both directions, the maximum of η_a must fall with each step to a smaller gap. The "
    "backward maxima must have the smaller range.",
)
def descending(study: PublishedStudy) -> Finding:
    """Check the maxima of both sweep directions."""
    both = [_maxima(study, "B4-A3", way) for way in BOTH]
    holds = all((np.diff(values) < 0).all() for values in both)
    return Finding(holds and _less(*both), _describe(*both))


def _rise(study: PublishedStudy, sequences: Sequences, direction: Direction) -> Finding:
    rise = peak_trend(study, sequences, "eta_a", direction, 1)
    return Finding(rise.all_hold, rise.describe(".2f"))


@claim(
    "acceleration-with-acceleration-forward",
    "4.2, Fig. 5",
    "The larger the table acceleration, the higher the resonance peak of the forward sweep in η_a.",
    "The forward resonance peak must become higher from A1 to A3, in all 16 pairs of bumper and "
    "gap.",
)
def with_acceleration(study: PublishedStudy) -> Finding:
    """Check the forward sweep."""
    return _rise(study, ALONG_ACCELERATION, "forward")


@claim(
    "acceleration-with-acceleration-backward",
    "4.2, Fig. 5",
    "The larger the table acceleration, the higher the resonance peak of the backward sweep in "
    "η_a. The backward peak changes less than the forward peak.",
    "The backward resonance peak must become higher from A1 to A3, in all 16 pairs of bumper and "
    "gap, and by less than the forward peak.",
)
def with_acceleration_backward(study: PublishedStudy) -> Finding:
    """Check the backward sweep."""
    forward, backward = (peak_trend(study, ALONG_ACCELERATION, "eta_a", way, 1) for way in BOTH)
    example = listed(backward.values["B2-G1"], ".3f")
    return Finding(
        backward_less(forward, backward), f"{backward.describe('.2f')}; B2-G1: {example} (A1 to A3)"
    )


@claim(
    "acceleration-with-bumper-forward",
    "4.2, Fig. 5",
    "The stiffer the bumper, the higher the resonance peak of the forward sweep in η_a.",
    "The forward resonance peak must become higher from B1 to B4, in all 12 pairs of gap and "
    "acceleration.",
)
def with_bumper(study: PublishedStudy) -> Finding:
    """Check the forward sweep."""
    return _rise(study, ALONG_BUMPER, "forward")


@claim(
    "acceleration-with-bumper-backward",
    "4.2, Fig. 5",
    "The stiffer the bumper, the higher the resonance peak of the backward sweep in η_a.",
    "The backward resonance peak must become higher from B1 to B4, in all 12 pairs of gap and "
    "acceleration.",
)
def with_bumper_backward(study: PublishedStudy) -> Finding:
    """Check the backward sweep."""
    return _rise(study, ALONG_BUMPER, "backward")


def _fall(study: PublishedStudy, sequences: Sequences) -> Finding:
    both = [peak_trend(study, sequences, "eta_d", way, -1) for way in BOTH]
    return Finding(
        all(one.all_hold for one in both),
        f"forward: {both[0].describe('.2f')}; backward: {both[1].describe('.2f')}",
    )


@claim(
    "displacement-with-gap",
    "4.2, Fig. 6",
    "The smaller the gap, the lower the resonance peaks in η_d, in both directions.",
    "The resonance peak must become lower from G4 to G1, in all 12 pairs of bumper and "
    "acceleration.",
)
def displacement_gap(study: PublishedStudy) -> Finding:
    """Check both sweep directions."""
    return _fall(study, ALONG_GAP)


@claim(
    "displacement-with-acceleration",
    "4.2, Fig. 6",
    "The larger the table acceleration, the lower the resonance peaks in η_d, in both directions.",
    "The resonance peak must become lower from A1 to A3, in all 16 pairs of bumper and gap.",
)
def displacement_acceleration(study: PublishedStudy) -> Finding:
    """Check both sweep directions."""
    return _fall(study, ALONG_ACCELERATION)


@claim(
    "displacement-with-bumper",
    "4.2, Fig. 6",
    "The stiffer the bumper, the lower the resonance peaks in η_d, in both directions.",
    "The resonance peak must become lower from B1 to B4, in all 12 pairs of gap and acceleration.",
)
def displacement_bumper(study: PublishedStudy) -> Finding:
    """Check both sweep directions."""
    return _fall(study, ALONG_BUMPER)


@claim(
    "directions-closer-with-bumper",
    "4.2, Fig. 6",
    "The stiffer the bumper, the smaller the difference between the forward and backward resonance "
    "peaks in η_d.",
    "The difference of the two heights must fall from B1 to B4, in all 12 pairs of gap and "
    "acceleration.",
)
def directions_closer(study: PublishedStudy) -> Finding:
    """Compare the directions. With B1 and a small acceleration the hysteresis is too short."""

    def difference(code: str) -> float:
        forward, backward = (peak(study, code, "eta_d", way).value for way in BOTH)
        return forward - backward

    fall = trend(ALONG_BUMPER, difference, -1)
    stiff = trend({name: codes[1:] for name, codes in ALONG_BUMPER.items()}, difference, -1)
    example = listed(fall.values["G1-A3"], ".3f")
    return Finding(
        fall.all_hold,
        f"{fall.describe('.3f')}; G1-A3: {example} (B1 to B4); from B2 to B4 it falls in "
        f"{stiff.held} sequences",
    )


CLAIMS = (
    bell,
    ascending,
    descending,
    with_acceleration,
    with_acceleration_backward,
    with_bumper,
    with_bumper_backward,
    displacement_gap,
    displacement_acceleration,
    displacement_bumper,
    directions_closer,
)
