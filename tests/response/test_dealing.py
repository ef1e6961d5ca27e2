"""Items are dealt out in bundles that last."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from vibroimpact.response import dealing
from vibroimpact.response.dealing import bundle, dealt


class Hands:
    """Workers that do a bundle when it is asked for, the last one first, each item in some time."""

    def __init__(self, seconds):
        self.seconds, self.sizes, self.bytes, self.waiting = seconds, [], [], []

    def take(self, function, task, items):
        self.sizes.append(len(pickle.loads(items)))
        self.bytes.append(len(items))
        self.waiting.append((function, task, items, len(self.sizes)))
        return len(self.sizes)

    def ready(self, taken):
        assert set(taken) == {one[-1] for one in self.waiting}
        return [self.waiting[-1][-1]]

    def result(self, taken):
        function, task, items, number = self.waiting.pop()
        assert number == taken
        return function(task, items)[0], self.seconds * self.sizes[number - 1]


def done(seconds, items, width=2, progress=None):
    hands = Hands(seconds)
    found = dealt(hands, width, lambda item, _: item, items, len(items), progress)
    assert len(found) == len(items)
    for one, item in zip(found, items, strict=True):
        np.testing.assert_array_equal(one, item)
    assert sum(hands.sizes) == len(items)
    return hands


def test_what_is_quick_goes_in_large_bundles():
    sizes = done(1e-3, range(10_000)).sizes
    assert sizes[:4] == [1, 1, 1, 1]  # nobody knows yet
    assert max(sizes) == 500  # half a second for two
    assert len(sizes) < 40


def test_the_last_bundles_are_small():
    sizes = done(1e-3, range(1000)).sizes
    assert max(sizes) == 249  # a quarter of what is left
    assert sizes[4:] == sorted(sizes[4:], reverse=True)
    assert sizes[-2] >= 500 / 8  # but not so small that they are quicker than a message


def test_what_is_slow_goes_alone():
    assert set(done(1.0, range(30)).sizes) == {1}


def test_many_workers_are_given_longer_bundles():
    assert max(done(0.01, range(100_000), width=40).sizes) == 1000


def test_heavy_items_travel_apart():
    hands = done(1e-3, [np.zeros(100_000) for _ in range(200)])
    assert 4 <= max(hands.sizes) <= 6
    assert max(hands.bytes) < 1.1 * dealing._MESSAGE


def test_progress_is_told_and_nothing_at_all_is_nothing():
    told = []
    done(1e-3, range(500), progress=lambda *at: told.append(at))
    assert told == sorted(told)
    assert told[-1] == (500, 500)
    assert done(1.0, []).sizes == []


def test_what_goes_wrong_there_goes_wrong_here():
    def task(item, _):
        raise ValueError(f"gap: {item}")

    with pytest.raises(ValueError, match="gap: 7"):
        dealt(Hands(1.0), 1, task, [7], 1, None)


def test_a_bundle_says_how_long_it_took():
    import time

    import cloudpickle

    task = cloudpickle.dumps(lambda item, tally: (time.sleep(item), list(tally)))
    found, seconds = bundle(task, cloudpickle.dumps([0.02, 0.03]))
    assert pickle.loads(found) == [(None, [0, 0])] * 2
    assert 0.05 <= seconds < 1.0
