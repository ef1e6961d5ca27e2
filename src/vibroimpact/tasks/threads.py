"""Many independent tasks on threads or a cluster, with progress, and all stopped on Ctrl-C."""

from __future__ import annotations

import contextlib
import itertools
import os
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from queue import Empty, SimpleQueue
from typing import Any, Protocol, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from vibroimpact.arguments import check_progress
from vibroimpact.errors import InputError

_Item = TypeVar("_Item")
_Found = TypeVar("_Found")

_POLL = 0.05
"""Seconds between two reports of progress, and at most until Ctrl-C is noticed."""

Tally: TypeAlias = NDArray[np.int64]
"""Of a task: [0] is what it has done so far, [1] becomes nonzero where it is to stop, [2] counts
the cycles of a hold that goes on."""

DONE, CYCLES = 0, 2
"""What progress is counted by."""

_current = threading.local()
"""Its `tally` is that of the task that a thread does."""

Progress = Callable[[int, int | None], None]
"""Called now and then with how much is done and how much there is to do, None if nobody knows."""


class Elsewhere(Protocol):
    """Where tasks are done in the place of threads (`processes`, `cluster`)."""

    def width(self) -> int:
        """How many are done at once."""
        ...

    def each(
        self, task: Callable[..., Any], items: Sequence[Any], total: int, progress: Progress | None
    ) -> list[Any]:
        """Do a task for each item."""
        ...


Workers: TypeAlias = int | Elsewhere | None
"""So many threads, one a processor, or what is in their place."""


def counted(progress: Progress | None) -> Callable[[object], None] | None:
    """What tells `progress`, each time it is called, that one more is done, of nobody knows."""
    if progress is None:
        return None
    count = itertools.count(1)
    return lambda _: progress(next(count), None)


def available() -> int:
    """Processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def breadth(threads: Workers) -> int:
    """How many tasks are done at once."""
    if threads is None:
        return available()
    return threads if isinstance(threads, int) else threads.width()


def each(
    task: Callable[[_Item, Tally], _Found],
    items: Sequence[_Item],
    *,
    steps: int | None = None,
    threads: Workers = None,
    progress: Progress | None = None,
    counted_by: int = DONE,
) -> list[_Found]:
    """Do a task for each item, many at once; all stop when one fails, or on Ctrl-C.

    All that is computed for many rigs, records or values goes through here. A task is a function
    of its item alone: it writes nowhere but to its tally, and returns what it has found.

    Parameters
    ----------
    task
        Called with an item and the tally of its own; it frees the interpreter lock while it
        computes.
    items
        What it is done for.
    steps
        What the tallies add up to, where tasks count steps of their own; None where an item is
        one step, which is counted here.
    threads
        How many run at once, None for one a processor; or a cluster, where a task has no tally
        but its own. No result depends on it.
    progress
        Called from the calling thread.
    counted_by
        What of the tallies progress adds up.

    Returns
    -------
    list
        What was found, in the order of the items.
    """
    check_progress(progress)
    if not items:
        return []
    total = len(items) if steps is None else steps
    if threads is not None and not isinstance(threads, int):
        return threads.each(task, items, total, progress)
    tallies = np.zeros((len(items), 3), dtype=np.int64)

    def one(number: int) -> _Found:
        tally = tallies[number]
        if tally[1]:
            raise Stopped
        with _doing(tally):
            found = task(items[number], tally)
        if steps is None:
            tally[0] = 1
        return found

    with ThreadPoolExecutor(min(threads or available(), len(items))) as pool:
        futures = [pool.submit(one, number) for number in range(len(items))]
        # Each tells when it is done: to ask all that are not would grow with the square of them.
        ended: SimpleQueue[Future[_Found]] = SimpleQueue()
        for future in futures:
            future.add_done_callback(ended.put)
        try:
            left = len(futures)
            due = time.monotonic() + _POLL
            while left:
                stop_if_unwanted()  # where these tasks are a part of another
                with contextlib.suppress(Empty):
                    ended.get(timeout=_POLL).result()  # raises what went wrong
                    left -= 1
                if progress and (not left or time.monotonic() >= due):
                    progress(int(tallies[:, counted_by].sum()), total)
                    due = time.monotonic() + _POLL
        except BaseException:
            tallies[:, 1] = 1
            for future in futures:
                future.cancel()
            raise
    return [future.result() for future in futures]


class Stopped(Exception):  # noqa: N818 - nothing went wrong
    """Raised in a task whose result is not wanted any more."""


class LostError(InputError):
    """What the tasks ran on went away, or died again and again."""


def alone(task: Callable[[_Item, Tally], _Found], item: _Item) -> _Found:
    """A task where nobody stops it; its tally stays there."""
    tally = np.zeros(3, dtype=np.int64)
    with _doing(tally):
        return task(item, tally)


def watched(
    task: Callable[[Tally], _Found],
    steps: int,
    progress: Progress | None = None,
    counted_by: int = DONE,
) -> _Found:
    """Do one long task so that Ctrl-C ends it: on a thread of its own, unless this is one.

    Parameters
    ----------
    task
        Called with a tally; it ends soon after [1] becomes nonzero.
    steps, progress, counted_by
        As in `each`.
    """
    tally: Tally | None = getattr(_current, "tally", None)
    if tally is None:
        return each(
            lambda _, mine: task(mine),
            [None],
            steps=steps,
            threads=1,
            progress=progress,
            counted_by=counted_by,
        )[0]
    before = tally[DONE]
    found = task(tally)
    tally[DONE] = before  # the task that this is a part of counts its own steps
    stop_if_unwanted()
    return found


def stop_if_unwanted() -> None:
    """Raise `Stopped` if this thread does a task whose result is not wanted any more."""
    tally: Tally | None = getattr(_current, "tally", None)
    if tally is not None and tally[1]:
        raise Stopped


@contextlib.contextmanager
def _doing(tally: Tally) -> Iterator[None]:
    """Make a tally that of this thread's task."""
    before = getattr(_current, "tally", None)
    _current.tally = tally
    try:
        yield
    finally:
        _current.tally = before
