"""Tables in one style, and printed summaries as plain text."""

from __future__ import annotations

import io

from rich.console import Console, RenderableType
from rich.table import Table

from vibroimpact.errors import printable


def as_text(summary: RenderableType, width: int = 100) -> str:
    """Return a printed summary as plain text of so many columns."""
    console = Console(record=True, file=io.StringIO(), width=width, highlight=False)
    console.print(summary)
    lines = printable(console.export_text(styles=False)).splitlines()
    return "".join(f"{line.rstrip()}\n" for line in lines)


def plain_table() -> Table:
    """Return an empty table of names, values and remarks, without lines."""
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2))
    for style in ("bold", "", "dim"):
        table.add_column(style=style)
    return table


def titled_table(title: str, *columns: str) -> Table:
    """Return an empty table with a title and columns."""
    table = Table(
        *columns,
        title=title,
        title_justify="left",
        title_style="",
        box=None,
        pad_edge=False,
        padding=(0, 2, 0, 2),
        header_style="dim",
    )
    return table
