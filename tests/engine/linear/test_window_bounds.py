"""The bounds on the pieces of a window hold, say something, and come with values that are met."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import horner
from vibroimpact.engine.linear.layout import PLAN
from vibroimpact.engine.linear.pieces import (
    accelerated,
    begin,
    expanded,
    expanded_force,
    has_piece,
    middle,
    next_piece,
)
from vibroimpact.engine.linear.tables import build
from vibroimpact.engine.linear.window_bounds import (
    NOWHERE,
    Enclosed,
    bound_window,
    chords,
    enclosed,
)
from vibroimpact.engine.memory import workspace
from vibroimpact.engine.motion import LEFT, RIGHT, Motion
from vibroimpact.engine.parameters import SIZE
from vibroimpact.engine.state import FLIGHT
from vibroimpact.response.engine_system import engine_rig

FREQUENCY = 0.2
QUANTITIES = 3
"""Coordinate, acceleration in space, force."""


@kernel
def looked_at(plan: Vector, motion: Motion, length: float, first: Enclosed, out: Vector) -> int:
    """Of each piece and quantity the samples' least and most, the bounds, and what was seen."""
    series, buffer = workspace(), chords()
    n = 0
    within, seen = False, first
    cursor = begin(plan, motion, length)
    while has_piece(plan, cursor):
        if cursor.i == 0:
            within, seen = bound_window(plan, cursor, motion, seen, buffer)
        held = seen if within else enclosed(plan, cursor, buffer)
        bounds = held.x_least, held.x_most, held.a_least, held.a_most, -math.inf, held.force
        noted = seen.x_least, seen.x_most, seen.a_least, seen.a_most, -math.inf, seen.force
        for part in range(QUANTITIES):
            high, s, c = expanded(plan, cursor, series)
            unit = 1.0
            if part == 1:
                unit = accelerated(plan, cursor, s, c, series)
            elif part == 2:
                if motion.mode == FLIGHT:
                    break
                expanded_force(plan, cursor, motion.mode, motion.mode - 1, series)
            least, most = math.inf, -math.inf
            for k in range(9):
                y, _ = horner(series, -0.5 + k * (high + 0.5) / 8.0)
                least, most = min(least, y * unit), max(most, y * unit)
            at = out[n, part]
            at[0], at[1], at[2], at[3] = least, most, bounds[2 * part], bounds[2 * part + 1]
            at[4], at[5], at[6] = noted[2 * part], noted[2 * part + 1], within
        n += 1
        cursor = next_piece(plan, cursor)
    return n


def pieces_of(mode: int, damping: float, rng: np.random.Generator, first: Enclosed) -> np.ndarray:
    """Of a motion that begins anywhere: shape (piece, quantity, column)."""
    stop = vi.Bumper(200.0, damping, -0.5)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), *(stop if mode == m else None for m in (1, 2)))
    plan, out = np.zeros(PLAN), np.zeros((5000, QUANTITIES, 7))
    plan[:SIZE] = engine_rig(vi.Rig(rig, vi.Harmonic(1.0, 1.0)))
    frequency, phase = FREQUENCY * rng.uniform(0.2, 5.0), rng.uniform(0.0, math.tau)
    build(plan, rng.uniform(0.1, 3.0), math.tau * frequency)
    u, v = rng.normal(size=2)
    pressed = abs(rng.normal()) if mode else 0.0
    clock = math.sin(phase), math.cos(phase)
    motion = Motion(mode, 0, u, v, (pressed, pressed), 0.0, 0.0, clock)
    return out[: looked_at(plan, motion, rng.uniform(0.01, 6.0), first, out)]


CASES = [(mode, damping) for mode in (FLIGHT, RIGHT, LEFT) for damping in (0.0, 0.5, 200.0)]


