"""Split a long computation into short calls of the engine, so that Ctrl-C ends it within a second.

While compiled code runs, Python does not notice an interrupt. A motion is therefore simulated some
cycles at a time; the result does not depend on the splits.
"""

from __future__ import annotations

import time

from vibroimpact.tasks.threads import Progress, stop_if_unwanted

_SHORT, _LONG = 0.1, 0.4
"""Target duration of a call (s). If a call takes less or more, the next one is twice or half as
long."""
_VERY_SHORT, _MUCH_LONGER = 0.01, 8
"""A call that takes less than this (s) makes the next one so many times as long."""


class Calls:
    """Length of each call, from the durations of earlier calls.

    Parameters
    ----------
    total
        Total number of steps, such as forcing cycles; the last one may be incomplete.
    progress
        Function that is called between two calls with the number of steps done and their total.
    most
        Largest number of steps of one call. Default: as many as fit the target duration.
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
        """Return the step at which a call that starts at `done` should end.

        Raises
        ------
        Stopped
            If the task that this is a part of was cancelled.
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
