"""A statement of the paper, and the verdict of the computation."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from typing import NamedTuple

from paper.study import PublishedStudy


class Verdict(StrEnum):
    """Verdict on a statement."""

    REPRODUCED = "reproduced"
    NOT_REPRODUCED = "not reproduced"
    NEEDS_DATA = "needs the experiment's data"


class Kind(StrEnum):
    """Kind of a statement, which shows how strongly its verdict tests the model."""

    COMPUTED = "computed"
    """No part of the program was chosen with regard to the statement. The result was open."""
    RULES = "set by the rules"
    """The rules and thresholds of the scenarios were chosen to agree with such statements."""
    INPUTS = "inputs"
    """The statement is about the agreement of the parameters in the paper with each other."""
    REFINED = "with the refined isolator"
    """The statement is judged again with an isolator that softens as the displacement grows."""
    CONSTRUCTION = "by construction"
    """The equations of the model allow no other result. The statement tests the program."""


class Finding(NamedTuple):
    """The result that was computed for a statement."""

    holds: bool | None
    """Whether the statement is true for the computed result. None if only measurements can decide
    it."""
    number: str
    """The computed numbers that decide about the statement, with units."""

    @property
    def verdict(self) -> Verdict:
        """The verdict, which follows from the computed result."""
        if self.holds is None:
            return Verdict.NEEDS_DATA
        return Verdict.REPRODUCED if self.holds else Verdict.NOT_REPRODUCED


class Claim(NamedTuple):
    """A testable statement."""

    key: str
    """Short, unique name."""
    section: str
    """Place of the statement in the paper, such as ``4.2``, ``Table 1`` or ``Fig. 16``."""
    statement: str
    """The statement in our own words."""
    quantity: str
    """The quantity that is computed, and the criterion for the verdict ``reproduced``."""
    find: Callable[[PublishedStudy], Finding]
    kind: Kind = Kind.COMPUTED
