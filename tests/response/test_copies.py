"""What a long computation keeps besides its result."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample

BUMPER = vi.Bumper(10.0, 0.1, 0.5)
# With both stops all that the engine writes is in the result.
RIG = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), BUMPER, BUMPER)
SHAKEN = vi.Harmonic(1.0, 0.2)


def history(length):
    return vi.simulate(vi.Rig(RIG, SHAKEN), 20 * length, samples=1)


def through_record(length):
    return vi.simulate(vi.Rig(RIG, vi.Record(np.resize([1.0, -1.0], 100 * length), 0.1)))


def sweeps(length):
    grid = np.linspace(0.1, 0.4, length)
    return vi.sweeps({"one": vi.Rig(RIG, SHAKEN), "two": vi.Rig(RIG, SHAKEN)}, grid, max_cycles=30)


def basins(length):
    return vi.basins(vi.Rig(RIG, SHAKEN), (-3.0, 3.0), (-3.0, 3.0), nodes=length)


@pytest.mark.parametrize(
    ("compute", "length", "most"),
    [
        (history, 4000, 2.0),
        *sample([(through_record, 3000, 1.75), (basins, 500, 4.0)], []),
        (sweeps, 5000, 2.0),
    ],
)
def test_results_are_not_kept_several_times(compute, length, most):
    compute(20)
    tracemalloc.start()
    data = compute(length)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    held = sum(one.values.nbytes for one in data.variables.values())
    # What does not grow with the result, such as the room for events, is left out.
    assert peak - 3e6 < most * held
