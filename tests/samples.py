"""How large the samples are: small, or full with ``--full`` (``make test-full``).

Whatever is smaller in the daily run asks here, and nowhere else.
"""

from __future__ import annotations

from typing import TypeVar

T = TypeVar("T")

full = False
"""Set by ``tests/conftest.py`` before a test is collected."""


def sample(whole: T, small: T) -> T:
    """`whole` in the full run, `small` in the daily one."""
    return whole if full else small
