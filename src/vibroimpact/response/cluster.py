"""The same tasks on a dask cluster; what a lost worker did is done again."""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.model.counts import whole
from vibroimpact.model.units import shown
from vibroimpact.response.threads import Progress, Tally, Workers

_Item = TypeVar("_Item")
_Found = TypeVar("_Found")

THREADS = "threads"
"""This process's own."""
_PATIENCE = "10s"
"""For a scheduler to answer."""
_TOGETHER = 64
"""Tasks in one message to the scheduler."""
_AWAY = "where: the cluster went away; the same call completes what it has in a store"
_MARKS = ("tcp://", "tls://", "ucx://", "ws://", "wss://", "inproc://")


class LostError(InputError):
    """The scheduler of a cluster went away, or its workers died again and again."""


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

        futures = self.client.map(
            _alone, [task] * len(items), items, pure=False, batch_size=_TOGETHER
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


def _alone(task: Callable[[_Item, Tally], _Found], item: _Item) -> _Found:
    """A task where nobody stops it; its tally stays there."""
    return task(item, np.zeros(2, dtype=np.int64))


def placed(threads: int | None, where: Any = THREADS) -> Workers:
    """Where tasks are done: so many threads, or a dask cluster.

    Parameters
    ----------
    threads
        How many; None for one a processor.
    where
        ``"threads"``, a `distributed.Client`, or a scheduler's address such as
        ``"tcp://10.0.0.1:8786"``.

    Raises
    ------
    InputError
        If there is no such cluster, or dask is not installed.
    """
    if isinstance(where, str) and where == THREADS:
        return None if threads is None else whole(threads, "threads")
    if threads is not None:
        raise InputError(f"threads: {threads}; on a cluster its workers say how many there are")
    if importlib.util.find_spec("distributed") is None:
        raise InputError(
            f"where: {shown(where)} needs dask, which is not installed: "
            "pip install 'vibroimpact[cluster]'"
        )
    client = importlib.import_module("distributed").Client
    if isinstance(where, client):
        return Cluster(where)
    if not (isinstance(where, str) and where.startswith(_MARKS)):
        raise InputError(
            f"where: {shown(where)}; 'threads', a dask Client, or the address of a scheduler such "
            "as tcp://10.0.0.1:8786 is accepted"
        )
    try:
        return Cluster(client(where, timeout=_PATIENCE, set_as_default=False))
    except (OSError, ValueError) as error:
        raise InputError(f"where: no scheduler answers at {where} ({error})") from error
