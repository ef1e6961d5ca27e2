"""Lists of accepted keys in messages, and suggestions for unknown keys."""

from __future__ import annotations

from collections.abc import Sequence

from vibroimpact.errors import advised, alternatives, meant

MOST = 5
"""Largest number of unknown keys in a message. A search for suggestions takes long for many."""
SHOWN = 60
"""Largest number of characters of a key in a message."""


_ELSEWHERE = (
    (("frequency", "natural_frequency"), "period", "write its reciprocal, the period"),
    (
        ("frequency", "forcing_frequency"),
        "amplitude",
        "write the frequency in the table [simulate] or as --frequency",
    ),
    (
        ("F0", "force", "unbalance", "acceleration", "displacement"),
        "amplitude",
        'write it as amplitude: its unit says what it is, such as "500 N" or "0.4 kg m"',
    ),
    (
        ("stops", "stop", "bumpers", "bumper"),
        "right",
        "write each stop as right or left, such as the table [oscillator.right]",
    ),
)
"""Keys that users expect in a table, a key by which the table is recognised, and what to do."""


def listed(keys: Sequence[str]) -> str:
    """Return keys as a list in words, such as ``"mass, right and left"``."""
    return " and ".join(filter(None, (", ".join(keys[:-1]), keys[-1])))


LIKENESS = 0.7
"""Least similarity of a misspelt key to the key that is suggested."""


def unknown_key(keys: Sequence[str], name: str, laws: Sequence[str] = ()) -> str:
    """Describe the error of an unknown key, with the accepted keys and a suggestion.

    `laws` are the laws that have this key.
    """
    for names, beside, advice in _ELSEWHERE:
        if name in names and beside in keys:
            return f"unknown key; {advice}; this table has the keys {listed(keys)}"
    use = advised(meant(name, keys, LIKENESS), alternatives(keys))
    other = f"; {listed(laws)} {'has' if len(laws) == 1 else 'have'} this key" if laws else ""
    return f"unknown key; {use}{other}"
