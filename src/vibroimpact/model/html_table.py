"""HTML tables for notebooks."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape


def table(title: str, rows: Iterable[tuple[str, str]]) -> str:
    """Return an HTML table of names and values under a title."""
    body = "".join(
        f'<tr><th style="text-align:left">{escape(name)}</th>'
        f'<td style="text-align:left">{escape(value)}</td></tr>'
        for name, value in rows
    )
    head = f'<caption style="text-align:left"><b>{escape(title)}</b></caption>'
    return f"<table>{head}<tbody>{body}</tbody></table>"
