"""Items dealt out to workers elsewhere, as many at a time as take a while.

A message to a worker and back takes some milliseconds. Where an item takes less, many go in one
bundle: how many, those say that have come back. Towards the end bundles become smaller, so that
nobody waits long for the last. What travels is one piece of bytes each way: with hundreds of small
arrays, each in a frame of its own, a cluster is busier than with the tasks.
"""

from __future__ import annotations

import importlib
import pickle
import time
from collections.abc import Callable, Collection, Iterable, Sequence
from typing import Any, Protocol, TypeVar

from vibroimpact.tasks.threads import Progress, Tally, alone

_Item = TypeVar("_Item")
_Found = TypeVar("_Found")

_PROTOCOL = pickle.HIGHEST_PROTOCOL
_LASTS = 0.25
"""Seconds that a bundle takes for each worker there is, at most: progress is reported as often."""
_QUICK, _DEALT = 1 / 32, 1 / 250
"""Seconds that a bundle takes at least; and for each worker there is, since one deals to all."""
_GROWS = 8
"""How many times as many items a bundle has as the last that came back, at most."""
_MESSAGE = 5_000_000
"""Bytes of a bundle of more than one item, about, either way."""
_AHEAD = 2
"""Bundles that a worker has: one to do, and one so that it need not wait for the next."""
_AGAIN = 1.0
"""Seconds after which it is asked again how many workers there are: they come and go."""


class Hands(Protocol):
    """Workers as who deals sees them; a bundle is known by what `take` returns."""

    def width(self) -> int:
        """How many there are now."""
        ...

    def take(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Give somebody a call to do."""
        ...

    def ready(self, taken: Collection[Any]) -> Iterable[Any]:
        """Wait until some are done, and say which."""
        ...

    def result(self, taken: Any) -> Any:
        """What a call that is done returned; raises what it raised."""
        ...


def bundle(task: bytes, items: bytes) -> tuple[bytes, float]:
    """Do a task for some items; return the results, and the time that it took (s)."""
    begin = time.perf_counter()
    one = pickle.loads(task)
    results = [alone(one, item) for item in pickle.loads(items)]
    return pickle.dumps(results, _PROTOCOL), time.perf_counter() - begin


def distribute(
    hands: Hands,
    task: Callable[[_Item, Tally], _Found],
    items: Sequence[_Item],
    total: int,
    progress: Progress | None,
) -> list[_Found]:
    """Do a task for each item by some hands; the rest as `threads.each`."""
    results: list[Any] = [None] * len(items)
    taken: dict[Any, slice] = {}
    next_item = done = 0
    most = least = there = back = 1
    shared = importlib.import_module("cloudpickle").dumps(task)  # which may have no name
    width, asked = hands.width(), time.monotonic()
    while done < len(items):
        while next_item < len(items) and len(taken) < _AHEAD * width:
            # Of what is left everybody has twice, so that at the end nobody waits for long.
            part = max(least, -(-(len(items) - next_item) // (_AHEAD * width)))
            some = slice(next_item, min(next_item + min(part, most, there, back), len(items)))
            packed = pickle.dumps(items[some], _PROTOCOL)
            there = _light(some.stop - some.start, packed)
            taken[hands.take(bundle, shared, packed)] = some
            next_item = some.stop
        for one in hands.ready(taken):
            some = taken.pop(one)
            packed, seconds = hands.result(one)
            results[some] = pickle.loads(packed)
            count = some.stop - some.start
            back = _light(count, packed)
            rate = count / max(seconds, 1e-9)
            most = max(1, min(int(_LASTS * width * rate), _GROWS * count))
            least = int(max(_QUICK, _DEALT * width) * rate)
            done += count
            if progress:
                progress(done * total // len(items), total)
        if time.monotonic() - asked > _AGAIN:
            width, asked = hands.width(), time.monotonic()
    return results


def _light(count: int, packed: bytes) -> int:
    """How many such items a message takes."""
    return max(1, _MESSAGE * count // len(packed))
