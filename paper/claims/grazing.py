"""Scenario S1: motions in which the mass just reaches its bumpers (Sections 4.3, 6 and 7)."""

from __future__ import annotations

from functools import partial

import numpy as np

from paper import table1
from paper.claim import Finding, Kind
from paper.claims.reading import ACCELERATIONS, SYMBOLS, claim, free, listed
from paper.study import PublishedStudy
from vibroimpact.model import laboratory
from vibroimpact.response.peaks import CURVES, Curve
from vibroimpact.response.resonance import features

_CODE = "B2-G4-A1"
_TESTS = tuple(f"{bumper}-G4-A1" for bumper in laboratory.BUMPERS)
"""The tests that the paper calls grazing."""
_COMPUTED = "B3-65mm-A3"
"""The case in Fig. 19 with the largest gap that is smaller than the amplitude of free flight."""
_LIKE_FREE = 0.1
"""Largest difference from the maximum of free flight for curves that are called similar to it."""
_COINCIDE = 0.01
"""Acceleration of the curves that coincide with free flight according to the paper."""
_SHALLOW = 0.1
"""Largest penetration divided by the gap of one side, for bumpers that are hardly deformed."""


_CURVES: tuple[tuple[str, Curve], ...] = (("displacement", "eta_d"), ("acceleration", "eta_a"))


def _like_free(study: PublishedStudy, curve: Curve) -> Finding:
    data = study.campaign().sel(rig=_CODE)
    worst = float(np.abs(data[curve] - free(data, curve)).max())
    most = float(data[curve].max())
    return Finding(
        worst <= _LIKE_FREE, f"differs by at most {worst:.3f}; largest {SYMBOLS[curve]} {most:.3f}"
    )


_FREE = tuple(
    claim(
        f"s1-{name}-like-free-flight",
        "4.3, Fig. 10",
        f"In grazing contact (B2-G4-A1), the curves of the {name} are close to those of free "
        "flight.",
        f"The largest difference of {SYMBOLS[curve]} from free flight must be at most 0.1.",
    )(partial(_like_free, curve=curve))
    for name, curve in _CURVES
)


@claim(
    "s1-hardly-deformed",
    "4.3",
    "In grazing contact, the mass touches the bumpers without deforming them significantly.",
    "The largest penetration in the four tests with G4 and A1, in either direction, must be at "
    "most a tenth of the gap of one side. The rules for the scenarios use the same threshold for "
    "grazing.",
    Kind.RULES,
)
def hardly_deformed(study: PublishedStudy) -> Finding:
    """State the penetrations in millimetres, because the paper gives no number."""
    gap = 0.5 * laboratory.GAPS["G4"]
    most = study.campaign()["displacement_max"].max(["direction", "frequency"])
    deep = [float(most.sel(rig=code)) - gap for code in _TESTS]
    return Finding(
        max(deep) <= _SHALLOW * gap,
        f"{listed([1e3 * d for d in deep], '.2f')} mm (B1 to B4), at most {max(deep) / gap:.1%} of "
        "the gap of one side",
    )


@claim(
    "grazing-is-free-flight",
    "6",
    "In the Simplified Nonlinear Model, the curves of grazing contact (S1) coincide with those of "
    "free flight (S0), without jumps.",
    "The largest differences of η_a and of η_d from free flight must be at most 0.01, and there "
    "must be no jump. This applies to the four tests with G4 and A1, and to B3-A3 with a gap of 65 "
    "mm.",
)
def free_flight(study: PublishedStudy) -> Finding:
    """Check the cases that graze in the paper and in Fig. 19, not a gap of exactly u_max."""
    parts, holds = [], True
    for code in (*_TESTS, _COMPUTED):
        data = (study.by_gap() if code == _COMPUTED else study.campaign()).sel(rig=code, drop=True)
        worst = [float(np.abs(data[c] - free(data, c)).max()) for c in CURVES]
        jumps = [j for j in features(data).jumps if j.settled]
        holds &= max(worst) <= _COINCIDE and not jumps
        ends = "no jump"
        if jumps:
            ends = f"jumps at {' and '.join(f'{j.frequency:.3f}' for j in jumps)} Hz"
        parts.append(f"{code}: η_a {worst[0]:.2f}, η_d {worst[1]:.2f}, {ends}")
    return Finding(holds, "; ".join(parts))


@claim(
    "grazing-at-one",
    "7",
    "The gap at which the mass grazes depends on the acceleration, but it is always δ = 1.",
    "Bumper B2 at the three accelerations. With δ = 0.99 the bumpers must be hit, and with δ = "
    "1.01 they must not. The total gap for δ = 1 is listed.",
    Kind.CONSTRUCTION,
)
def at_one(study: PublishedStudy) -> Finding:
    """Check a hundredth to both sides, because the frequencies miss the peak slightly."""
    table = table1.computed()
    gaps = [1e3 * laboratory.GAPS["G1"] / table[a]["G1"] for a in ACCELERATIONS]
    hits = []
    for delta in (0.99, 1.01):
        codes = tuple(
            f"B2-{delta * gap:.9g}mm-{a}" for gap, a in zip(gaps, ACCELERATIONS, strict=True)
        )
        data = study.family(codes)
        hit = (data["impacts"].sel(stop="right") > 0).any(["direction", "frequency"])
        hits.append(hit.values.tolist())
    return Finding(
        hits == [[True] * 3, [False] * 3],
        f"δ = 1 is a total gap of {', '.join(f'{g:.1f}' for g in gaps)} mm at A1, A2, A3",
    )


TESTS = (*_FREE, hardly_deformed)
MODEL = (free_flight,)
DIMENSIONLESS = (at_one,)
