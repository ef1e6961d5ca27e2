"""Section 6 and Fig. 14: the scenario of each test."""

from __future__ import annotations

import numpy as np

from paper.claim import Finding, Kind
from paper.claims.reading import claim, listed
from paper.study import HIGH, LOW, PublishedStudy
from vibroimpact.model import laboratory

EDGE, EDGE_LOW = "B1-G1-A3", 0.44
"""A test with a peak at the lower end of the frequency range of the tests, and the lowest frequency
(Hz) of `classify_scenario`."""


def from_below(study: PublishedStudy) -> str:
    """Classify the test at the edge from 0.5 Hz, and from the start of `classify_scenario`."""
    there = study.classification(EDGE, EDGE_LOW, HIGH).scenario
    here = study.scenarios()[EDGE]
    return (
        f"{EDGE} is {here} in a sweep from {LOW:g} Hz and {there} in a sweep from {EDGE_LOW:g} Hz"
    )


def _with(scenarios: dict[str, str], scenario: str, acceleration: str) -> list[str]:
    return [c for c, s in scenarios.items() if s == scenario and c.endswith(acceleration)]


@claim(
    "tests-at-a1",
    "6, Fig. 14",
    "At the smallest acceleration, the four tests with the largest gap graze (S1), and all others "
    "are S2.",
    "The scenarios of the 16 tests at A1.",
    Kind.RULES,
)
def at_a1(study: PublishedStudy) -> Finding:
    """Compare with the lowest plane of Fig. 14."""
    scenarios = study.scenarios()
    grazing, rest = _with(scenarios, "S1", "A1"), _with(scenarios, "S2", "A1")
    holds = {c.split("-")[1] for c in grazing} == {"G4"} and (len(grazing), len(rest)) == (4, 12)
    return Finding(holds, f"S1: {', '.join(grazing) or 'none'}; S2: {len(rest)} tests")


@claim(
    "tests-at-a2-a3",
    "6, Fig. 14",
    "At the two larger accelerations, only S2 and S3 occur, and no grazing.",
    "The scenarios of the 32 tests at A2 and A3.",
    Kind.RULES,
)
def at_a2_a3(study: PublishedStudy) -> Finding:
    """Compare with the upper planes of Fig. 14."""
    scenarios = [s for c, s in study.scenarios().items() if not c.endswith("A1")]
    listing = ", ".join(f"{s}: {scenarios.count(s)}" for s in sorted(set(scenarios)))
    return Finding(set(scenarios) == {"S2", "S3"}, f"{listing}; {from_below(study)}")


@claim(
    "s3-with-small-gap-and-stiff-bumper",
    "6, Fig. 14",
    "The scenario changes from S2 to S3 as the gap falls and as the bumper becomes stiffer.",
    "At A2 and at A3, if a test is S3, the tests with the next smaller gap and with the next "
    "stiffer bumper must also be S3. Both scenarios must occur.",
    Kind.RULES,
)
def transition(study: PublishedStudy) -> Finding:
    """Check that there is no exception."""
    scenarios = study.scenarios()
    exceptions, both = [], True
    for a in ("A2", "A3"):
        region = _with(scenarios, "S3", a)
        both &= bool(region) and bool(_with(scenarios, "S2", a))
        for code in region:
            b, g, _ = code.split("-")
            stiffer, narrower = f"B{int(b[1]) + 1}-{g}-{a}", f"{b}-G{int(g[1]) - 1}-{a}"
            exceptions += [
                f"{code} but not {other}"
                for other in (stiffer, narrower)
                if scenarios.get(other, "S3") != "S3"
            ]
    return Finding(both and not exceptions, "; ".join(exceptions) or "no exception")


@claim(
    "s3-region-grows",
    "6, Fig. 14",
    "The larger the acceleration, the more tests are S3.",
    "The number of tests that are S3 must rise from A1 to A2 and from A2 to A3.",
    Kind.RULES,
)
def region(study: PublishedStudy) -> Finding:
    """Count the tests that are S3."""
    scenarios = study.scenarios()
    counts = [len(_with(scenarios, "S3", a)) for a in laboratory.ACCELERATIONS]
    return Finding(
        bool((np.diff(counts) > 0).all()),
        f"{listed(counts, 'd')} tests (A1, A2, A3); {from_below(study)}",
    )


CLAIMS = (at_a1, at_a2_a3, transition, region)
