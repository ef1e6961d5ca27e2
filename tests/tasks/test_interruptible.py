"""Long computations in short calls: the same to the last bit, and ended by Ctrl-C."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from engine.taylor.rigs import ISOLATORS, between
from samples import sample
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.prepared_rig import prepare
from vibroimpact.tasks.interruptible import Calls
from vibroimpact.tasks.threads import Stopped, each, watched

CYCLES = 12

RIG = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), right=vi.Bumper(10.0, 0.1, 0.5))
SHAKEN = vi.Harmonic(1.0, 0.2)


@pytest.mark.parametrize("isolator", sample([*ISOLATORS], [*ISOLATORS][::4]))
@pytest.mark.parametrize("shaken", ["sine", "record"])
def test_where_a_motion_is_cut_changes_no_bit(isolator, shaken, monkeypatch):
    one = between(isolator, "bumper", "hunt-crossley")
    noise = np.random.default_rng(0).normal(size=40)
    how = (
        (vi.Rig(one, vi.Harmonic(0.8, 0.15)), CYCLES, None, 8)
        if shaken == "sine"
        else (vi.Rig(one, vi.Record(noise, 0.4)), None, None, 2)
    )
    whole = vi.simulate(*how)
    monkeypatch.setattr(Calls, "end", lambda self, at: min(self._total, at + 1))
    xr.testing.assert_identical(vi.simulate(*how), whole)


@pytest.mark.parametrize("isolator", ISOLATORS)
def test_where_the_growth_of_disturbances_is_cut_changes_no_bit(isolator, monkeypatch):
    one = between(isolator, "bumper", "rigid")
    shaken = vi.Harmonic(0.8, 0.15)

    def rows():
        state = engine_state(one, vi.State())
        engine = prepare(vi.Rig(one, shaken))
        status, growth = engine.sections(state, CYCLES, transient=3, discard=5)
        return status, growth, state

    whole = rows()
    assert len(whole[1]) == CYCLES
    monkeypatch.setattr(Calls, "end", lambda self, at: min(self._total, at + 1))
    for was, now in zip(whole, rows(), strict=True):
        np.testing.assert_array_equal(now, was)


def test_a_motion_in_a_task_that_is_not_wanted_ends():
    def task(_, tally):
        tally[1] = 1
        vi.simulate(vi.Rig(RIG, SHAKEN), 1e12, samples=0)

    with pytest.raises(Stopped):
        each(task, [0], threads=1)


def test_what_a_task_waits_for_counts_no_step_of_it_and_ends_with_it():
    counts = []

    def part(tally):
        tally[0] += 5
        return tally[0]

    def task(item, tally):
        total = watched(part, 5)
        tally[0] += item
        return total

    assert each(task, [1, 2], steps=3, threads=1, progress=lambda *at: counts.append(at)) == [5, 5]
    assert counts[-1] == (3, 3)
    assert watched(part, 5, lambda *at: counts.append(at)) == 5
    assert counts[-1] == (5, 5)

    def unwanted(_, tally):
        tally[1] = 1
        watched(part, 5)

    with pytest.raises(Stopped):
        each(unwanted, [0], threads=1)


def test_tasks_of_a_task_end_with_it():
    ended = []

    def inner(item, tally):
        while not tally[1]:
            time.sleep(0.01)
        ended.append(item)

    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        each(lambda _, __: each(inner, [1, 2], threads=2), [0], progress=stop)
    assert sorted(ended) == [1, 2]


@pytest.mark.parametrize(
    "call",
    [
        lambda **how: vi.steady(vi.Rig(RIG, SHAKEN), max_cycles=2, exponent_cycles=400, **how),
        lambda **how: vi.seismic_response(
            vi.Rig(RIG, vi.Record(np.resize([1.0, -1.0], 400), 0.1)), **how
        ),
    ],
)
def test_progress_changes_nothing_and_ends_with_all(call):
    counts = []
    xr.testing.assert_identical(call(progress=lambda *at: counts.append(at)), call())
    assert counts
    assert all(0 <= done <= total for done, total in counts)
    assert counts[-1][0] == counts[-1][1]


def test_calls_grow_until_they_take_long_and_tell_how_far_they_are(monkeypatch):
    now, counts = [0.0], []
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    calls = Calls(10_000_000.5, lambda done, total: counts.append((done, total)))
    at, lengths = 0, []
    while at < 1_000_000:
        end = int(calls.end(at))
        lengths.append(end - at)
        now[0] += 1e-5 * (end - at)
        at = end
    assert lengths[:3] == [1, 8, 64]
    assert 0.05 <= 1e-5 * max(lengths) <= 0.8
    assert counts[0] == (1, 10_000_000)
    assert calls.end(10_000_000) == 10_000_000.5


LONG = [
    "vi.simulate(vi.Rig(rig, shaken), 3e8, samples=0)",
    "vi.simulate(vi.Rig(rig, vi.Record(np.resize([1.0, -1.0], 20_000_000), 0.1)), samples=0)",
    "vi.seismic_response(vi.Rig(rig, vi.Record(np.resize([1.0, -1.0], 20_000_000), 0.1)))",
    "vi.response_spectrum(vi.Record(np.resize([1.0, -1.0], 20_000_000), 0.1), range(1, 20))",
    "vi.sweep(vi.Rig(chaotic, shaken), [1.06], window=300_000_000)",
    "vi.lyapunov_exponents([vi.Rig(rig, shaken)], [0.2], 300_000_000)",
    "vi.steady(vi.Rig(chaotic, shaken), max_cycles=300_000_000)",
    "vi.steady(vi.Rig(chaotic, shaken), exponent_cycles=5_000_000)",
    "vi.design_chart(vi.Rig(weak, 0.5), {'gap': [0.01], 'frequency': (1, 1.5)}, step=0.99)",
]
"""Calls that take hours."""


# One in the daily run: each begins a process.
@pytest.mark.skipif(os.name != "posix", reason="sends an interrupt to a process")
@pytest.mark.parametrize("call", sample(LONG, LONG[::9]))
def test_ctrl_c_ends_what_takes_long(call):
    """Within 2 s of processor time."""
    code = f"""
        import os, signal, threading, time
        import numpy as np
        import vibroimpact as vi
        # A shell ignores the signal for what it starts in the background.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        sent = []
        interrupt = lambda: os.kill(os.getpid(), signal.SIGINT)
        rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), right=vi.Bumper(10.0, 0.1, 0.5))
        case = vi.laboratory.case("B3-10mm-A3")
        chaotic, shaken = case.oscillator, vi.Harmonic(case.amplitude, 1.06)
        weak = vi.Oscillator(1e4, vi.Isolator(1.0, 1e-3), right=vi.Bumper(1e9, 1.0, 0.01))
        record = vi.Record([0.0, 1.0], 0.1)
        vi.design_chart(vi.Rig(rig, 0.5), {{'gap': [0.1]}}, step=0.5)
        vi.simulate(vi.Rig(rig, shaken), 3)
        vi.simulate(vi.Rig(rig, record))
        vi.seismic_response(vi.Rig(rig, record))
        vi.response_spectrum(record, [1.0])
        vi.sweep(vi.Rig(rig, shaken), [0.2])
        vi.lyapunov_exponents([vi.Rig(rig, shaken)], [0.2], 10)
        vi.steady(vi.Rig(chaotic, shaken), exponent_cycles=10)
        # Work done from the interrupt on: what runs beside does not count, nor Python's exit.
        timer = threading.Timer(1.0, lambda: (sent.append(time.process_time()), interrupt()))
        timer.start()
        try:
            {call}
        except KeyboardInterrupt:
            print(time.process_time() - sent[0])
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)],
        capture_output=True,
        text=True,
        timeout=1200.0,
        check=True,
    )
    assert float(done.stdout) < 2.0
