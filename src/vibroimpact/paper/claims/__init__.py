"""The paper's testable statements, in its order, each with the computation that judges it."""

from __future__ import annotations

from vibroimpact.paper.claim import Claim
from vibroimpact.paper.claims import (
    attached,
    dimensionless,
    families,
    free_flight,
    identified,
    jumps,
    left,
    maxima,
    motions,
    nonregular,
    shape,
    with_bumpers,
)

CLAIMS: tuple[Claim, ...] = (
    *free_flight.CLAIMS,
    *with_bumpers.CLAIMS,
    *jumps.CLAIMS,
    *maxima.CLAIMS,
    *shape.CLAIMS,
    *motions.CLAIMS,
    *identified.CLAIMS,
    *families.TESTS,
    *left.CLAIMS,
    *nonregular.CLAIMS,
    *attached.CLAIMS,
    *families.CLAIMS,
    *dimensionless.CLAIMS,
)
"""All of them; keys are unique."""

__all__ = ["CLAIMS"]
