"""Many independent tasks on threads, with progress, and all stopped on Ctrl-C."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait

import numpy as np
from numpy.typing import NDArray

Progress = Callable[[int, int | None], None]
"""Called now and then with how much is done and how much there is to do, None if nobody knows."""


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


def run(
    task: Callable[[int], None],
    counter: NDArray[np.int64],
    total: int,
    threads: int | None,
    progress: Progress | None,
) -> None:
    """Run tasks 0, 1, … on threads; nothing that they compute may depend on their order.

    Parameters
    ----------
    task
        Called with the number of each task; it frees the interpreter lock while it computes.
    counter
        A row a task: [0] is raised by the task as it goes on, [1] becomes nonzero where it is
        to stop early.
    total
        What the sum of [0] will be.
    threads
        How many run at once; None for one a processor.
    progress
        Called from the calling thread.
    """
    with ThreadPoolExecutor(min(threads or available(), len(counter))) as pool:
        futures = [pool.submit(task, number) for number in range(len(counter))]
        try:
            pending = set(futures)
            while pending:
                pending = wait(pending, timeout=0.05 if progress else None).not_done
                if progress:
                    progress(int(counter[:, 0].sum()), total)
        except BaseException:
            counter[:, 1] = 1
            for future in futures:
                future.cancel()
            raise
        for future in futures:
            future.result()
