"""Section 4.2: the effects of bumpers on the resonance curves."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

from paper.claim import Finding, Kind
from paper.claims.reading import (
    ACCELERATIONS,
    ALONG_GAP,
    BOTH,
    BUMPERS,
    CODES,
    FALLING_GAPS,
    SYMBOLS,
    TEST_STEP,
    AbsentError,
    apart,
    at_most,
    both_jumps,
    claim,
    contact_span,
    free,
    jump,
    peak,
    runs,
    span,
    three_between_jumps,
    touching,
    trend,
)
from paper.study import LOW, STEP, PublishedStudy
from vibroimpact.response.peaks import Curve
from vibroimpact.response.resonance import APART

_EXAMPLE = "B4-G4-A3"
_CURVES: tuple[tuple[str, str, Curve], ...] = (
    ("acceleration", "Fig. 5", "eta_a"),
    ("displacement", "Fig. 6", "eta_d"),
)
_CROSS = 0.05
"""Largest spread of four curves that cross according to the paper, divided by their mean."""


@claim(
    "acceleration-above-1",
    "4.2, Fig. 5",
    "Bumpers increase the largest acceleration: η_a exceeds 1 in every test and direction.",
    "The smallest of the 96 maxima of η_a (48 tests, two directions) must be above 1.",
)
def acceleration(study: PublishedStudy) -> Finding:
    """Check that all maxima are above 1."""
    most = study.campaign()["eta_a"].max("frequency")
    least = float(most.min())
    code = str(most.min("direction").idxmin("rig").item())
    return Finding(least > 1.0, f"smallest maximum {least:.3f} ({code})")


@claim(
    "displacement-below-1",
    "4.2, Fig. 6",
    "Bumpers limit the displacement: η_d stays below 1 in every test and direction.",
    "The largest of the 96 maxima of η_d must be below 1.",
)
def displacement(study: PublishedStudy) -> Finding:
    """Check that all maxima are below 1."""
    most = study.campaign()["eta_d"].max("frequency")
    largest = float(most.max())
    code = str(most.max("direction").idxmax("rig").item())
    return Finding(largest < 1.0, f"largest maximum {largest:.3f} ({code})")


def _forward_higher(study: PublishedStudy, curve: Curve) -> Finding:
    pairs = {code: [peak(study, code, curve, way).value for way in BOTH] for code in CODES}
    equal = [c for c, (f, b) in pairs.items() if abs(f - b) <= 1e-6 * f]
    higher = [c for c, (f, b) in pairs.items() if f > b and c not in equal]
    lower = len(CODES) - len(higher) - len(equal)
    scenarios = study.scenarios()
    where = ", ".join(f"{code} ({scenarios[code]})" for code in equal)
    return Finding(
        len(higher) == len(CODES),
        f"higher in {len(higher)} of {len(CODES)} tests, lower in {lower or 'none'}"
        + (f", equal in {where}" if equal else ""),
    )


_HIGHER = tuple(
    claim(
        f"forward-higher-{name}",
        f"4.2, {figure}",
        f"In {SYMBOLS[curve]}, the resonance peak of the forward sweep is higher than that of the "
        "backward sweep.",
        "The primary resonance must be higher in the forward sweep than in the backward sweep, in "
        "all 48 tests.",
    )(partial(_forward_higher, curve=curve))
    for name, figure, curve in _CURVES
)


@claim(
    "free-flight-without-impact",
    "4.2",
    "At frequencies without impacts, the curves are those of free flight. These frequencies lie "
    "below the onset of impacts and beyond the jumps.",
    "The largest relative difference of η_d from free flight must be below 10⁻⁶, at all "
    "frequencies without contact in the 48 tests.",
    Kind.CONSTRUCTION,
)
def overlap(study: PublishedStudy) -> Finding:
    """Compare the curves to rounding."""
    data = study.campaign()
    apart_by = abs(data["eta_d"] / free(data, "eta_d") - 1.0)
    worst = float(apart_by.where(~touching(data)).max())
    return Finding(worst < 1e-6, f"relative difference {at_most(worst)}")


@claim(
    "hysteresis-of-the-example",
    "4.2, Fig. 4",
    "In B4-G4-A3, the forward sweep leaves the curve of free flight when impacts begin. It then "
    "rises and jumps down. The backward sweep jumps up at a lower frequency, so that there is a "
    "right hysteresis.",
    "The upward jump must lie at a lower frequency than the downward jump. Between the jumps, the "
    "forward sweep must hit the bumpers and the backward sweep must not. Above the downward jump, "
    "neither sweep may hit them.",
)
def hysteresis(study: PublishedStudy) -> Finding:
    """Check the jumps: downwards to free flight, upwards away from it."""
    down, up = both_jumps(study, _EXAMPLE)
    hit = touching(study.campaign().sel(rig=_EXAMPLE))
    forward, backward = hit.sel(direction="forward"), hit.sel(direction="backward")
    middle = {"frequency": slice(up, down)}
    holds = (
        up < down
        and bool(forward.sel(middle).all())
        and not bool(backward.sel(middle).any())
        and not bool(hit.sel(frequency=slice(down, None)).any())
    )
    return Finding(holds, f"down at {down:.3f} Hz, up at {up:.3f} Hz")


@claim(
    "three-motions",
    "4.2, Fig. 4",
    "Between the two jumps of B4-G4-A3, three steady motions exist: a large and a small one that "
    "are stable, and one that is unstable and cannot be measured.",
    "The branch of periodic motions of B4-G4-A3, halfway between the jumps, must have two stable "
    "motions and an unstable one.",
)
def three_motions(study: PublishedStudy) -> Finding:
    """Count the orbits on the branch."""
    return three_between_jumps(study, _EXAMPLE)


@claim(
    "onset-with-gap",
    "4.2, Fig. 6",
    "The smaller the gap, the lower the frequency at which the curve leaves that of free flight.",
    "The first frequency with impacts in the forward sweep must fall as the gap falls, or stay at "
    "0.5 Hz. The sweep begins there, and some tests already have impacts at this frequency.",
)
def onset(study: PublishedStudy) -> Finding:
    """Check that the frequency falls until it reaches the beginning of the sweep."""
    fall = trend(ALONG_GAP, lambda code: contact_span(study, code)[0], -1)
    strictly = all(
        later < earlier or later == LOW
        for values in fall.values.values()
        for earlier, later in pairwise(values)
    )
    example = ", ".join(f"{f:.2f}" for f in fall.values["B2-A2"])
    return Finding(
        fall.all_hold and strictly, f"{fall.describe('.2f', ' Hz')}; B2-A2: {example} Hz"
    )


@claim(
    "larger-than-free-flight",
    "4.2, Fig. 6",
    "At some frequencies, the displacement is larger with bumpers than without them.",
    "In the forward sweep, η_d must exceed that of free flight by more than 1 % at some "
    "frequencies of at least one test.",
)
def larger(study: PublishedStudy) -> Finding:
    """Find the frequencies, which lie above the resonance of free flight."""
    data = study.campaign().sel(direction="forward")
    more = data["eta_d"] > (1.0 + APART) * free(data, "eta_d")
    count = int(more.any("frequency").sum())
    example = "B2-G1-A3"
    ranges = list(runs(data["frequency"].values, more.sel(rig=example).values))
    listing = ", ".join(span(*ends) for ends in ranges) or "at no frequency"
    return Finding(count > 0, f"in {count} of {len(CODES)} tests; {example}: {listing}")


@claim(
    "fixed-point",
    "4.2, Fig. 5",
    "For stiff bumpers and large accelerations, the η_a curves of the four gaps cross near 1 Hz.",
    "The spread of the η_a curves of G1 to G4 is computed at the frequencies at which all four "
    "have impacts. For B3 and B4 at A2 and A3, the smallest spread must be below 5 %, at a "
    "frequency that differs from 1 Hz by at most 0.1 Hz (one step of the tests).",
)
def fixed_point(study: PublishedStudy) -> Finding:
    """Use the forward sweep below the lowest upward jump."""
    data = study.campaign().sel(direction="forward")
    parts, holds = [], True
    for a in ACCELERATIONS[1:]:
        for b in BUMPERS[2:]:
            codes = [f"{b}-{g}-{a}" for g in FALLING_GAPS]
            ends = [up for code in codes if (up := jump(study, code, "backward")) is not None]
            if not ends:
                raise AbsentError(f"{b}-{a} does not jump")
            four = data.sel(rig=codes, frequency=slice(None, min(ends)))
            eta = four["eta_a"].where(touching(four).all("rig"), drop=True)
            if not eta.sizes["frequency"]:
                raise AbsentError(f"{b}-{a}: there is no frequency with impacts for all gaps")
            spread = (eta.max("rig") - eta.min("rig")) / eta.mean("rig")
            at, least = float(spread.idxmin("frequency")), float(spread.min())
            holds &= abs(round((at - 1.0) / STEP)) <= round(TEST_STEP / STEP) and least < _CROSS
            parts.append(f"{b}-{a} {at:.2f} Hz (spread {least:.1%})")
    return Finding(holds, ", ".join(parts))


@claim(
    "hysteresis-only-where-it-jumps",
    "4.2, Fig. 5",
    "Outside the hysteresis, the forward and backward curves coincide.",
    "The largest relative difference of the two directions must be below 10⁻⁶, in all 48 tests. "
    "The comparison leaves out frequencies within a hysteresis, and frequencies at which a sweep "
    "does not become periodic.",
)
def coincide(study: PublishedStudy) -> Finding:
    """Compare the directions. They differ by far less than two distinct motions would."""
    data = study.campaign()
    differ = apart(data).where((data["motion"] == "periodic").all("direction"))
    worst = 0.0
    for code in CODES:
        outside = differ.sel(rig=code)
        for item in study.features(code).hysteresis:
            f = outside["frequency"]
            outside = outside.where((f < item.low) | (f > item.high))
        worst = max(worst, float(outside.max()))
    return Finding(worst < 1e-6, f"relative difference {at_most(worst)}")


CLAIMS = (
    hysteresis,
    three_motions,
    coincide,
    acceleration,
    _HIGHER[0],
    fixed_point,
    displacement,
    _HIGHER[1],
    overlap,
    onset,
    larger,
)
