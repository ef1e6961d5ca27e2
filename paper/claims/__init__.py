"""The testable statements in the order of the paper, each with the computation that judges it."""

from __future__ import annotations

from itertools import chain

from paper.claim import Claim
from paper.claims import (
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
    refined,
    shape,
    with_bumpers,
)

_OF_TESTS = (free_flight, with_bumpers, jumps, maxima, shape, motions)
_OF_MODEL = (identified, named, left, nonregular, attached)
_ALONG = (along_gap, along_stiffness, dimensionless)


def _of(*modules: object) -> tuple[Claim, ...]:
    return tuple(chain.from_iterable(vars(module)["CLAIMS"] for module in modules))


LINEAR: tuple[Claim, ...] = (
    *_of(*_OF_TESTS),
    *grazing.TESTS,
    *_of(*_OF_MODEL),
    *grazing.MODEL,
    *_of(*_ALONG),
)
"""All statements, judged with the model of the paper. Their keys are unique."""

CLAIMS: tuple[Claim, ...] = (*LINEAR, *refined.judged_again(LINEAR))
"""All statements, and those that the model of the paper could not judge or did not reproduce,
judged again with the refined isolator."""
