"""Section 7 and Table 1: dimensionless parameters."""

from __future__ import annotations

import numpy as np

from paper import table1
from paper.claim import Finding, Kind
from paper.claims import grazing
from paper.claims.named import from_below
from paper.claims.reading import ACCELERATIONS, BUMPERS, CODES, at_most, claim
from paper.study import PublishedStudy
from vibroimpact.model import laboratory
from vibroimpact.model.dimensionless import to_dimensionless
from vibroimpact.model.rig import Rig
from vibroimpact.response.peaks import CURVES
from vibroimpact.response.resonance import UNSETTLED_APART

_GAPS = tuple(laboratory.GAPS)
_SAME = ("B2-G1-A3", "B2-G2-A2", "B2-G4-A1", "B3-10mm-A3", "B3-0mm-A3", "20kN/m-G3-A1")
"""One case for each scenario from S1 to S6."""


def _printed_again(names: tuple[str, ...]) -> Finding:
    computed = table1.computed()
    wrong = [
        f"{a} {name}: {computed[a][name]:.4g}, printed {printed[name]:g}"
        for a, printed in table1.PRINTED.items()
        for name in names
        if table1.written(name, computed[a][name]) != table1.written(name, printed[name])
    ]
    count = len(names) * len(table1.PRINTED)
    return Finding(
        not wrong, f"{count - len(wrong)} of {count} agree; {'; '.join(wrong)}".rstrip("; ")
    )


@claim(
    "table-gaps",
    "Table 1",
    "The twelve dimensionless gaps δ have the values of Table 1.",
    "G/(2 u_max), computed from the mass, the equivalent stiffness and ξ = 0.15, must agree to the "
    "two printed digits.",
    Kind.INPUTS,
)
def table_gaps(study: PublishedStudy) -> Finding:
    """Compare the gaps of one side, because the printed numbers are those of one side."""
    return _printed_again(_GAPS)


@claim(
    "table-stiffness-ratios",
    "Table 1",
    "The twelve stiffness ratios λ have the values of Table 1.",
    "K_j/K of each bumper at each acceleration must agree to the printed digit.",
    Kind.INPUTS,
)
def table_ratios(study: PublishedStudy) -> Finding:
    """Compare the stiffness of each bumper with that of the isolator."""
    return _printed_again(BUMPERS)


def _of_tests() -> dict[str, tuple[float, float]]:
    """Return λ and δ of the tests, computed from their rigs."""
    values = {}
    for code in CODES:
        case = laboratory.case(code)
        bumper = to_dimensionless(Rig(case.oscillator, case.amplitude)).right
        assert bumper is not None
        values[code] = (bumper.stiffness_ratio, bumper.gap)
    return values


@claim(
    "gap-is-of-both-sides",
    "7",
    "The dimensionless total gap δ is the sum of both sides.",
    "δ of Table 1 is compared with G/u_max (both sides) and G/(2 u_max) (one side).",
    Kind.INPUTS,
)
def total_gap(study: PublishedStudy) -> Finding:
    """Compare both definitions: the printed numbers are those of one side."""
    printed = table1.PRINTED["A3"]["G1"]
    one = table1.computed()["A3"]["G1"]
    return Finding(
        abs(2.0 * one - printed) <= 0.005,
        f"A3-G1: printed {printed:.2f}; both sides {2.0 * one:.3f}, one side {one:.3f}",
    )


@claim(
    "range-of-gaps",
    "7",
    "In the tests, δ is larger than 0.22.",
    "The smallest δ of the 48 tests must be at least 0.215, which is printed as 0.22.",
    Kind.INPUTS,
)
def range_gaps(study: PublishedStudy) -> Finding:
    """Compare the smallest gap to the printed digits."""
    least = min(gap for _, gap in _of_tests().values())
    return Finding(least >= 0.215, f"smallest δ {least:.4f}")


@claim(
    "range-of-stiffness-ratios",
    "7",
    "In the tests, λ lies between about 3 and about 90.",
    "The smallest λ (B1 at A1) and the largest λ (B4 at A3) must agree to the one digit that the "
    "paper gives.",
    Kind.INPUTS,
)
def range_ratios(study: PublishedStudy) -> Finding:
    """Compare the extreme ratios, which are those of B1-A1 and B4-A3."""
    tests = {code: ratio for code, (ratio, _) in _of_tests().items()}
    least, most = min(tests, key=tests.__getitem__), max(tests, key=tests.__getitem__)
    holds = (f"{tests[least]:.0e}", f"{tests[most]:.0e}") == ("3e+00", "9e+01")
    ends = least.startswith("B1") and least.endswith("A1") and most[:2] + most[-2:] == "B4A3"
    return Finding(holds and ends, f"{tests[least]:.2f} to {tests[most]:.1f}")


@claim(
    "parameters-with-acceleration",
    "7",
    "As the acceleration rises, λ of each bumper rises and δ of each gap falls.",
    "From A1 to A3, λ of the four bumpers must rise and δ of the four gaps must fall.",
    Kind.INPUTS,
)
def with_acceleration(study: PublishedStudy) -> Finding:
    """Check both trends, which follow from the softening isolator."""
    values = table1.computed()
    ratios = np.array([[values[a][b] for a in ACCELERATIONS] for b in BUMPERS])
    gaps = np.array([[values[a][g] for a in ACCELERATIONS] for g in _GAPS])
    holds = bool((np.diff(ratios) > 0).all() and (np.diff(gaps) < 0).all())
    return Finding(
        holds,
        f"λ of B2 {ratios[1, 0]:.1f} to {ratios[1, 2]:.1f}; δ of G1 {gaps[0, 0]:.2f} to "
        f"{gaps[0, 2]:.2f}",
    )


