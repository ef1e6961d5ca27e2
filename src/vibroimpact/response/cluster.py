"""The same tasks on a dask cluster; what a lost worker did is done again."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Collection, Sequence
from typing import Any, NamedTuple, TypeVar

from vibroimpact.errors import InputError
from vibroimpact.response.dealing import dealt
from vibroimpact.response.threads import LostError, Progress, Tally

_Item = TypeVar("_Item")
_Found = TypeVar("_Found")

_AWAY = "where: the cluster went away; the same call completes what it has in a store"


class Cluster(NamedTuple):
    """Where tasks are done in the place of threads."""

    client: Any
    """A `distributed.Client`."""

    def width(self) -> int:
        """How many tasks it does at once."""
        return max(1, sum(int(n) for n in self.client.nthreads().values()))

    def each(
        self,
        task: Callable[[_Item, Tally], _Found],
        items: Sequence[_Item],
        total: int,
        progress: Progress | None,
    ) -> list[_Found]:
        """As `threads.each`; the tasks and what they find travel."""
        hands = _Hands(self)
        try:
            return dealt(hands, task, items, total, progress)
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
        return [next(self.completed)]

    def result(self, taken: Any) -> Any:
        if taken.status == "cancelled":
            raise LostError(_AWAY)
        try:
            return taken.result()
        except self.distributed.KilledWorker as killed:
            raise LostError(f"where: the cluster's workers die of a task ({killed})") from killed
