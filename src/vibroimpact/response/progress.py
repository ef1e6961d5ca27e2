"""How far a long computation is: a line on the page of a notebook, or on a terminal."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from html import escape
from typing import Any

from vibroimpact.response.threads import Progress

_WIDTH = 24
"""Characters of a terminal's bar."""


def progress_bar(what: str = "done", *, every: float = 0.2) -> Progress:
    """Return a function that shows progress, for the argument ``progress`` of what takes long.

    In a notebook it writes one line, anew as things go on, and leaves it there; on a terminal one
    line on standard error, which it clears at the end. Elsewhere it writes nothing. It needs no
    further package::

        vi.scenario_map(x, y, rig, progress=vi.progress_bar("map"))

    Parameters
    ----------
    what
        What is going on, in a word.
    every
        Least time in s between two changes.
    """
    begin = time.monotonic()
    shown = -every
    display = _notebook()
    handle: Any = None
    longest = 0

    def show(done: int, total: int | None) -> None:
        nonlocal shown, handle, longest
        passed = time.monotonic() - begin
        ended = total is not None and done >= total
        if not ended and shown >= 0.0 and passed - shown < every:
            return
        shown = passed
        text = f"{what} {done}{'' if total is None else f'/{total}'}, {passed:.0f} s"
        if display is not None:
            range_ = "" if total is None else f' value="{done}" max="{total}"'
            bar = "" if ended else f"<progress{range_}></progress> "
            page = {"text/html": bar + escape(text), "text/plain": text}
            if handle is None:
                handle = display(page, raw=True, display_id=True)
            else:
                handle.update(page, raw=True)
        elif sys.stderr.isatty():
            full = _WIDTH * done // max(total or 1, 1)
            line = text if total is None else f"{text} [{'#' * full}{'.' * (_WIDTH - full)}]"
            longest = max(longest, len(line))
            end = f"\r{' ' * longest}\r" if ended else ""
            print(f"\r{line:{longest}}{end}", end="", file=sys.stderr, flush=True)

    return show


def _notebook() -> Callable[..., Any] | None:
    """What writes on a notebook's page, if this is one."""
    if "IPython" not in sys.modules:
        return None
    from IPython import get_ipython
    from IPython.display import display

    # The shell of a terminal has no kernel.
    return display if hasattr(get_ipython(), "kernel") else None
