"""Section 4.2: penetration, similarity of curves, and the tests with secondary resonances."""

from __future__ import annotations

import itertools

import numpy as np

from paper.claim import Finding, Kind
from paper.claims.reading import (
    ACCELERATIONS,
    ALONG_BUMPER,
    BUMPERS,
    CODES,
    SYMBOLS,
    AbsentError,
    claim,
    contact_span,
    describe_onset,
    free,
    listed,
    secondary,
    trend,
)
from paper.study import PublishedStudy
from vibroimpact.model import laboratory
from vibroimpact.response.peaks import CURVES, Curve


def _penetration(study: PublishedStudy, code: str, low: float, high: float) -> tuple[float, float]:
    """Return the smallest and largest penetration in a range of the forward sweep (m)."""
    bumper = laboratory.case(code).oscillator.right
    assert bumper is not None
    most = study.campaign()["displacement_max"].sel(rig=code, direction="forward")
    inside = most.sel(frequency=slice(low, high)) - bumper.gap
    return float(inside.min()), float(inside.max())


@claim(
    "penetration-with-bumper",
    "4.2",
    "The stiffer the bumper, the less deeply the mass presses into it.",
    "The largest penetration in the forward sweep must fall from B1 to B4, in all 12 pairs of gap "
    "and acceleration.",
)
def penetration(study: PublishedStudy) -> Finding:
    """Use the largest penetration over the frequency."""
    fall = trend(ALONG_BUMPER, lambda code: _penetration(study, code, 0.0, 10.0)[1], -1)
    example = listed([1e3 * value for value in fall.values["G1-A3"]], ".2f")
    return Finding(
        fall.all_hold,
        f"falls in {fall.held} of {len(fall.moves)} pairs; G1-A3: {example} mm (B1 to B4)",
    )


@claim(
    "penetration-independent-of-frequency",
    "4.2",
    "The stiffer the bumper, the less the penetration depends on the frequency.",
    "The penetration is evaluated at the frequencies at which all four bumpers are hit in the "
    "forward sweep. Its range must fall from B1 to B4, in all 12 pairs of gap and acceleration.",
)
def flat(study: PublishedStudy) -> Finding:
    """Use the range of frequencies in which all four bumpers are hit."""

    def change(code: str) -> float:
        others = [f"{b}-{code.split('-', 1)[1]}" for b in BUMPERS]
        spans = [contact_span(study, other) for other in others]
        low, high = max(s[0] for s in spans), min(s[1] for s in spans)
        least, most = _penetration(study, code, low, high)
        return most - least

    fall = trend(ALONG_BUMPER, change, -1)
    example = listed([1e3 * value for value in fall.values["G1-A3"]], ".2f")
    return Finding(
        fall.all_hold,
        f"falls in {fall.held} of {len(fall.moves)} pairs; G1-A3: {example} mm (B1 to B4)",
    )


def _distance(study: PublishedStudy, one: str, other: str) -> float:
    """Return the root mean square difference of two tests' curves, over both quantities."""
    data = study.campaign()
    squares = [((data[c].sel(rig=one) - data[c].sel(rig=other)) ** 2).mean() for c in CURVES]
    return float(np.sqrt(sum(squares)))


@claim(
    "middle-bumpers-alike",
    "4.2, Figs. 5 and 6",
    "Bumpers B2 and B3 have similar effects.",
    "The root mean square difference of the curves is computed for every pair of bumpers. The "
    "difference of B2 and B3 must be the smallest of the six, in all 12 pairs of gap and "
    "acceleration.",
)
def alike(study: PublishedStudy) -> Finding:
    """Compare both quantities in both sweep directions."""
    held, shares = 0, []
    for codes in ALONG_BUMPER.values():
        pairs = dict(
            zip(
                itertools.combinations(BUMPERS, 2),
                (_distance(study, *two) for two in itertools.combinations(codes, 2)),
                strict=True,
            )
        )
        middle = pairs.pop(("B2", "B3"))
        held += middle < min(pairs.values())
        shares.append(middle / min(pairs.values()))
    return Finding(
        held == len(ALONG_BUMPER),
        f"smallest in {held} of {len(ALONG_BUMPER)} pairs; {min(shares):.0%} to {max(shares):.0%} "
        "of the next smallest difference",
    )


def _from_free(study: PublishedStudy, curve: Curve) -> dict[str, float]:
    """Return the root mean square difference from free flight, by bumper and acceleration."""
    data = study.campaign()
    square = ((data[curve] - free(data, curve)) ** 2).mean(["direction", "frequency"])
    return {
        f"{b}-{a}": float(np.sqrt(square.sel(rig=[f"{b}-{g}-{a}" for g in laboratory.GAPS]).mean()))
        for a in ACCELERATIONS
        for b in BUMPERS
    }


