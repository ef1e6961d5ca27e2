"""The paper's testable statements, in its order, each with the computation that judges it."""

from __future__ import annotations

from vibroimpact.paper.claim import Claim
from vibroimpact.paper.claims import (
    along_gap,
    along_stiffness,
    attached,
    dimensionless,
    free_flight,
    grazing,
    identified,
    jumps,
    left,
    maxima,
    motions,
    named,
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
    *grazing.TESTS,
    *identified.CLAIMS,
    *named.CLAIMS,
    *left.CLAIMS,
    *nonregular.CLAIMS,
    *attached.CLAIMS,
    *grazing.MODEL,
    *along_gap.CLAIMS,
    *along_stiffness.CLAIMS,
    *dimensionless.CLAIMS,
)
"""All of them; keys are unique."""

__all__ = ["CLAIMS"]
