"""Section 4.1: free flight."""

from __future__ import annotations

import numpy as np

from vibroimpact.paper.claim import Finding, Kind
from vibroimpact.paper.claims.reading import ACCELERATIONS, apart, at_most, claim, listed
from vibroimpact.paper.study import PublishedStudy

_CODES = tuple(f"B1-Ginf-{a}" for a in ACCELERATIONS)


@claim(
    "free-softening",
    "4.1",
    "Measured free-flight curves bend to the left, more so at larger table accelerations, with a "
    "narrow hysteresis at A3.",
    "Nothing: the model's isolator is linear, so that its free flight can show neither.",
)
def softening(study: PublishedStudy) -> Finding:
    """Report that the model cannot decide this: its computed curves have no hysteresis."""
    worst = float(apart(study.family(_CODES)).max())
    return Finding(
        None,
        f"the linear model's two sweeps differ by {at_most(worst)}; needed: the measured "
        "free-flight sweeps, forward and backward, at the three accelerations",
    )


@claim(
    "free-trend",
    "4.1",
    "Without bumpers, larger table accelerations give larger excursions of acceleration and of "
    "displacement, at lower resonance frequencies.",
    "Maxima of both excursions for A1, A2, A3, and the frequencies of the acceleration's.",
    Kind.INPUTS,
)
def larger_and_lower(study: PublishedStudy) -> Finding:
    """Use the equivalent stiffness of each acceleration."""
    data = study.family(_CODES).sel(direction="forward")
    a = data["acceleration_excursion"].max("frequency").values
    d = data["displacement_excursion"].max("frequency").values
    f = data["acceleration_excursion"].idxmax("frequency").values
    holds = bool((np.diff(a) > 0).all() and (np.diff(d) > 0).all() and (np.diff(f) < 0).all())
    return Finding(
        holds,
        f"E_a {listed(a)} m/s²; E_d {listed(1e3 * d)} mm; at {listed(f)} Hz (A1, A2, A3)",
    )


CLAIMS = (softening, larger_and_lower)
