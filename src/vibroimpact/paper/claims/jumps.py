"""Section 4.2: where the jumps lie, and how gap, acceleration and bumper move them."""

from __future__ import annotations

from vibroimpact.paper.claim import Finding
from vibroimpact.paper.claims.reading import (
    ALONG_ACCELERATION,
    ALONG_BUMPER,
    ALONG_GAP,
    CODES,
    Sequences,
    backward_less,
    claim,
    jump_trend,
    trend,
)
from vibroimpact.paper.study import PublishedStudy

_FORWARD = (
    "Frequency of the forward sweep's jump along {}: it never falls, and rises by more than the "
    "step of 0.01 Hz in every sequence."
)
_BACKWARD = (
    "As for the forward sweep; and the backward sweep's jump rises by less than the forward one's "
    "in every sequence."
)


def _forward(study: PublishedStudy, sequences: Sequences) -> Finding:
    found = jump_trend(study, sequences, "forward")
    return Finding(found.all_hold, found.told(".2f", " Hz"))


def _backward(study: PublishedStudy, sequences: Sequences) -> Finding:
    forward = jump_trend(study, sequences, "forward")
    backward = jump_trend(study, sequences, "backward")
    return Finding(backward_less(forward, backward), backward.told(".2f", " Hz"))


@claim(
    "downward-jump-with-gap",
    "4.2, Fig. 5",
    "The smaller the gap, the higher the frequency of the downward jump.",
    _FORWARD.format("falling gaps"),
)
def down_gap(study: PublishedStudy) -> Finding:
    """Twelve pairs of bumper and acceleration."""
    return _forward(study, ALONG_GAP)


@claim(
    "upward-jump-with-gap",
    "4.2, Fig. 5",
    "The smaller the gap, the higher the frequency of the upward jump, which moves less.",
    _BACKWARD,
)
def up_gap(study: PublishedStudy) -> Finding:
    """Twelve pairs of bumper and acceleration."""
    return _backward(study, ALONG_GAP)


@claim(
    "downward-jump-with-acceleration",
    "4.2, Fig. 5",
    "The larger the acceleration, the higher the frequency of the downward jump.",
    _FORWARD.format("rising accelerations"),
)
def down_acceleration(study: PublishedStudy) -> Finding:
    """Sixteen pairs of bumper and gap."""
    return _forward(study, ALONG_ACCELERATION)


@claim(
    "upward-jump-with-acceleration",
    "4.2, Fig. 5",
    "The larger the acceleration, the higher the frequency of the upward jump, which moves less.",
    _BACKWARD,
)
def up_acceleration(study: PublishedStudy) -> Finding:
    """Sixteen pairs of bumper and gap."""
    return _backward(study, ALONG_ACCELERATION)


@claim(
    "downward-jump-with-bumper",
    "4.2, Fig. 5",
    "The stiffer the bumper, the higher the frequency of the downward jump.",
    _FORWARD.format("stiffer bumpers"),
)
def down_bumper(study: PublishedStudy) -> Finding:
    """Twelve pairs of gap and acceleration."""
    return _forward(study, ALONG_BUMPER)


@claim(
    "upward-jump-with-bumper",
    "4.2, Fig. 5",
    "The stiffer the bumper, the higher the frequency of the upward jump, which moves less.",
    _BACKWARD,
)
def up_bumper(study: PublishedStudy) -> Finding:
    """In the model it lies where free flight reaches the gap, whatever the bumper."""
    return _backward(study, ALONG_BUMPER)


def _rises(study: PublishedStudy) -> dict[str, tuple[float, float]]:
    """Rise of η_a and η_d at the backward sweep's upward jump, by test."""
    found = {}
    for code in CODES:
        up = [
            j
            for j in study.features(code).jumps
            if j.direction == "backward" and j.upward and j.settled
        ]
        if up:
            top = max(up, key=lambda one: one.frequency)
            found[code] = (top.eta_a[1] - top.eta_a[0], top.eta_d[1] - top.eta_d[0])
    return found


@claim(
    "upward-jump-less-evident",
    "4.2, Fig. 6",
    "The upward jump is less evident in the displacement than in the acceleration.",
    "Rise of η_d and of η_a at the upward jump: smaller in all tests that have one.",
)
def less_evident(study: PublishedStudy) -> Finding:
    """Compared test by test."""
    rises = _rises(study)
    less = [code for code, (a, d) in rises.items() if abs(d) < abs(a)]
    most = max((abs(d) / abs(a) for a, d in rises.values()), default=float("nan"))
    return Finding(
        bool(rises) and len(less) == len(rises),
        f"in {len(less)} of {len(rises)} tests with an upward jump; at most {most:.2f} of η_a's",
    )


@claim(
    "upward-jump-fades",
    "4.2, Fig. 6",
    "In the displacement the upward jump fades as the gap grows and as the acceleration falls.",
    "Rise of η_d at the upward jump along falling gaps and along rising accelerations: grows in "
    "every sequence.",
)
def fades(study: PublishedStudy) -> Finding:
    """By the same rule as all other trends."""
    rises = {code: d for code, (_, d) in _rises(study).items()}
    gap, acceleration = (
        trend(sequences, rises.get, 1) for sequences in (ALONG_GAP, ALONG_ACCELERATION)
    )
    return Finding(
        gap.all_hold and acceleration.all_hold,
        f"along the gap {gap.told('.3f')}; along the acceleration {acceleration.told('.3f')}",
    )


CLAIMS = (
    down_gap,
    up_gap,
    down_acceleration,
    up_acceleration,
    down_bumper,
    up_bumper,
    less_evident,
    fades,
)
