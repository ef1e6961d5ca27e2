"""Section 6: scenarios and trends of G3-A1 from soft to nearly rigid bumpers (Fig. 20)."""

from __future__ import annotations

import numpy as np

from paper.claim import Finding, Kind
from paper.claims.along_gap import jumps_of
from paper.claims.reading import (
    ALMOST_ONE_LINE,
    BOTH,
    AbsentError,
    apart,
    claim,
    describe_onset,
    higher,
    listed,
)
from paper.study import STEP, STIFFNESSES, PublishedStudy
from vibroimpact.response.peaks import CURVES

_CODES = tuple(f"{stiffness}-G3-A1" for stiffness in STIFFNESSES)


@claim(
    "soft-bumpers-bend-only",
    "6, Fig. 20",
    "With very soft bumpers, the curves of G3-A1 bend slightly to the right, without jumps or "
    "hysteresis (S6). With stiffer bumpers, they are S2.",
    "The scenarios for the bumper stiffnesses from 10 kN/m to 10 MN/m must be S6 first, then S2, "
    "and no other.",
)
def soft(study: PublishedStudy) -> Finding:
    """Check the scenarios in the order of rising stiffness."""
    scenarios = [study.classification(code).scenario for code in _CODES]
    listing = ", ".join(f"{s} {f}" for s, f in zip(STIFFNESSES, scenarios, strict=True))
    return Finding(
        scenarios == sorted(scenarios, reverse=True) and set(scenarios) == {"S6", "S2"}, listing
    )


@claim(
    "soft-bumpers-one-motion",
    "6, Fig. 20",
    "Where the soft bumpers of scenario S6 are hit, there is one periodic motion with a single "
    "frequency.",
    "For the stiffnesses that give S6, both sweeps must reach the same motion, with a period of "
    "one forcing cycle. At resonance, all higher harmonics of the displacement together must be "
    "below 10 % of the first.",
)
def soft_motion(study: PublishedStudy) -> Finding:
    """Check the spectrum at the resonance of each stiffness."""
    codes = [code for code in _CODES if study.classification(code).scenario == "S6"]
    if not codes:
        raise AbsentError("no stiffness gives S6")
    data = study.by_stiffness().sel(rig=codes)
    places = data["eta_d"].sel(direction="forward").idxmax("frequency")
    shares = [higher(study.motion(c, float(places.sel(rig=c)), "forward")) for c in codes]
    holds = bool((data["period"] == 1).all()) and float(apart(data).max()) < 1e-6
    return Finding(
        holds and max(shares) < ALMOST_ONE_LINE,
        f"{', '.join(c.split('-')[0] for c in codes)}: higher harmonics "
        f"{listed([100 * s for s in shares], '.2g')} %",
    )


@claim(
    "no-secondary-for-g3-a1",
    "6, Fig. 20",
    "For G3-A1, no secondary resonance develops, however stiff the bumper is.",
    "The curves up to 10 MN/m must have no secondary resonance with a prominence of at least 2 %. "
    "A peak where contact begins, with free flight at its foot, is the onset of the primary "
    "resonance. Such a peak is left out.",
    Kind.RULES,
)
def no_secondary(study: PublishedStudy) -> Finding:
    """Use the evidence of the classification."""
    exceptions = {}
    for code in _CODES:
        one = study.classification(code)
        if one.features.secondary_resonances(one.thresholds.prominence) or one.features.left:
            exceptions[code] = one.scenario
    return Finding(
        not exceptions,
        f"{', '.join(exceptions) or f'none with any of {len(_CODES)} bumper stiffnesses'}; "
        f"{describe_onset(study, _CODES)}",
    )


@claim(
    "jumps-along-stiffness",
    "6, Fig. 20",
    "In the computed family of stiffnesses, stiffer bumpers also move both jumps to higher "
    "frequencies. The upward jump moves less.",
    "As the stiffness rises, the frequencies of both jumps of G3-A1 must never fall. Over the "
    "whole family, each must rise by more than the step of 0.01 Hz, and the upward jump must rise "
    "by less than the downward jump.",
)
def jumps_along_stiffness(study: PublishedStudy) -> Finding:
    """Follow both jumps. The upward jump occurs where free flight reaches the gap."""
    jumps = jumps_of(study.by_stiffness().sel(rig=list(_CODES)))
    down, up = np.array(list(jumps.values())).T
    rises = [bool((np.diff(v) >= 0).all()) and v[-1] - v[0] > 1.5 * STEP for v in (down, up)]
    return Finding(
        all(rises) and up[-1] - up[0] < down[-1] - down[0],
        f"down {down[0]:.3f} to {down[-1]:.3f} Hz, up {up[0]:.3f} to {up[-1]:.3f} Hz",
    )


@claim(
    "maxima-along-stiffness",
    "6, Fig. 20",
    "In the computed family of stiffnesses, stiffer bumpers also increase the maxima of η_a and "
    "reduce those of η_d.",
    "As the stiffness rises, the maxima of both directions of G3-A1 must rise in η_a and fall in "
    "η_d.",
)
def maxima_along_stiffness(study: PublishedStudy) -> Finding:
    """Check the maxima of both sweep directions."""
    data = study.by_stiffness().sel(rig=list(_CODES))
    parts, holds = [], True
    for curve, sign, name in zip(CURVES, (1, -1), ("η_a", "η_d"), strict=True):
        for way in BOTH:
            most = data[curve].sel(direction=way).max("frequency").values
            holds &= bool((sign * np.diff(most) > 0).all())
            parts.append(f"{name} {way} {most[0]:.3f} to {most[-1]:.3f}")
    return Finding(holds, "; ".join(parts))


CLAIMS = (soft, soft_motion, no_secondary, jumps_along_stiffness, maxima_along_stiffness)
