"""Garbage collection: rare while a command starts, as usual while it computes.

What a command imports and draws stays until its end. Python searches all of it many times, and once
more at the end, which took a quarter of the time of a short command.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_SELDOM = 1_000_000
"""New objects before a search; a start makes fewer."""
_USUAL = gc.get_threshold()


def search_seldom() -> None:
    """Postpone searches until a computation begins; for a process that runs one command."""
    gc.set_threshold(_SELDOM)


@contextmanager
def search_as_usual() -> Iterator[None]:
    """Search as often as Python does by itself, but not what was there before."""
    if gc.get_threshold()[0] != _SELDOM:  # the process is not the command's own
        yield
        return
    gc.freeze()
    gc.set_threshold(*_USUAL)
    try:
        yield
    finally:
        gc.set_threshold(_SELDOM)


def search_no_more() -> None:
    """Leave everything to the end of the process."""
    gc.freeze()
