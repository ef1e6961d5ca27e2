"""A statement of the paper, and the verdict of the computation."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from typing import NamedTuple

from vibroimpact.paper.study import PublishedStudy


class Verdict(StrEnum):
    """What became of a statement."""

    REPRODUCED = "reproduced"
    NOT_REPRODUCED = "not reproduced"
    NEEDS_DATA = "needs the experiment's data"


class Kind(StrEnum):
    """Verdict on a statement."""

    COMPUTED = "computed"
    """Nothing in the program was chosen with it in view: it might have come out otherwise."""
    RULES = "set by the rules"
    """The rules and thresholds that name scenarios were chosen to agree with such statements."""
    INPUTS = "inputs"
    """Whether the parameters that the paper gives agree with each other."""
    REFINED = "with the refined isolator"
    """Judged again with an isolator that softens by itself."""
    CONSTRUCTION = "by construction"
    """The model's equations leave no other outcome: a test of the program."""


class Finding(NamedTuple):
    """What was computed for a statement."""

    holds: bool | None
    """Whether the statement holds for what was computed; None if only measurements can tell."""
    number: str
    """The numbers that decide it, with units."""

    @property
    def verdict(self) -> Verdict:
        """The verdict: it follows from what was computed."""
        if self.holds is None:
            return Verdict.NEEDS_DATA
        return Verdict.REPRODUCED if self.holds else Verdict.NOT_REPRODUCED


class Claim(NamedTuple):
    """One testable statement."""

    key: str
    """Short name, unique."""
    section: str
    """Where the paper says it, such as ``4.2``, ``Table 1``, ``Fig. 16``."""
    statement: str
    """In our own words."""
    quantity: str
    """What is computed, and what decides."""
    find: Callable[[PublishedStudy], Finding]
    kind: Kind = Kind.COMPUTED
