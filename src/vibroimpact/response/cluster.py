"""The same tasks on a dask cluster; what a lost worker did is done again."""

from __future__ import annotations

import importlib
import pickle
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeVar

from vibroimpact.response.threads import LostError, Progress, Tally, alone

_Item = TypeVar("_Item")
_Found = TypeVar("_Found")

_TOGETHER = 64
"""Tasks in one message to the scheduler, at most."""
_MESSAGE = 5_000_000
"""Bytes of one, about: the scheduler warns of ten million."""
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
        distributed: Any = importlib.import_module("distributed")

        together = min(_TOGETHER, 1 + _MESSAGE // len(pickle.dumps(items[0])))
        futures = self.client.map(
            alone, [task] * len(items), items, pure=False, batch_size=together
        )
        try:
            finished = distributed.as_completed(futures, loop=self.client.loop)
            for done, future in enumerate(finished, 1):
                if future.status != "finished":
                    _raise(future)
                if progress:
                    progress(done * total // len(items), total)
            return list(self.client.gather(futures))
        except OSError as lost:
            raise LostError(f"{_AWAY} ({lost})") from lost
        finally:
            if self.client.status == "running":
                self.client.cancel(futures)


def _raise(future: Any) -> None:
    """Raise what a task ended with."""
    if future.status == "cancelled":
        raise LostError(_AWAY)
    try:
        future.result()
    except importlib.import_module("distributed").KilledWorker as killed:
        raise LostError(f"where: the cluster's workers die of a task ({killed})") from killed
