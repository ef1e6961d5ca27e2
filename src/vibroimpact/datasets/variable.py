"""Attributes of an output variable."""

from __future__ import annotations

from typing import NamedTuple


class Variable(NamedTuple):
    """What a variable is measured in, and what it means."""

    units: str
    long_name: str
    comment: str = ""
