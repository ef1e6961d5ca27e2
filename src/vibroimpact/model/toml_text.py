"""Values in TOML, for study files that are written."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any


def toml(value: Any) -> str:
    """Return a value, a list or a table in TOML, in one line, without entries that are None."""
    if isinstance(value, Mapping):
        inside = ", ".join(
            f"{key} = {toml(item)}" for key, item in value.items() if item is not None
        )
        return f"{{ {inside} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(toml(item) for item in value)}]"
    return quoted(value) if isinstance(value, str) else repr(value)


def quoted(text: str) -> str:
    """Return a string of TOML: that of JSON, but with the escapes that TOML requires."""
    whole = text.encode("utf-8", "replace").decode()  # half a letter is none
    return json.dumps(whole, ensure_ascii=False).replace("\x7f", "\\u007f")
