"""Garbage collection: rare while a command starts, and with the usual frequency while it computes.

The objects that a command imports and draws exist until its end. Python searches all of them for
garbage many times, and once more at the end. These searches took a quarter of the time of a short
command.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_SELDOM = 1_000_000
"""Number of new objects that triggers a search. The start of a command makes fewer objects."""
_USUAL = gc.get_threshold()


def search_seldom() -> None:
    """Postpone searches until a computation begins, in a process that runs only one command."""
    gc.set_threshold(_SELDOM)


@contextmanager
def search_as_usual() -> Iterator[None]:
    """Search with the usual frequency of Python, but leave out all objects that already exist."""
    if gc.get_threshold()[0] != _SELDOM:  # the process runs more than this command
        yield
        return
    gc.freeze()
    gc.set_threshold(*_USUAL)
    try:
        yield
    finally:
        gc.set_threshold(_SELDOM)


def search_no_more() -> None:
    """Search no more, because the process ends."""
    gc.freeze()
