"""Tasks on threads: each item once, in order, progress counts up, and Ctrl-C stops them."""

from __future__ import annotations

import threading

import pytest

from vibroimpact.tasks.threads import available, each


@pytest.mark.parametrize("threads", [1, 3, None])
def test_each_item_once_and_in_order(threads):
    counts = []
    squares = each(
        lambda item, _: item**2,
        range(20),
        threads=threads,
        progress=lambda *at: counts.append(at),
    )
    assert squares == [i**2 for i in range(20)]
    assert counts == sorted(counts)
    assert counts[-1] == (20, 20)
    assert available() >= 1
    assert each(lambda item, _: item, []) == []


def test_tasks_count_steps_of_their_own():
    counts = []

    def task(item, tally):
        tally[0] += item

    each(task, [1, 2, 3], steps=6, progress=lambda *at: counts.append(at))
    assert counts[-1] == (6, 6)


def test_a_stop_reaches_the_tasks_that_run():
    begun, seen = threading.Event(), []

    def task(item, tally):
        begun.set()
        while not tally[1]:
            threading.Event().wait(0.01)
        seen.append(item)

    def stop(done: int, total: int) -> None:
        begun.wait()
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        each(task, range(4), threads=2, progress=stop)
    assert seen
    assert len(seen) <= 2  # the others never began


@pytest.mark.parametrize("progress", [None, lambda done, total: None])
def test_a_task_that_fails_is_told_and_ends_the_others(progress):
    ended = []

    def task(item, tally):
        if item == 0:
            raise ValueError("the first")
        while not tally[1]:
            threading.Event().wait(0.01)
        ended.append(item)

    with pytest.raises(ValueError, match="the first"):
        each(task, [1, 0], threads=2, progress=progress)
    assert ended == [1]
