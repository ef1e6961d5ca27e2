"""On processes everything is as on threads; one that dies is told, and no process is left."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from loky import get_reusable_executor

import vibroimpact as vi
from vibroimpact.response.processes import Processes, may_start
from vibroimpact.response.threads import LostError, each

TWO = Processes(2)


def _alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def _ended(pid, patience=10.0):
    end = time.monotonic() + patience
    while _alive(pid) and time.monotonic() < end:
        time.sleep(0.05)
    return not _alive(pid)


def test_each_item_once_and_in_order():
    told, power = [], 2
    found = each(
        lambda item, _: (item**power, os.getpid()),  # a task need not have a name
        range(20),
        threads=TWO,
        progress=lambda *at: told.append(at),
    )
    assert [value for value, _ in found] == [i**2 for i in range(20)]
    assert os.getpid() not in {pid for _, pid in found}
    assert told == sorted(told)
    assert told[-1] == (20, 20)


def test_the_same_processes_serve_again():
    first, second = (
        {pid for _, pid in each(lambda i, _: (i, os.getpid()), range(8), threads=TWO)}
        for _ in range(2)
    )
    assert first & second


def test_what_a_task_raises_is_raised_here():
    def task(item, _):
        if item == 3:
            raise vi.InputError("gap: 3")
        return item

    with pytest.raises(vi.InputError, match="gap: 3"):
        each(task, range(6), threads=TWO)
    assert each(lambda item, _: item, range(3), threads=TWO) == [0, 1, 2]


def test_no_more_processes_than_tasks(monkeypatch):
    asked = []

    def executor(**how):
        asked.append(how["max_workers"])
        return get_reusable_executor(**how)

    monkeypatch.setattr("loky.get_reusable_executor", executor)
    for tasks in (1, 3):
        assert each(lambda i, _: i, range(tasks), threads=TWO) == list(range(tasks))
    assert asked == [1, 2]


def test_a_daemon_may_start_none(monkeypatch):
    assert may_start()
    monkeypatch.setitem(multiprocessing.current_process()._config, "daemon", True)
    assert not may_start()


def test_a_process_that_dies_is_told_and_others_are_started():
    def task(item, _):
        if item == 1:
            os.kill(os.getpid(), signal.SIGKILL)
        return item

    with pytest.raises(LostError, match="where: a process died"):
        each(task, range(4), threads=TWO)
    assert each(lambda item, _: item, range(3), threads=TWO) == [0, 1, 2]


def test_ctrl_c_leaves_no_process():
    pids = set(each(lambda _, __: os.getpid(), range(8), threads=TWO))

    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        each(lambda item, _: time.sleep(5.0 * (item > 0)), range(4), threads=TWO, progress=stop)
    assert all(_ended(pid) for pid in pids)


def test_sweeps():
    grid = np.linspace(0.5, 3.0, 30)
    rigs = {"one": "B2-G1-A3", "two": "B3-G2-A2", "three": "B1-G1-A3"}
    there = vi.sweeps(rigs, grid, threads=2, where="processes")
    assert there.identical(vi.sweeps(rigs, grid))


def test_a_script_needs_no_guard(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "import vibroimpact as vi\n"
        "print('once')\n"
        "data = vi.sweeps(['B2-G1-A3'], [1.0, 2.0], threads=2, where='processes')\n"
        "print(data.sizes['frequency'])\n"
    )
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True)
    assert done.stdout == "once\n2\n"
