"""A stretch in pieces: they cover it without a gap, and each is the motion itself."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import absolute_acceleration, horner
from vibroimpact.engine.linear.layout import PLAN, H
from vibroimpact.engine.linear.pieces import (
    accelerated,
    begin,
    displacement,
    expanded,
    has_piece,
    middle,
    next_piece,
)
from vibroimpact.engine.linear.tables import build
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import RIGHT, Motion
from vibroimpact.engine.parameters import SIZE
from vibroimpact.engine.state import FLIGHT
from vibroimpact.response.engine_system import engine_rig

FREQUENCY, PHASE = 0.2, 0.7


@kernel
def laid_out(plan: Vector, motion: Motion, length: float, out: Vector) -> int:
    """Of each piece its start, its end, u and the speed there, and two errors of its series."""
    series = workspace()
    n = 0
    cursor = begin(plan, motion, length)
    while has_piece(plan, cursor):
        h = plan[cursor.table + H]
        high, s, c = expanded(plan, cursor, series)
        x, v = horner(series, high)
        start = cursor.t + cursor.i * h
        out[n, 0], out[n, 1] = start, start + (high + 0.5) * h
        out[n, 2], out[n, 3] = displacement(plan, motion.mode, x), v / h
        row = middle(plan, cursor)
        unit = accelerated(plan, cursor, s, c, series)
        a = absolute_acceleration(plan, motion.mode, row)
        out[n, 4] = series[0] * unit - a
        n += 1
        cursor = next_piece(plan, cursor)
    return n


def check(rig: vi.Oscillator, amplitude: float, motion: Motion, length: float) -> np.ndarray:
    plan, out = np.zeros(PLAN), np.empty((5000, 5))
    plan[:SIZE] = engine_rig(vi.Rig(rig, vi.Harmonic(1.0, 1.0)))
    build(plan, amplitude, math.tau * FREQUENCY)
    pieces = out[: laid_out(plan, motion, length, out)]
    starts, ends = pieces[:, 0], pieces[:, 1]
    assert starts[0] == 0.0
    np.testing.assert_allclose(starts[1:], ends[:-1], rtol=1e-13)
    assert ends[-1] == pytest.approx(length, rel=1e-13)
    assert (ends - starts).sum() == pytest.approx(length, rel=1e-12)
    assert abs(pieces[:, 4]).max() < 1e-12
    start = vi.State(motion.u, motion.v, contact=1 if motion.mode == RIGHT else 0)
    shaken = vi.Harmonic(amplitude, FREQUENCY, PHASE)
    for _, end, u, v, _ in pieces[:: max(1, len(pieces) // 10)]:
        final = vi.simulate(vi.Rig(rig, shaken), end * FREQUENCY, start, samples=0)["final_state"]
        assert (u, v) == pytest.approx(tuple(final.values[:2]), abs=1e-12)
    return pieces


CLOCK = (math.sin(PHASE), math.cos(PHASE))


def test_flight_over_several_windows() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1))
    pieces = check(rig, 0.6, Motion(FLIGHT, 0, 0.3, -0.2, (0.0, 0.0), 0.0, 0.0, CLOCK), 37.3)
    assert len(pieces) > 3 * 16


def test_a_contact_whose_fast_part_dies_out() -> None:
    """The steps become much longer once the late table holds."""
    stop = vi.Bumper(200.0, 200.0, -0.5)  # preloaded: it stays pressed
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop)
    motion = Motion(RIGHT, 0, -0.4, 0.1, (0.1, 0.0), 0.0, 0.0, CLOCK)
    pieces = check(rig, 0.1, motion, 3.0)
    steps = pieces[:, 1] - pieces[:, 0]
    assert steps[-2] > 20.0 * steps[0]
