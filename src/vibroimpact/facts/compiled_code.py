"""Folders of compiled code as a table."""

from __future__ import annotations

from typing import Any

from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.tables import Column, table_of

_MOST = 12
"""Folders that are listed, the most recent."""
_COLUMNS = (
    Column("compiled code", "folder", left=True),
    Column("size", lambda one: _bytes(one["size"])),
    Column("parts", lambda one: len(one["flows"])),
    Column("compiled", lambda one: _ago(one["age"])),
    Column("", lambda one: "of this version" if one["own"] else "", left=True),
)


def text(facts: dict[str, Any], cleaned: bool) -> RenderableType:
    """Return the folders with their sizes and ages, and what was removed."""
    count = len(facts["kept"])
    plural = "" if count == 1 else "s"
    lines = [f"{facts['folder']}: {count} folder{plural}, {_bytes(facts['size'])}"]
    if count > _MOST:
        more = count - _MOST
        lines.insert(0, f"and {more} older folder{'s' if more > 1 else ''}")
    if cleaned:
        lines.append(f"removed: {_bytes(facts['removed'])}")
    lines += [f"kept, because another process uses it: {name}" for name in facts["in_use"]]
    table = table_of(facts["kept"][:_MOST], _COLUMNS)
    return Group(Text(f"engine: {facts['engine']}\n"), table, Text(), Text("\n".join(lines)))


def _bytes(size: int) -> str:
    return f"{size / 1e6:.1f} MB"


def _ago(age: float) -> str:
    for length, name in ((86400.0, "day"), (3600.0, "hour"), (60.0, "minute")):
        if age >= length:
            count = int(age / length)
            return f"{count} {name}{'s' if count > 1 else ''} ago"
    return "just now"
