"""Run tasks on a dask cluster; the tasks of a lost worker are repeated."""

from __future__ import annotations

import importlib
import time
from collections.abc import Callable, Collection, Sequence
from typing import Any, NamedTuple, TypeVar

from vibroimpact.errors import InputError
from vibroimpact.stderr import print_line
from vibroimpact.tasks.batching import distribute
from vibroimpact.tasks.threads import LostError, Progress, Tally

_Item = TypeVar("_Item")
_Found = TypeVar("_Found")

_AWAY = (
    "where: the connection to the cluster was lost; if a store is used, repeat the call to resume"
)
_ASKED = 1.0
"""Seconds between two checks for workers, while no result arrives."""
_SOON, _LONGEST = 5.0, 300.0
"""Seconds without any worker after which a line is printed, and after which an error is raised."""


class Cluster(NamedTuple):
    """A dask cluster that runs tasks instead of threads."""

    client: Any
    """A `distributed.Client`."""

    def width(self) -> int:
        """Number of tasks that run at once.

        Raises
        ------
        LostError
            If the client was closed.
        """
        if self.client.status in ("closing", "closed"):
            raise LostError(_AWAY)
        return max(1, sum(int(n) for n in self.client.nthreads().values()))

    def each(
        self,
        task: Callable[[_Item, Tally], _Found],
        items: Sequence[_Item],
        total: int,
        progress: Progress | None,
    ) -> list[_Found]:
        """Run tasks as `threads.each` does; tasks and results are sent over the network."""
        hands = _Hands(self)
        try:
            return distribute(hands, task, items, total, progress)
        except InputError:
            raise
        except Exception as error:
            if self.client.status == "running" and not isinstance(error, OSError):
                raise
            raise LostError(f"{_AWAY} ({error})") from error
        finally:
            if self.client.status == "running":
                self.client.cancel(list(hands.completed.futures))


class _Hands:
    def __init__(self, cluster: Cluster) -> None:
        self.cluster, self.width = cluster, cluster.width
        self.distributed: Any = importlib.import_module("distributed")
        self.completed = self.distributed.as_completed(loop=cluster.client.loop)

    def take(self, function: Callable[..., Any], *arguments: Any) -> Any:
        future = self.cluster.client.submit(function, *arguments, pure=False)
        self.completed.add(future)
        return future

    def ready(self, taken: Collection[Any]) -> Collection[Any]:
        self._wait()
        return [next(self.completed)]

    def _wait(self) -> None:
        """Wait until a task is done, but not forever if there is no worker."""
        client, done = self.cluster.client, self.completed
        asked = begin = time.monotonic()
        printed = False
        while not (done.has_ready() or done.is_empty()):
            with done.thread_condition:
                done.thread_condition.wait(timeout=0.1)
            now = time.monotonic()
            if now - asked < _ASKED:
                continue
            asked = now
            if client.status != "running" or client.nthreads():
                begin, printed = now, False
            elif now - begin > _LONGEST:
                raise LostError(
                    f"where: the cluster has had no worker for {_LONGEST:g} s; use a cluster with "
                    "workers; if a store is used, repeat the call to resume"
                )
            elif now - begin > _SOON and not printed:
                printed = True
                print_line(
                    f"the cluster has no worker; waiting for one, at most {_LONGEST:g} s ..."
                )

    def result(self, taken: Any) -> Any:
        if taken.status == "cancelled":
            raise LostError(_AWAY)
        try:
            return taken.result()
        except self.distributed.KilledWorker as killed:
            raise LostError(
                f"where: a task made the workers of the cluster fail ({killed}); use "
                "workers with more memory"
            ) from killed
