"""Items of the report. Each file computes one or several figures or tables."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from matplotlib.figure import Figure

from paper.study import PublishedStudy


class Table(NamedTuple):
    """A table of texts."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


class Item(NamedTuple):
    """A computed figure or table of the paper."""

    key: str
    """Key for ``--only`` and for file names, such as ``fig15``."""
    title: str
    caption: str
    """Caption in our own words."""
    draw: Callable[[PublishedStudy], Figure] | None = None
    table: Callable[[PublishedStudy], Table] | None = None
