"""On processes everything is as on threads; one that dies is told, and no process is left."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import numpy as np
import pytest
from loky import get_reusable_executor

import vibroimpact as vi
from samples import sample
from vibroimpact.tasks.processes import Processes, may_start
from vibroimpact.tasks.threads import LostError, each

TWO = Processes(2)


def _alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def _ended(pid, patience=30.0):
    end = time.monotonic() + patience
    while _alive(pid) and time.monotonic() < end:
        time.sleep(0.05)
    return not _alive(pid)


def test_each_item_once_and_in_order():
    counts, power = [], 2
    pairs = each(
        lambda item, _: (item**power, os.getpid()),  # a task need not have a name
        range(20),
        threads=TWO,
        progress=lambda *at: counts.append(at),
    )
    assert [value for value, _ in pairs] == [i**2 for i in range(20)]
    assert os.getpid() not in {pid for _, pid in pairs}
    assert counts == sorted(counts)
    assert counts[-1] == (20, 20)


def test_the_same_processes_serve_again():
    pids = {pid for _ in range(3) for pid in each(lambda *_: os.getpid(), range(8), threads=TWO)}
    assert len(pids) <= 2


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


def _children(pid):
    """Processes that this one has started, and those which they have."""
    children = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            number, rest = path.read_text().split(" (", 1)
            state, parent = rest.rsplit(") ", 1)[1].split()[:2]
            if int(parent) == pid and state != "Z":
                children += [int(number), *_children(int(number))]
    return children


def _runs(pid):
    """Whether a process lives; one that has ended may wait for who started it to take note."""
    with contextlib.suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rsplit(") ", 1)[1][0] != "Z"
    return False


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
@pytest.mark.parametrize(
    ("sent", "code", "how"),
    [
        ("SIGTERM", -signal.SIGTERM, "script"),  # a shell says 128 + 15 = 143
        ("SIGKILL", -signal.SIGKILL, "script"),
        ("SIGTERM", 143, "command"),
    ],
)
def test_no_process_outlives_what_started_it(tmp_path, sent, code, how):
    script = tmp_path / "script.py"
    end = (
        "vi.basins(vi.Rig(rig, shaken), (-3, 3), (-3, 3), nodes=3000, where='processes', threads=2)"
    )
    if how == "command":
        end = (
            "main(['basins', 'B3-10mm-A3', '--frequency', '1.06Hz', '--nodes', '3000',"
            f" '--where', 'processes', '--threads', '2', '--output', {str(tmp_path)!r}])"
        )
        end = f"raise SystemExit({end})"
    script.write_text(
        textwrap.dedent(f"""
            import vibroimpact as vi
            from vibroimpact.cli import main
            from vibroimpact.tasks.threads import each
            from vibroimpact.tasks.processes import Processes
            case = vi.laboratory.case("B3-10mm-A3")
            rig, shaken = case.oscillator, vi.Harmonic(case.amplitude, 1.06)
            each(lambda item, _: item, range(4), threads=Processes(2))
            print("begun", flush=True)
            {end}
        """)
    )
    with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "begun\n"
        time.sleep(sample(3.0, 1.0))
        assert process.poll() is None
        children = _children(process.pid)
        assert len(children) >= 2
        process.send_signal(getattr(signal, sent))
        assert process.wait(30.0) == code
        end = time.monotonic() + 30.0
        while any(map(_runs, children)) and time.monotonic() < end:
            time.sleep(0.05)
        assert not any(map(_runs, children))
        # The script needs no guard: no process has run it again.
        assert process.stdout.read() == ""


def test_sweeps():
    grid = np.linspace(0.5, 3.0, 30)
    rigs = {"one": "B2-G1-A3", "two": "B3-G2-A2", "three": "B1-G1-A3"}
    there = vi.sweeps(rigs, grid, threads=2, where="processes")
    assert there.identical(vi.sweeps(rigs, grid))