def _describe(differences: dict[Curve, dict[str, float]], chosen: dict[Curve, str]) -> str:
    return "; ".join(
        f"{SYMBOLS[c]}: {name} ({differences[c][name]:.3f})" for c, name in chosen.items()
    )


@claim(
    "closest-to-free-flight",
    "4.2, Figs. 5 and 6",
    "The curves of the softest bumper at the smallest acceleration, B1-A1, are closest to free "
    "flight.",
    "The root mean square difference from free flight is computed over the four gaps. Among the "
    "12 pairs of bumper and acceleration, it must be smallest for B1-A1, in η_a and in η_d.",
)
def closest(study: PublishedStudy) -> Finding:
    """Compare both quantities."""
    differences = {curve: _from_free(study, curve) for curve in CURVES}
    least = {curve: min(values, key=values.__getitem__) for curve, values in differences.items()}
    return Finding(set(least.values()) == {"B1-A1"}, _describe(differences, least))


@claim(
    "furthest-from-free-flight",
    "4.2, Figs. 5 and 6",
    "The curves of the stiffest bumper at the largest acceleration, B4-A3, differ most from free "
    "flight.",
    "The root mean square difference from free flight is computed over the four gaps. Among the "
    "12 pairs of bumper and acceleration, it must be largest for B4-A3, in η_a and in η_d.",
)
def furthest(study: PublishedStudy) -> Finding:
    """Compare both quantities."""
    differences = {curve: _from_free(study, curve) for curve in CURVES}
    most = {curve: max(values, key=values.__getitem__) for curve, values in differences.items()}
    return Finding(set(most.values()) == {"B4-A3"}, _describe(differences, most))


@claim(
    "secondary-only-small-gaps-large-accelerations",
    "4.2 and 8",
    "Secondary resonances occur only for the two larger accelerations with the two smaller gaps.",
    "No test with A1, G3 or G4 may have a secondary resonance (a peak of η_a with a prominence of "
    "at least 2 %). A2, A3, G1 and G2 must all occur among the tests that have one. A peak where "
    "contact begins, with free flight at its foot, is the onset of the primary resonance. Such a "
    "peak is left out.",
    Kind.RULES,
)
def secondary_where(study: PublishedStudy) -> Finding:
    """List the tests that have a secondary resonance."""
    codes = [code for code in CODES if secondary(study, code)]
    parts = {part for code in codes for part in code.split("-")[1:]}
    return Finding(
        parts == {"A2", "A3", "G1", "G2"},
        f"{len(codes)} tests: {', '.join(codes)}; {describe_onset(study, CODES)}",
    )


@claim(
    "secondary-with-all-three",
    "4.2",
    "Secondary resonances appear as the gap falls, as the acceleration rises and as the bumper "
    "becomes stiffer.",
    "If a test has a secondary resonance, the tests with the next smaller gap, with the next "
    "larger acceleration and with the next stiffer bumper must also have one.",
    Kind.RULES,
)
def secondary_grows(study: PublishedStudy) -> Finding:
    """Check that there is no exception in the grid of tests."""
    codes = {code for code in CODES if secondary(study, code)}
    lost = []
    for code in codes:
        b, g, a = code.split("-")
        for name, part, step in ((b, "B", 1), (g, "G", -1), (a, "A", 1)):
            neighbour = code.replace(name, f"{part}{int(name[1]) + step}")
            if neighbour in CODES and neighbour not in codes:
                lost.append(f"{code} but not {neighbour}")
    return Finding(
        0 < len(codes) < len(CODES) and not lost,
        "; ".join(lost) or f"no exception among {len(codes)} tests",
    )


@claim(
    "secondary-higher-with-bumper",
    "8",
    "The secondary resonances become higher as the bumper becomes stiffer.",
    "η_a at the highest secondary resonance of the forward sweep must rise from B2 to B4, for each "
    "pair of gap and acceleration for which all three bumpers give one.",
)
def secondary_higher(study: PublishedStudy) -> Finding:
    """Compare the heights, not the prominences."""
    parts, holds = [], True
    for pair in ALONG_BUMPER:
        heights = []
        for code in (f"{b}-{pair}" for b in BUMPERS[1:]):
            classification = study.classification(code)
            least = classification.thresholds.prominence
            heights += [
                max(
                    (
                        p.value
                        for p in classification.features.secondary
                        if p.direction == "forward" and p.prominence >= least * p.value
                    ),
                    default=np.nan,
                )
            ]
        if np.isfinite(heights).all():
            holds &= bool((np.diff(heights) > 0).all())
            parts.append(f"{pair}: {listed(heights, '.3f')}")
    if not parts:
        raise AbsentError(
            "there is no pair of gap and acceleration with a secondary resonance for each of B2, "
            "B3 and B4"
        )
    return Finding(holds, "; ".join(parts))


CLAIMS = (
    secondary_where,
    secondary_grows,
    secondary_higher,
    penetration,
    flat,
    alike,
    closest,
    furthest,
)
