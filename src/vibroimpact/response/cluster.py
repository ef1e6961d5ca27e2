"""The same tasks on a dask cluster; what a lost worker did is done again."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Collection, Sequence
from typing import Any, NamedTuple, TypeVar

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
        hands = _Hands(self.client)
        try:
            return dealt(hands, self.width(), task, items, total, progress)
        except OSError as lost:
            raise LostError(f"{_AWAY} ({lost})") from lost
        finally:
            if self.client.status == "running":
                self.client.cancel(list(hands.completed.futures))


class _Hands:
    def __init__(self, client: Any) -> None:
        self.client = client
        self.distributed: Any = importlib.import_module("distributed")
        # What was found is fetched while others compute.
        self.completed = self.distributed.as_completed(
            loop=client.loop, with_results=True, raise_errors=False
        )
        self.found: dict[Any, Any] = {}

    def take(self, function: Callable[..., Any], *arguments: Any) -> Any:
        future = self.client.submit(function, *arguments, pure=False)
        self.completed.add(future)
        return future

    def ready(self, taken: Collection[Any]) -> Collection[Any]:
        future, self.found[future] = next(self.completed)
        return [future]

    def result(self, taken: Any) -> Any:
        if taken.status == "cancelled":
            raise LostError(_AWAY)
        found = self.found.pop(taken)
        if taken.status == "finished":
            return found
        try:
            return taken.result()  # raises what went wrong
        except self.distributed.KilledWorker as killed:
            raise LostError(f"where: the cluster's workers die of a task ({killed})") from killed
