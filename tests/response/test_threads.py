"""Tasks on threads: all run, progress counts up, and Ctrl-C stops them."""

from __future__ import annotations

import threading

import numpy as np
import pytest

from vibroimpact.response.threads import available, run


@pytest.mark.parametrize("threads", [1, 3, None])
def test_each_task_runs_once(threads):
    counter, done, told = np.zeros((20, 2), dtype=np.int64), [], []

    def task(number: int) -> None:
        done.append(number)
        counter[number, 0] = 1

    run(task, counter, 20, threads, lambda *at: told.append(at))
    assert sorted(done) == list(range(20))
    assert told == sorted(told)
    assert told[-1] == (20, 20)
    assert available() >= 1


def test_a_stop_reaches_the_tasks_that_run():
    counter = np.zeros((4, 2), dtype=np.int64)
    begun = threading.Event()

    def task(number: int) -> None:
        begun.set()
        while not counter[number, 1]:
            threading.Event().wait(0.01)

    def stop(done: int, total: int) -> None:
        begun.wait()
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(task, counter, 4, 2, stop)
    assert counter[:, 1].all()


def test_a_task_that_fails_is_told():
    def task(number: int) -> None:
        raise ValueError(number)

    with pytest.raises(ValueError, match="0"):
        run(task, np.zeros((1, 2), dtype=np.int64), 1, 1, None)
