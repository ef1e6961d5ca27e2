"""Isolators that yield or slide: by tables as by Taylor steps, for random rigs."""

from __future__ import annotations

import math
import sys

import numpy as np
import pytest

import vibroimpact as vi
from engine.yielding.rigs import followed, random_rig, started, vectors
from samples import sample
from vibroimpact.engine.flow_dispatch import flow_of
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.state import ONE_MASS

SMALL = 1e-9
"""By which amplitude and phase are changed, to see how sensitive a motion is."""

SENSITIVE = 1e-7
"""A motion that changes by more is not compared."""


def compared(count: int, seed: int, several: bool) -> tuple[int, list[str]]:
    """How many motions could be compared over 8 cycles, and those that differ."""
    rng = np.random.default_rng(seed)
    seen, wrong = 0, []
    for number in range(count):
        rig, shaken = random_rig(rng, several)
        tables, taylor = vectors(rig, shaken)
        assert type(flow_of(tables)).__name__.startswith("Yielding")
        assert type(flow_of(taylor)).__name__.startswith("Curved")
        start = started(rig)
        outcome, ours, _, end = followed(tables, shaken, start)
        expected, theirs, _, last = followed(taylor, shaken, start)
        about = f"rig {number} of seed {seed}: {{}}; {rig!r}, {shaken!r}"
        if outcome != expected:
            wrong.append(about.format(f"outcomes {outcome} and {expected}"))
        if outcome or expected:
            continue
        u, v = theirs[record_layout.DISPLACEMENT], theirs[record_layout.VELOCITY]
        size = max(float(np.abs(u).max()), 1e-2)  # of motions that are all rest, too
        speed = max(float(np.abs(v).max()), size * math.tau * shaken.frequency)
        scale = np.array([[size], [speed], [size]])

        def rows(samples: np.ndarray, state: np.ndarray, scale: np.ndarray = scale) -> np.ndarray:
            memory = np.full(samples.shape[1], state[ONE_MASS.memory()])
            columns = samples[record_layout.DISPLACEMENT], samples[record_layout.VELOCITY], memory
            return np.array(columns) / scale

        error = float(np.abs(rows(ours, end) - rows(theirs, last)).max())
        moved = 0.0
        for share in (SMALL, -SMALL):
            result, disturbed, _, there = followed(taylor, shaken, start, share)
            if result:
                moved = math.inf
                break
            moved = max(moved, float(np.abs(rows(disturbed, there) - rows(theirs, last)).max()))
        if not moved < SENSITIVE:
            continue
        seen += 1
        # A chatter is completed by its geometric series, by how many impacts may differ.
        walls = any(isinstance(stop, vi.RigidStop) for stop in (rig.right, rig.left))
        if not error < (1e-10 if walls else 1e-12) * max(1.0, moved / SMALL):
            wrong.append(about.format(f"off by {error:.1e}, a disturbance by {moved:.1e}"))
    return seen, wrong


@pytest.mark.parametrize(
    ("several", "count"), [(False, sample(2000, 200)), (True, sample(500, 20))]
)
def test_tables_go_where_taylor_steps_go(several: bool, count: int) -> None:
    seen, wrong = compared(count, 5, several)
    assert not wrong, "\n".join(wrong)
    assert seen > 0.8 * count


if __name__ == "__main__":
    how_many, bad = compared(int(sys.argv[1]), int(sys.argv[2]), len(sys.argv) > 3)
    print(how_many, "compared;", len(bad), "differ")
    print("\n".join(bad))
