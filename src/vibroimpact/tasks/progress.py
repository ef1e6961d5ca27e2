"""Progress of a long computation, as a line in a notebook or on a terminal."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from html import escape
from typing import Any

from vibroimpact.model.argument_types import Seconds, String
from vibroimpact.model.public import public
from vibroimpact.stderr import print_line
from vibroimpact.tasks.threads import Progress

_WIDTH = 24
"""Width of the bar on a terminal (characters)."""
LINES = 30.0
"""Seconds between two lines if standard error is not a terminal."""
_TOO_EARLY = 2.0
"""Seconds before the remaining time is estimated, and before progress is shown by default."""


def _as_duration(seconds: float) -> str:
    """Write a duration in a readable unit: 40 s, 3 min, 2.5 h."""
    if seconds < 99.5:
        return f"{seconds:.0f} s"
    if seconds < 99.5 * 60.0:
        return f"{seconds / 60.0:.0f} min"
    return f"{seconds / 3600.0:.1f} h"


def in_words(what: str, done: int, total: int | None, passed: float) -> str:
    """Describe how much is done, the elapsed time, and the estimated remaining time."""
    text = f"{what} {done}{'' if total is None else f'/{total}'}, {_as_duration(passed)}"
    if total is None or not 0 < done < total or passed < _TOO_EARLY:
        return text
    return f"{text}, about {_as_duration(passed * (total - done) / done)} left"


class _Clock:
    """Time since the start of a job; restarted for each of several consecutive jobs."""

    def __init__(self) -> None:
        self._begin, self._done = time.monotonic(), 0

    def passed(self, done: int) -> float:
        """Return the seconds since the start, given how much is done."""
        if done < self._done:
            self._begin = time.monotonic()
        self._done = done
        return time.monotonic() - self._begin


def progress_lines(what: str) -> Progress:
    """Return a function that prints a line of progress every `LINES` s, for logs of long jobs."""
    clock, printed = _Clock(), time.monotonic()

    def show(done: int, total: int | None) -> None:
        nonlocal printed
        passed, now = clock.passed(done), time.monotonic()
        if now - printed >= LINES:
            printed = now
            print_line(in_words(what, done, total, passed))

    return show


@public
def progress_bar(what: String = "done", *, every: Seconds = 0.2) -> Progress:
    """Return a function that shows progress, for the argument ``progress`` of long computations.

    In a notebook, the function updates one line. On a terminal, it updates one line on standard
    error, and clears this line at the end. Elsewhere, such as in the log of a batch job, it writes
    a line every half minute. It also estimates the remaining time. No other package is required.
    Example::

        vi.scenario_map(rig, axes, progress=vi.progress_bar("map"))

    Parameters
    ----------
    what
        Name of the computation, in one word.
    every
        Shortest time between two updates (s).
    """
    clock, shown = _Clock(), -math.inf
    display = _notebook()
    handle: Any = None
    longest = 0
    lines = progress_lines(what)

    def show(done: int, total: int | None) -> None:
        nonlocal shown, handle, longest
        passed, now = clock.passed(done), time.monotonic()
        ended = total is not None and done >= total
        if not ended and now - shown < every:
            return
        shown = now
        text = in_words(what, done, total, passed)
        if display is not None:
            range_ = "" if total is None else f' value="{done}" max="{total}"'
            bar = "" if ended else f"<progress{range_}></progress> "
            page = {"text/html": bar + escape(text), "text/plain": text}
            if handle is None:
                handle = display(page, raw=True, display_id=True)
            else:
                handle.update(page, raw=True)
        elif not (sys.stderr and sys.stderr.isatty()):
            lines(done, total)
        else:
            full = _WIDTH * done // max(total or 1, 1)
            line = text if total is None else f"{text} [{'#' * full}{'.' * (_WIDTH - full)}]"
            longest = max(longest, len(line))
            end = f"\r{' ' * longest}\r" if ended else ""
            print(f"\r{line:{longest}}{end}", end="", file=sys.stderr, flush=True)

    return show


def shown_by_default(what: str) -> Progress | None:
    """Return `progress_bar` on a terminal or in a notebook, silent for the first seconds.

    Elsewhere, such as in a script whose output is a file, return None.
    """
    if _notebook() is None and not (sys.stderr and sys.stderr.isatty()):
        return None
    bar, begin = progress_bar(what), time.monotonic()
    visible = False

    def show(done: int, total: int | None) -> None:
        nonlocal visible
        visible = visible or time.monotonic() - begin >= _TOO_EARLY
        if visible:
            bar(done, total)

    return show


def _notebook() -> Callable[..., Any] | None:
    """Return the display of a notebook, if this is one."""
    if "IPython" not in sys.modules:
        return None
    from IPython import get_ipython
    from IPython.display import display

    # The shell of a terminal has no kernel.
    return display if hasattr(get_ipython(), "kernel") else None
