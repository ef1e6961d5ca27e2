"""Keys of tables in messages: those that are accepted, and the one that an unknown one may mean."""

from __future__ import annotations

import difflib

MOST = 5
"""Unknown keys that a message names; looking for what is meant takes long for many."""
SHOWN = 60
"""Letters of a key that a message shows."""


def listed(keys: list[str]) -> str:
    """Write keys as a list in words."""
    return " and ".join(filter(None, (", ".join(keys[:-1]), keys[-1])))


def unknown_key(keys: list[str], name: str) -> str:
    """Say that a key is unknown, which are accepted, and which may be meant."""
    close = difflib.get_close_matches(name[:SHOWN], keys, n=1, cutoff=0.7)
    hint = f", perhaps {close[0]} is meant" if close else ""
    return f"unknown key; {listed(keys)} are accepted{hint}"