@pytest.mark.parametrize(("mode", "damping"), CASES)
def test_a_piece_lies_within_its_bounds(mode: int, damping: float) -> None:
    rng = np.random.default_rng(3 * mode + int(damping))
    loose = []
    for _ in range(sample(60, 6)):
        pieces = pieces_of(mode, damping, rng, NOWHERE)
        least, most, low, high, *_ = np.moveaxis(pieces, 2, 0)
        size = 1e-12 * np.maximum(abs(least), abs(most)).max(axis=0)
        assert (low <= least + size).all()
        assert (most <= high + size).all()
        whole = most[:, 0].max() - least[:, 0].min()
        asked = pieces[:, 0, 6] == 0.0
        loose.append(np.mean((high - low - (most - least))[asked, 0]) / whole)
    assert np.median(loose) < 0.05  # they say something


@pytest.mark.parametrize(("mode", "damping"), CASES)
def test_what_was_seen_was_met(mode: int, damping: float) -> None:
    rng = np.random.default_rng(5 * mode + int(damping))
    for _ in range(sample(60, 6)):
        pieces = pieces_of(mode, damping, rng, NOWHERE)
        for part in range(2 if mode == FLIGHT else QUANTITIES):
            seen_least, seen_most = pieces[-1, part, 4:6]
            least, most = pieces[:, part, 0].min(), pieces[:, part, 1].max()
            size = 1e-12 * max(abs(least), abs(most))
            assert seen_most <= most + size
            assert part == 2 or seen_least >= least - size


@pytest.mark.parametrize(("mode", "damping"), CASES)
def test_a_window_that_is_passed_over_lies_within_what_was_seen(mode: int, damping: float) -> None:
    rng = np.random.default_rng(7 * mode + int(damping))
    passed = 0
    for _ in range(sample(200, 16)):
        reach = np.exp(rng.uniform(-1.0, 6.0, 3))
        first = Enclosed(-reach[0], reach[0], -reach[1], reach[1], reach[2])
        pieces = pieces_of(mode, damping, rng, first)
        for part in range(2 if mode == FLIGHT else QUANTITIES):
            least, most, low, high, _, _, within = pieces[:, part].T
            over = within == 1.0
            assert (most[over] <= high[over]).all()
            assert part == 2 or (least[over] >= low[over]).all()
            passed += over.sum()
    assert passed > sample(20, 0)


@kernel
def middle_of(plan: Vector, motion: Motion, out: Vector) -> None:
    """Displacement and velocity in the middle of the first piece of a flight, and the clock's."""
    row = middle(plan, begin(plan, motion, 1.0))
    out[0], out[1], out[2], out[3] = row


@pytest.mark.parametrize("phase", np.linspace(0.1, 6.2, 12))
def test_a_piece_that_turns_twice_is_not_taken_for_one_that_only_rises(phase: float) -> None:
    """In its middle there is no acceleration and a velocity against those at both its ends."""
    amplitude, omega, k, c = 1.0, 1.3, 1.0, 0.1
    rig = vi.Oscillator(1.0, vi.Isolator(k, c))
    plan, out = np.zeros(PLAN), np.zeros((5000, QUANTITIES, 7))
    plan[:SIZE] = engine_rig(vi.Rig(rig, vi.Harmonic(1.0, 1.0)))
    build(plan, amplitude, omega)
    clock = math.sin(phase), math.cos(phase)

    def reached(u: float, v: float) -> np.ndarray:
        row = np.zeros(4)
        middle_of(plan, Motion(FLIGHT, 0, u, v, (0.0, 0.0), 0.0, 0.0, clock), row)
        return row

    still = reached(0.0, 0.0)
    jerk = -amplitude * omega * still[3]
    half = 0.125 / omega
    wished = np.array([0.0, -0.3 * 0.5 * jerk * half * half])
    wished[0] = (-c * wished[1] - amplitude * still[2]) / k
    ways = np.transpose([reached(1.0, 0.0) - still, reached(0.0, 1.0) - still])[:2]
    u, v = np.linalg.solve(ways, wished - still[:2])
    motion = Motion(FLIGHT, 0, float(u), float(v), (0.0, 0.0), 0.0, 0.0, clock)
    pieces = out[: looked_at(plan, motion, 2.0 * half, NOWHERE, out)]
    for least, most, low, high, *_ in pieces[0, :2]:
        assert low <= least
        assert most <= high
