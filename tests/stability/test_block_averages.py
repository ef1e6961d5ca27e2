"""What is kept of the growth of disturbances over many cycles."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from vibroimpact.engine import lyapunov
from vibroimpact.stability import block_averages
from vibroimpact.stability.block_averages import Averaged
from vibroimpact.stability.motion_type import averages, settling

ONES = np.ones(lyapunov.GROWTH - lyapunov.SECTION)


def rows(cycles: int, mean: float = 0.3, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(mean, 1.0, (cycles, lyapunov.GROWTH))


def kept(cycle_rows: np.ndarray, cuts: list[int], cycles: int | None = None) -> Averaged:
    averaged = Averaged(cycles or len(cycle_rows))
    for part in np.split(cycle_rows, cuts):
        averaged.add(part)
    return averaged


def test_up_to_so_many_cycles_nothing_is_left_out():
    cycle_rows = rows(3000)
    averaged = kept(cycle_rows, [7, 1000])
    for one, other in zip(averaged.exponents(), averages(cycle_rows[:, :2]), strict=True):
        np.testing.assert_array_equal(one, other)
    assert averaged.damping() == cycle_rows[:, lyapunov.DISSIPATION].mean()
    assert averaged.done == 3000


@pytest.mark.parametrize("cycles", [2999, 100_000])
def test_where_the_rows_are_cut_changes_no_bit(cycles, monkeypatch):
    monkeypatch.setattr(block_averages, "GROUPS", 1024)
    cycle_rows = rows(cycles)
    whole = kept(cycle_rows, [])
    random = np.random.default_rng(1)
    cut = kept(cycle_rows, sorted(random.integers(0, cycles, 40)))
    assert cut.damping() == whole.damping()
    for one, other in zip(cut.exponents(), whole.exponents(), strict=True):
        np.testing.assert_array_equal(one, other)
    assert cut.is_settling(ONES) == whole.is_settling(ONES)
    np.testing.assert_array_equal(cut._section, whole._section)
    np.testing.assert_array_equal(cut._last, whole._last)


@pytest.mark.parametrize("done", [100_000, 54_321, 40])
def test_groups_of_cycles_give_the_same_averages(done, monkeypatch):
    monkeypatch.setattr(block_averages, "GROUPS", 8192)
    cycle_rows = rows(done)
    mean, spread = kept(cycle_rows, [], 100_000).exponents()
    exact, uncertainty = averages(cycle_rows[:, :2])
    np.testing.assert_allclose(mean, exact, rtol=1e-12)
    if done > 1000:
        np.testing.assert_allclose(spread, uncertainty, rtol=0.15)  # of 32 blocks


def test_the_range_of_a_rotation_is_seen_in_groups():
    """Its blocks have the same means; only how far the sum goes from a line tells of it."""
    turned = np.cos(np.arange(1_000_000) * 0.7)
    cycle_rows = np.tile(turned[:, np.newaxis], lyapunov.GROWTH)
    _, spread = kept(cycle_rows, []).exponents()
    _, exact = averages(cycle_rows[:, :2])
    np.testing.assert_allclose(spread, exact, rtol=0.5)


def test_a_disturbance_that_vanishes_counts_in_a_group(monkeypatch):
    monkeypatch.setattr(block_averages, "GROUPS", 64)
    cycle_rows = rows(1000)
    cycle_rows[500, lyapunov.SECOND] = -np.inf
    mean, _ = kept(cycle_rows, []).exponents()
    assert mean[1] == -np.inf
    assert np.isfinite(mean[0])


@pytest.mark.parametrize("cycles", [10_000, 1_000_000])
@pytest.mark.parametrize("done", [1.0, 0.6])
def test_settling_is_seen_in_stretches_as_in_all(cycles, done):
    number = np.arange(int(done * cycles))[:, np.newaxis]
    wave = np.cos(np.pi * number)  # of period 2
    falling = wave * (1.0 + np.exp(-5.0 * number / cycles)) * ONES
    steady = wave * ONES + 1e-3 * rows(len(number))[:, lyapunov.SECTION :]
    for section, expected in ((falling, True), (steady, False)):
        cycle_rows = np.hstack([np.zeros((len(section), lyapunov.SECTION)), section])
        assert settling(section) is expected
        assert kept(cycle_rows, [], cycles).is_settling(ONES) is expected


def test_memory_does_not_grow_with_the_cycles():
    cycle_rows = rows(16_384)
    tracemalloc.start()
    averaged = Averaged(10**8)
    for _ in range(100):
        averaged.add(cycle_rows)
    averaged.exponents()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 10e6
