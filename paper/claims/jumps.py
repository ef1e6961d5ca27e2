"""Section 4.2: the frequencies of the jumps, and the effects of gap, acceleration and bumper."""

from __future__ import annotations

from functools import partial

from paper.claim import Finding
from paper.claims.reading import (
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
from paper.study import PublishedStudy

_FORWARD = (
    "In every sequence of {}, the frequency of the jump of the forward sweep must never fall, and "
    "must rise by more than the step of 0.01 Hz in total."
)
_BACKWARD = (
    "In every sequence of {}, the frequency of the jump of the backward sweep must never fall, "
    "and must rise by more than the step of 0.01 Hz in total. It must rise by less than the "
    "frequency of the forward jump."
)


def _forward(study: PublishedStudy, sequences: Sequences) -> Finding:
    rise = jump_trend(study, sequences, "forward")
    return Finding(rise.all_hold, rise.describe(".2f", " Hz"))


def _backward(study: PublishedStudy, sequences: Sequences) -> Finding:
    forward = jump_trend(study, sequences, "forward")
    backward = jump_trend(study, sequences, "backward")
    return Finding(backward_less(forward, backward), backward.describe(".2f", " Hz"))


_MOVES = tuple(
    claim(
        f"{name}-jump-with-{parameter}",
        "4.2, Fig. 5",
        f"{words}, the higher the frequency of the {name} jump{less}.",
        quantity.format(along),
    )(partial(judged, sequences=sequences))
    for parameter, words, along, sequences in (
        ("gap", "The smaller the gap", "falling gaps", ALONG_GAP),
        ("acceleration", "The larger the acceleration", "rising accelerations", ALONG_ACCELERATION),
        ("bumper", "The stiffer the bumper", "rising bumper stiffness", ALONG_BUMPER),
    )
    for name, less, quantity, judged in (
        ("downward", "", _FORWARD, _forward),
        ("upward", ". This jump moves less than the downward jump", _BACKWARD, _backward),
    )
)


def _rises(study: PublishedStudy) -> dict[str, tuple[float, float]]:
    """Return the rise of η_a and η_d at the upward jump of the backward sweep, by test."""
    rises = {}
    for code in CODES:
        up = [
            j
            for j in study.features(code).jumps
            if j.direction == "backward" and j.upward and j.settled
        ]
        if up:
            top = max(up, key=lambda one: one.frequency)
            rises[code] = (top.eta_a[1] - top.eta_a[0], top.eta_d[1] - top.eta_d[0])
    return rises


@claim(
    "upward-jump-less-evident",
    "4.2, Fig. 6",
    "The upward jump is less visible in the displacement than in the acceleration.",
    "The rise of η_d at the upward jump must be smaller than the rise of η_a, in all tests that "
    "have an upward jump.",
)
def less_evident(study: PublishedStudy) -> Finding:
    """Compare the two quantities test by test."""
    rises = _rises(study)
    less = [code for code, (a, d) in rises.items() if abs(d) < abs(a)]
    most = max((abs(d) / abs(a) for a, d in rises.values()), default=float("nan"))
    return Finding(
        bool(rises) and len(less) == len(rises),
        f"smaller in {len(less)} of {len(rises)} tests with an upward jump; the rise of η_d is at "
        f"most {most:.2f} times that of η_a",
    )


@claim(
    "upward-jump-fades",
    "4.2, Fig. 6",
    "In the displacement, the upward jump becomes smaller as the gap grows and as the acceleration "
    "falls.",
    "The rise of η_d at the upward jump must grow in every sequence of falling gaps and in every "
    "sequence of rising accelerations.",
)
def fades(study: PublishedStudy) -> Finding:
    """Apply the same rule as to all other trends."""
    rises = {code: d for code, (_, d) in _rises(study).items()}
    gap, acceleration = (
        trend(sequences, rises.get, 1) for sequences in (ALONG_GAP, ALONG_ACCELERATION)
    )
    return Finding(
        gap.all_hold and acceleration.all_hold,
        f"gap: {gap.describe('.3f')}; acceleration: {acceleration.describe('.3f')}",
    )


CLAIMS = (*_MOVES, less_evident, fades)
