"""Attributes of an output variable."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple, Protocol


class Described(Protocol):
    """A variable that is described outside the vocabulary, such as a parameter that is varied."""

    @property
    def name(self) -> str:
        """Name of the variable."""
        ...

    @property
    def units(self) -> str:
        """Its units."""
        ...

    @property
    def long_name(self) -> str:
        """Its meaning."""
        ...


class Variable(NamedTuple):
    """The units of a variable, its meaning, the kind of its values, and the part that has it."""

    units: str
    long_name: str
    comment: str = ""
    kind: str = "number"
    """``number``, ``integer``, ``truth`` or ``text``."""
    part: str = ""
    """Dim of the values of one motion: ``stop``, or, of an assembly only, ``mass`` or ``link``."""


integer = partial(Variable, "1", kind="integer")
truth = partial(Variable, "1", kind="truth")
text = partial(Variable, "1", kind="text")
