"""A long computation in short calls of the engine, so that Ctrl-C ends it within a second.

While compiled code runs, Python notices no interrupt. A motion is therefore followed some cycles
at a time; where it is cut changes no bit of it.
"""

from __future__ import annotations

import time

from vibroimpact.tasks.threads import Progress, stop_if_unwanted

_SHORT, _LONG = 0.1, 0.4
"""A call that takes less or more than this (s) makes the next one twice or half as long."""
_VERY_SHORT, _MUCH_LONGER = 0.01, 8
"""A call that takes less than this (s) makes the next one so many times as long."""


class Calls:
    """How far each call goes, by how long the calls before it took.

    Parameters
    ----------
    total
        Steps in all, such as forcing cycles; the last one may be incomplete.
    progress
        Called between two calls with the steps done and all there are.
    most
        Steps of one call; None for as many as take a while.
    """

    def __init__(
        self, total: float, progress: Progress | None = None, most: int | None = None
    ) -> None:
        self._total = total
        self._most = most
        self._progress = progress
        self._steps = 1  # of some rigs a step takes a second
        self._begin = 0.0

    def end(self, at: int) -> float:
        """The step at which the call that begins now at a step should end.

        Raises
        ------
        Stopped
            If the task that this is a part of is not wanted any more.
        """
        stop_if_unwanted()
        now = time.monotonic()
        if at:
            passed = now - self._begin
            if passed < _VERY_SHORT:
                self._steps *= _MUCH_LONGER
            elif passed < _SHORT:
                self._steps *= 2
            elif passed > _LONG:
                self._steps = max(1, self._steps // 2)
            if self._most is not None:
                self._steps = min(self._steps, self._most)
            if self._progress:
                self._progress(at, int(self._total))
        self._begin = now
        return min(self._total, at + self._steps)
