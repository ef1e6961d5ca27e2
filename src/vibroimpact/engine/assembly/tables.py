"""Tables of a mode."""

from __future__ import annotations


def table_size(n: int, stops: int, waves: int) -> int:
    """Numbers in the tables of one mode."""
    return 8
