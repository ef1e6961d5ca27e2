"""Run many independent tasks on threads or a cluster, with progress; Ctrl-C stops all."""

from __future__ import annotations

import contextlib
import itertools
import os
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from queue import Empty, SimpleQueue
from typing import Annotated, Any, Protocol, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from vibroimpact.arguments import check_progress
from vibroimpact.errors import InputError

_Item = TypeVar("_Item")
_Found = TypeVar("_Found")

_POLL = 0.05
"""Seconds between two reports of progress, and the longest time until Ctrl-C is noticed."""

Tally: TypeAlias = NDArray[np.int64]
"""Counters of a task: [0] is the work done so far, [1] becomes nonzero if it shall stop, [2] counts
the cycles of the current hold."""

DONE, CYCLES = 0, 2
"""Function that counts progress."""

_current = threading.local()
"""Its `tally` belongs to the task that the thread runs."""

Progress: TypeAlias = Annotated[Callable[[int, int | None], None], check_progress]
"""Function that is called with the amount done and the total, None if it is unknown."""


class Elsewhere(Protocol):
    """Interface of workers other than threads (`processes`, `cluster`)."""

    def width(self) -> int:
        """Number of tasks that run at once."""
        ...

    def each(
        self, task: Callable[..., Any], items: Sequence[Any], total: int, progress: Progress | None
    ) -> list[Any]:
        """Run a task for each item."""
        ...


Workers: TypeAlias = int | Elsewhere | None
"""Number of threads, None for one per processor, or other workers."""


def counted(progress: Progress | None) -> Callable[[object], None] | None:
    """Return a function that reports one more item to `progress` per call; the total is unknown."""
    if progress is None:
        return None
    count = itertools.count(1)
    return lambda _: progress(next(count), None)


def available() -> int:
    """Return the number of processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def worker_count(threads: Workers) -> int:
    """Return the number of tasks that run at once."""
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
    """Run a task for each item, many at once; all stop if one fails, or on Ctrl-C.

    Every computation for many rigs, records or values uses this function. A task is a function of
    its item alone: it writes only to its tally, and returns its result.

    Parameters
    ----------
    task
        Function that is called with an item and its tally. It releases the interpreter lock while
        it computes.
    items
        Items for which the task runs.
    steps
        Total of the tallies, if tasks count their own steps. None if each item is one step, which
        is counted here.
    threads
        Number of threads (default: one per processor); or a cluster, where a task has only its own
        tally. It does not affect the result.
    progress
        Function that is called in the calling thread.
    counted_by
        Function that counts progress from the tallies.

    Returns
    -------
    list
        Results, in the order of the items.
    """
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
            value = task(items[number], tally)
        if steps is None:
            tally[0] = 1
        return value

    with ThreadPoolExecutor(min(threads or available(), len(items))) as pool:
        futures = [pool.submit(one, number) for number in range(len(items))]
        # Each reports when it is done: to ask all that are not would grow with the square of them.
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
    """Raised in a task that was cancelled."""


class LostError(InputError):
    """Raised if the workers were lost, or died repeatedly."""


def alone(task: Callable[[_Item, Tally], _Found], item: _Item) -> _Found:
    """Run a task that cannot be cancelled; its tally is not shared."""
    tally = np.zeros(3, dtype=np.int64)
    with _doing(tally):
        return task(item, tally)


def watched(
    task: Callable[[Tally], _Found],
    steps: int,
    progress: Progress | None = None,
    counted_by: int = DONE,
) -> _Found:
    """Run one long task so that Ctrl-C ends it: on a separate thread, unless this is one.

    The task ends soon after [1] of its tally becomes nonzero. `steps`, `progress` and
    `counted_by` are those of `each`.
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
    value = task(tally)
    tally[DONE] = before  # the task that this is a part of counts its own steps
    stop_if_unwanted()
    return value


def stop_if_unwanted() -> None:
    """Raise `Stopped` if this thread runs a task that was cancelled."""
    tally: Tally | None = getattr(_current, "tally", None)
    if tally is not None and tally[1]:
        raise Stopped


@contextlib.contextmanager
def _doing(tally: Tally) -> Iterator[None]:
    """Set the tally of this thread's task."""
    before = getattr(_current, "tally", None)
    _current.tally = tally
    try:
        yield
    finally:
        _current.tally = before
