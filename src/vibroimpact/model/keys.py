"""Lists of accepted keys in messages, and suggestions for unknown keys."""

from __future__ import annotations

import difflib

MOST = 5
"""Largest number of unknown keys in a message. A search for suggestions takes long for many."""
SHOWN = 60
"""Largest number of characters of a key in a message."""


def listed(keys: list[str]) -> str:
    """Return keys as a list in words, such as ``"mass, right and left"``."""
    return " and ".join(filter(None, (", ".join(keys[:-1]), keys[-1])))


def unknown_key(keys: list[str], name: str) -> str:
    """Describe the error of an unknown key, with the accepted keys and a suggestion."""
    close = difflib.get_close_matches(name[:SHOWN], keys, n=1, cutoff=0.7)
    hint = f"; did you mean {close[0]}?" if close else ""
    return f"unknown key; {listed(keys)} are accepted{hint}"
