"""Run tasks on processes of this machine, each with its own interpreter."""

from __future__ import annotations

import importlib
import multiprocessing
import os
import threading
import time
from collections.abc import Callable, Collection, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from typing import Any, NamedTuple, TypeVar

from vibroimpact.stderr import open_streams
from vibroimpact.tasks.batching import distribute
from vibroimpact.tasks.threads import LostError, Progress, Tally, available

_Item = TypeVar("_Item")
_Found = TypeVar("_Found")

_IDLE = 10.0
"""Seconds after which idle processes end."""
_ORPHANED = 0.5
"""Seconds between two checks of a process whether its parent still runs."""


def may_start() -> bool:
    """Return whether this process may start others; a daemon may not."""
    return not multiprocessing.current_process().daemon


def end_with(parent: int) -> None:
    """End this process soon after its parent has ended, even if a signal killed the parent.

    Otherwise a process would continue until the end of its task.
    """

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(_ORPHANED)
        os._exit(1)

    threading.Thread(target=watch, name="end with the parent", daemon=True).start()


class _Hands(NamedTuple):
    pool: Any
    number: int

    def width(self) -> int:
        return self.number

    def take(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        taken: Future[Any] = self.pool.submit(function, *arguments)
        return taken

    def ready(self, taken: Collection[Future[Any]]) -> Iterable[Future[Any]]:
        return wait(taken, return_when=FIRST_COMPLETED).done

    def result(self, taken: Future[Any]) -> Any:
        return taken.result()


class Processes(NamedTuple):
    """Processes that run tasks instead of threads."""

    number: int | None
    """Number of processes; None for one per processor."""

    def width(self) -> int:
        """Number of tasks that run at once."""
        return self.number or available()

    def each(
        self,
        task: Callable[[_Item, Tally], _Found],
        items: Sequence[_Item],
        total: int,
        progress: Progress | None,
    ) -> list[_Found]:
        """Run tasks as `threads.each` does; tasks and results are sent between processes."""
        loky: Any = importlib.import_module("loky")

        # The same processes again, where they have not ended: starting takes a second.
        pool = loky.get_reusable_executor(
            max_workers=min(self.width(), len(items)),
            timeout=_IDLE,
            initializer=end_with,
            initargs=(os.getpid(),),
            env={"LOKY_MAX_MEMORY_LEAK_SIZE": "1e15"},  # what a task needs is no leak
        )
        try:
            with open_streams():  # loky flushes both when it starts a process
                return distribute(_Hands(pool, self.width()), task, items, total, progress)
        except loky.process_executor.TerminatedWorkerError as died:
            raise LostError(
                f"where: a process died, perhaps because memory ran out ({died}); if a store is "
                "used, repeat the call to resume"
            ) from died
        except BaseException:
            pool.shutdown(wait=True, kill_workers=True)
            raise
