"""Attributes of an output variable."""

from __future__ import annotations

from typing import NamedTuple


class Variable(NamedTuple):
    """The units of a variable, and its meaning."""

    units: str
    long_name: str
    comment: str = ""
