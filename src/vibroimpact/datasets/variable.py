"""Attributes of an output variable."""

from __future__ import annotations

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
    """The units of a variable, and its meaning."""

    units: str
    long_name: str
    comment: str = ""
