"""What the report consists of: a figure or a table a file."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from matplotlib.figure import Figure

from vibroimpact.paper.study import PublishedStudy


class Table(NamedTuple):
    """A table of texts."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


class Item(NamedTuple):
    """One figure or table of the paper, computed."""

    key: str
    """For ``--only`` and file names, such as ``fig15``."""
    title: str
    caption: str
    """What is seen, in our own words."""
    draw: Callable[[PublishedStudy], Figure] | None = None
    table: Callable[[PublishedStudy], Table] | None = None
