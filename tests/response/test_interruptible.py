"""Long computations in short calls: the same to the last bit, and ended by Ctrl-C."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from engine.taylor.rigs import ISOLATORS, between
from vibroimpact.response.interruptible import Calls

CYCLES = 12


@pytest.mark.parametrize("isolator", ISOLATORS)
@pytest.mark.parametrize("shaken", ["sine", "record"])
def test_where_a_motion_is_cut_changes_no_bit(isolator, shaken, monkeypatch):
    one = between(isolator, "bumper", "hunt-crossley")
    noise = np.random.default_rng(0).normal(size=40)
    how = (
        (vi.Harmonic(0.8, 0.15), CYCLES, None, 8)
        if shaken == "sine"
        else (vi.Record(noise, 0.4), None, None, 2)
    )
    whole = vi.simulate(one, *how)
    monkeypatch.setattr(Calls, "end", lambda self, at: min(self._total, at + 1))
    xr.testing.assert_identical(vi.simulate(one, *how), whole)


def test_calls_grow_until_they_take_long_and_tell_how_far_they_are(monkeypatch):
    now, told = [0.0], []
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    calls = Calls(10_000_000.5, lambda done, total: told.append((done, total)))
    at, lengths = 0, []
    while at < 1_000_000:
        end = int(calls.end(at))
        lengths.append(end - at)
        now[0] += 1e-5 * (end - at)
        at = end
    assert lengths[0] == 256
    assert 0.05 <= 1e-5 * max(lengths) <= 0.8
    assert told[0] == (256, 10_000_000)
    assert calls.end(10_000_000) == 10_000_000.5


@pytest.mark.skipif(os.name != "posix", reason="sends an interrupt to a process")
@pytest.mark.parametrize(
    "call",
    [
        "vi.simulate(rig, shaken, 3e8, samples=0)",
        "vi.simulate(rig, vi.Record(np.resize([1.0, -1.0], 20_000_000), 0.1), samples=0)",
    ],
)
def test_ctrl_c_ends_what_takes_long(call):
    code = f"""
        import time
        import numpy as np
        import vibroimpact as vi
        rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), right=vi.Bumper(10.0, 0.1, 0.5))
        shaken = vi.Harmonic(1.0, 0.2)
        vi.simulate(rig, shaken, 3)
        vi.simulate(rig, vi.Record([0.0, 1.0], 0.1))
        print("begun", flush=True)
        try:
            {call}
        except KeyboardInterrupt:
            print("ended")
    """
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "begun\n"
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=60.0)
    assert output == "ended\n"
    assert process.returncode == 0
