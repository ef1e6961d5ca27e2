"""Section 4.1: free flight."""

from __future__ import annotations

import numpy as np

from paper.claim import Finding, Kind
from paper.claims.reading import ACCELERATIONS, apart, at_most, claim, listed
from paper.study import PublishedStudy

_CODES = tuple(f"B1-Ginf-{a}" for a in ACCELERATIONS)


@claim(
    "free-softening",
    "4.1",
    "The measured curves of free flight bend to the left, more strongly at larger table "
    "accelerations, with a narrow hysteresis at A3.",
    "Nothing is compared. The isolator of the model is linear, so that its free flight shows "
    "neither bending nor hysteresis.",
)
def softening(study: PublishedStudy) -> Finding:
    """Report that the model cannot decide this: its computed curves have no hysteresis."""
    worst = float(apart(study.family(_CODES)).max())
    return Finding(
        None,
        f"the two sweeps of the linear model differ by {at_most(worst)}; needed: the measured "
        "forward and backward sweeps of free flight at the three accelerations",
    )


@claim(
    "free-trend",
    "4.1",
    "Without bumpers, larger table accelerations give larger excursions of acceleration and of "
    "displacement, and lower resonance frequencies.",
    "The maxima of both excursions must rise from A1 to A3, and the frequency of the largest "
    "acceleration must fall.",
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
        f"largest E_a {listed(a)} m/s²; largest E_d {listed(1e3 * d)} mm; largest E_a at "
        f"{listed(f)} Hz (A1, A2, A3)",
    )


CLAIMS = (softening, larger_and_lower)
