"""Starts at rest against a bumper: flight or contact is decided by the motion, not by rounding."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi

TOUCHING = [
    (0.02, None, (268.7131124355074, 0.0, 0.0), 0.3797512092380264 / (2 * math.pi), 0.0, 0.0),
    (
        1.4341476955165586,
        None,
        (4.126022893917573, 1.0949517361569958, 0.0),
        0.030616506338048743,
        math.pi,
        0.0,
    ),
    (
        2 * 1.6720681709800806,
        (0.1547974297044751, 0.0, 0.3),
        None,
        0.019601520309708603,
        math.pi - math.asin(-0.3),
        0.3,
    ),
]


@pytest.mark.parametrize(("damping", "right", "left", "frequency", "phase", "at"), TOUCHING)
def test_no_chatter_at_the_start(damping, right, left, frequency, phase, at) -> None:
    bumpers = [None if b is None else vi.Bumper(*b) for b in (right, left)]
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, damping), *bumpers)
    motion = vi.simulate(
        vi.Rig(rig, vi.Harmonic(1.0, frequency, phase)), 3, vi.State(at), samples=8
    )
    assert motion["status"] == 0
    assert motion.sizes["event"] < 100


def test_random_rest_starts_without_gaps() -> None:
    rng = np.random.default_rng(5)
    for i in range(400):
        bumpers = [
            vi.Bumper(
                10.0 ** rng.uniform(-2, 4), rng.choice([0.0, 10.0 ** rng.uniform(-2, 1)]), 0.0
            )
            if rng.random() < 0.7
            else None
            for _ in range(2)
        ]
        rig = vi.Oscillator(1.0, vi.Isolator(1.0, 10.0 ** rng.uniform(-2, 0.5)), *bumpers)
        shaken = vi.Harmonic(1.0, 10.0 ** rng.uniform(-1.5, 0.3), rng.choice([0.0, math.pi]))
        motion = vi.simulate(vi.Rig(rig, shaken), 1, samples=0, max_events=2000)
        assert motion["status"] == 0, (i, rig, shaken)
