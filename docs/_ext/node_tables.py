"""Tables that are made in the build."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from docutils import nodes


def table(
    headings: Mapping[str, int], rows: Iterable[Sequence[str]], title: str = ""
) -> nodes.table:
    """Return a table with these headings and widths, whose first column has names of code."""
    group = nodes.tgroup(cols=len(headings))
    group += [nodes.colspec(colwidth=width) for width in headings.values()]
    group += nodes.thead("", _row([nodes.Text(heading) for heading in headings]))
    body = nodes.tbody()
    for name, *cells in rows:
        body += _row([nodes.literal(text=name), *map(nodes.Text, cells)])
    group += body
    caption = [nodes.title(text=title)] if title else []
    return nodes.table("", *caption, group, classes=["colwidths-given"])


def _row(cells: Iterable[nodes.Node]) -> nodes.row:
    return nodes.row("", *(nodes.entry("", nodes.paragraph("", "", cell)) for cell in cells))