@claim(
    "middle-bumpers-close",
    "7, Fig. 21",
    "The stiffness ratios of B2 and B3 are close to each other.",
    "λ of each bumper is divided by λ of the next softer one. The smallest of these values must be "
    "that of B3 and B2.",
    Kind.INPUTS,
)
def middle(study: PublishedStudy) -> Finding:
    """Compare neighbouring bumpers. The result is the same at each acceleration."""
    values = table1.computed()["A3"]
    ratios = [values[BUMPERS[k + 1]] / values[BUMPERS[k]] for k in range(3)]
    listing = ", ".join(f"{BUMPERS[k + 1]}/{BUMPERS[k]} {ratios[k]:.2f}" for k in range(3))
    return Finding(min(ratios) == ratios[1], listing)


@claim(
    "only-ratios-matter",
    "7",
    "Rigs with the same dimensionless parameters respond alike, whatever their physical parameters "
    "are.",
    "For each scenario S1 to S6, the curves of one case are compared with those of a second rig. "
    "This rig has the same λ, δ, τ and ξ, but a mass of 3 kg on 700 N/m at 2 m/s². At the same "
    "multiples of the natural frequency, the curves must agree to 10⁻⁶ where both are periodic, "
    "and to 10 % elsewhere.",
    Kind.CONSTRUCTION,
)
def only_ratios(study: PublishedStudy) -> Finding:
    """Sweep two physically different rigs with the same ratios."""
    settled, loose, same = 0.0, 0.0, True
    for code in _SAME:
        one, other = study.twins(code)
        both = (one["motion"].values == "periodic") & (other["motion"].values == "periodic")
        same &= bool((one["period"].values == other["period"].values)[both].all())
        for curve in CURVES:
            differ = np.abs(other[curve].values / one[curve].values - 1.0)
            settled = max(settled, float(differ[both].max(initial=0.0)))
            loose = max(loose, float(differ[~both].max(initial=0.0)))
    return Finding(
        same and settled < 1e-6 and loose < UNSETTLED_APART,
        f"difference {at_most(settled)} where both are periodic, {at_most(loose, '.1%')} "
        f"elsewhere; {len(_SAME)} pairs of rigs",
    )


@claim(
    "tests-by-scenario",
    "7, Fig. 21",
    "Most tests are S2, four are S1, and the others are S3.",
    "The scenarios of all 48 tests.",
    Kind.RULES,
)
def counts(study: PublishedStudy) -> Finding:
    """Count the scenarios of the tests."""
    scenarios = list(study.scenarios().values())
    numbers = {s: scenarios.count(s) for s in sorted(set(scenarios))}
    holds = (
        set(numbers) == {"S1", "S2", "S3"} and numbers["S1"] == 4 and numbers["S2"] > len(CODES) / 2
    )
    listing = ", ".join(f"{s}: {n}" for s, n in numbers.items())
    return Finding(holds, f"{listing}; {from_below(study)}")


def _region(
    study: PublishedStudy, ratios: tuple[float, ...], gaps: tuple[float, ...], wanted: str
) -> Finding:
    scenarios = {(ratio, gap): study.scenario_at(ratio, gap) for ratio in ratios for gap in gaps}
    others = [f"λ {r:g}, δ {g:g}: {s}" for (r, g), s in scenarios.items() if s != wanted]
    summary = f"{wanted} at {len(scenarios) - len(others)} of {len(scenarios)} points"
    return Finding(not others, "; ".join([summary, *others]))


@claim(
    "soft-region-is-s6",
    "7, Fig. 21",
    "In Fig. 21, the band of soft bumpers that was not tested (λ below 2) has the colour of S6. "
    "The text leaves open which other scenarios occur there.",
    "The scenarios at λ = 0.5, 1, 1.5 and 1.9 with δ = 0.25, 0.5 and 0.75 must all be S6.",
)
def soft_region(study: PublishedStudy) -> Finding:
    """Check the region at δ above 0.2; below it lies the other region without tests."""
    return _region(study, (0.5, 1.0, 1.5, 1.9), (0.25, 0.5, 0.75), "S6")


@claim(
    "small-gap-region-is-s4",
    "7, Fig. 21",
    "In Fig. 21, the band of small gaps that was not tested (δ below 0.2) has the colour of S4. "
    "The text leaves open which other scenarios occur there.",
    "The scenarios at δ = 0.1, 0.15 and 0.19 must all be S4, for λ = 3, 25.9 and 87.5, which is "
    "the range of the tests.",
)
def small_gap_region(study: PublishedStudy) -> Finding:
    """Check the region of small gaps, whose other scenarios the paper leaves open."""
    return _region(study, (3.0, 25.9, 87.5), (0.1, 0.15, 0.19), "S4")


CLAIMS = (
    table_gaps,
    table_ratios,
    total_gap,
    with_acceleration,
    range_ratios,
    range_gaps,
    middle,
    counts,
    *grazing.DIMENSIONLESS,
    soft_region,
    small_gap_region,
    only_ratios,
)
