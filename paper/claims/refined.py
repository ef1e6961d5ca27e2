"""Statements that the linear isolator could not judge or reproduce, with a softening one."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from paper.claim import Claim, Finding, Kind
from paper.claims.reading import CODES, apart, at_most, claim, jump, listed
from paper.study import PublishedStudy
from vibroimpact.model import laboratory

_WITH = "With the refined isolator: "

_AGAIN = (
    "free-trend",
    "forward-higher-acceleration",
    "forward-higher-displacement",
    "upward-jump-with-gap",
    "upward-jump-with-acceleration",
    "upward-jump-with-bumper",
    "upward-jump-fades",
    "bell-in-the-middle",
    "bell-descending",
    "acceleration-with-acceleration-backward",
    "directions-closer-with-bumper",
    "s3-secondary-without-hysteresis",
    "s1-acceleration-like-free-flight",
)
"""Statements that the linear isolator did not reproduce, or for which its stiffness was chosen."""


@claim(
    "refined-softening",
    "4.1",
    f"{_WITH}the curves of free flight bend to the left, more strongly at larger table "
    "accelerations, with a narrow hysteresis at A3.",
    "The half-power width above the resonance is divided by the width below it. This ratio must "
    "be larger than for the linear isolator, and larger at A3 than at A1. At A3, the two sweeps "
    "must differ.",
    Kind.REFINED,
)
def softening(study: PublishedStudy) -> Finding:
    """Compare the frequencies at which the displacement has fallen by a factor of √2."""
    codes = tuple(f"B1-Ginf-{a}" for a in laboratory.ACCELERATIONS)
    leaning, others = ([_lean(one, code) for code in codes] for one in (study.refined(), study))
    differ = float(apart(study.refined().family(codes)).sel(rig=codes[-1]).max())
    bent = all(mine > other for mine, other in zip(leaning, others, strict=True))
    return Finding(
        bent and leaning[0] < leaning[-1] and differ > 1e-3,
        f"ratio of widths {listed(leaning)} (A1 to A3), with the linear isolator {listed(others)}; "
        f"the sweeps at A3 differ by {at_most(differ)}",
    )


def _lean(study: PublishedStudy, code: str) -> float:
    curve = study.curves(code)["displacement_excursion"].sel(direction="forward")
    frequency, height = curve["frequency"].values, curve.values
    high = np.flatnonzero(height >= height.max() / math.sqrt(2.0))
    top = float(frequency[height.argmax()])
    return float((frequency[high[-1]] - top) / (top - frequency[high[0]]))


@claim(
    "refined-upward-jump",
    "5, Figs. 11 and 13",
    f"{_WITH}the upward jump lies at a higher frequency than with the linear isolator. With the "
    "linear isolator, free flight does not soften, and the frequency of the jump is too low.",
    "The frequency of the upward jump must be higher with the refined isolator than with the "
    "linear one, in all tests that have an upward jump with both.",
    Kind.REFINED,
)
def upward(study: PublishedStudy) -> Finding:
    """Compare the isolators test by test."""
    pairs = {
        code: (one, other)
        for code in CODES
        if (one := jump(study.refined(), code, "backward")) is not None
        and (other := jump(study, code, "backward")) is not None
    }
    moves = {code: one - other for code, (one, other) in pairs.items()}
    higher = sum(move > 0.0 for move in moves.values())
    listing = ", ".join(
        f"{code} from {pairs[code][1]:.3f} to {pairs[code][0]:.3f} Hz"
        for code in ("B2-G1-A3", "B2-G2-A2")
        if code in pairs
    )
    least, most = (min(moves.values()), max(moves.values())) if moves else (math.nan, math.nan)
    return Finding(
        bool(moves) and higher == len(moves),
        f"higher in {higher} of {len(moves)} tests, by {least:+.3f} to {most:+.3f} Hz; {listing}",
    )


def judged_again(claims: Sequence[Claim]) -> tuple[Claim, ...]:
    """Return the statements about the tests, judged with the refined isolator."""
    known = {one.key: one for one in claims}
    again = []
    for key in _AGAIN:
        one = known[key]

        def find(study: PublishedStudy, one: Claim = one) -> Finding:
            return one.find(study.refined())

        statement = f"{_WITH}{one.statement[0].lower()}{one.statement[1:]}"
        again.append(
            one._replace(key=f"refined-{key}", statement=statement, find=find, kind=Kind.REFINED)
        )
    return (softening, upward, *again)
