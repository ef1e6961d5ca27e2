"""Items are dealt out in bundles that last."""

from __future__ import annotations

import pickle
from types import SimpleNamespace

import numpy as np
import pytest

from vibroimpact.tasks import batching
from vibroimpact.tasks.batching import bundle, distribute


class Hands:
    """Workers with a clock of their own: the one who deals, and so many who do one after the other.

    What an item takes is told by a function of it; who deals and its worker lose what a message
    takes.
    """

    def __init__(self, seconds, width=2, message=0.0):
        self.seconds, self.workers, self.message = seconds, width, message
        self.sizes, self.bytes, self.lasted = [], [], []
        self.now, self.free, self.out = 0.0, [0.0] * width, {}

    def width(self):
        return self.workers

    def take(self, function, task, items):
        number, size = len(self.sizes), pickle.loads(items)
        self.sizes.append(len(size))
        self.bytes.append(len(items))
        lasts = sum(self.seconds(item) for item in size)
        self.lasted.append(lasts)
        self.now += self.message
        worker = self.free.index(min(self.free))
        self.free[worker] = max(self.free[worker], self.now) + self.message + lasts
        self.out[number] = self.free[worker], function, task, items
        return number

    def ready(self, taken):
        assert set(taken) == set(self.out)
        assert self.out
        return [min(self.out, key=lambda number: self.out[number][0])]

    def result(self, number):
        end, function, task, items = self.out.pop(number)
        self.now = max(self.now, end) + self.message
        return function(task, items)[0], self.lasted[number]


def done(seconds, items, width=2, progress=None, message=0.0, task=lambda item, _: item):
    each = seconds if callable(seconds) else lambda _: seconds
    hands = Hands(each, width, message)
    results = distribute(hands, task, items, len(items), progress)
    assert len(results) == len(items)
    for one, item in zip(results, items, strict=True):
        np.testing.assert_array_equal(one, task(item, None))
    assert sum(hands.sizes) == len(items)
    return hands


def test_what_is_quick_goes_in_large_bundles():
    sizes = done(1e-3, range(10_000)).sizes
    assert sizes[:4] == [1, 1, 1, 1]  # nobody knows yet
    assert 490 <= max(sizes) <= 500  # half a second for two
    assert len(sizes) < 45


def test_the_last_bundles_are_small_but_take_longer_than_a_message():
    hands = done(1e-3, range(4000))
    assert hands.sizes[-8:] == sorted(hands.sizes[-8:], reverse=True)
    assert 0.03 < hands.lasted[-2] < 0.05


def test_what_is_slow_goes_alone():
    assert set(done(1.0, range(30)).sizes) == {1}


def test_a_few_quick_ones_say_little_of_the_rest():
    hands = done(lambda item: 1e-4 if item < 8 else 1.0, range(200))
    assert max(hands.sizes) <= 8
    assert hands.now < 115.0


@pytest.mark.parametrize(
    ("width", "number", "seconds", "longer"),
    [(2, 400, 0.009, 1.1), (16, 400, 0.009, 1.5), (64, 2000, 0.02, 1.7), (128, 5000, 1.0, 1.1)],
)
def test_all_workers_have_something_to_do(width, number, seconds, longer):
    hands = done(seconds, range(number), width, message=1e-3)
    assert hands.now < longer * number * seconds / width


def test_heavy_items_travel_apart():
    hands = done(1e-3, [np.zeros(100_000) for _ in range(200)])
    assert 4 <= max(hands.sizes) <= 6
    assert max(hands.bytes) < 1.1 * batching._MESSAGE


def test_what_is_heavy_on_the_way_back_goes_in_small_bundles():
    hands = done(1e-3, range(200), task=lambda item, _: np.full(100_000, item))
    assert max(hands.sizes[4:]) <= 6


def test_those_who_come_later_are_given_something(monkeypatch):
    clock = iter(np.arange(0.0, 1000.0, 0.6))
    monkeypatch.setattr(batching, "time", SimpleNamespace(monotonic=lambda: next(clock)))
    hands = Hands(lambda _: 1.0, 4)
    hands.workers, most = 1, 0

    def task(item, _):
        return item

    take = hands.take

    def counted(*words):
        nonlocal most
        most = max(most, 1 + len(hands.out))
        if len(hands.sizes) == 3:
            hands.workers = 4
        return take(*words)

    hands.take = counted
    monkeypatch.setattr(batching, "bundle", _bundle)
    assert distribute(hands, task, range(40), 40, None) == list(range(40))
    assert most == 8


def _bundle(task, items):
    one = pickle.loads(task)
    return pickle.dumps([one(item, None) for item in pickle.loads(items)]), 0.0


def test_progress_is_told_and_nothing_at_all_is_nothing():
    counts = []
    done(1e-3, range(500), progress=lambda *at: counts.append(at))
    assert counts == sorted(counts)
    assert counts[-1] == (500, 500)
    assert done(1.0, []).sizes == []


def test_what_goes_wrong_there_goes_wrong_here():
    def task(item, _):
        raise ValueError(f"gap: {item}")

    with pytest.raises(ValueError, match="gap: 7"):
        distribute(Hands(lambda _: 1.0), task, [7], 1, None)


def test_a_bundle_says_how_long_it_took():
    import time

    import cloudpickle

    task = cloudpickle.dumps(lambda item, tally: (time.sleep(item), list(tally)))
    packed, seconds = bundle(task, cloudpickle.dumps([0.02, 0.03]))
    assert pickle.loads(packed) == [(None, [0, 0, 0])] * 2
    assert 0.05 <= seconds < 1.0
