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


def kept(given: np.ndarray, cuts: list[int], cycles: int | None = None) -> Averaged:
    found = Averaged(cycles or len(given))
    for part in np.split(given, cuts):
        found.add(part)
    return found


def test_up_to_so_many_cycles_nothing_is_left_out():
    given = rows(3000)
    found = kept(given, [7, 1000])
    for one, other in zip(found.exponents(), averages(given[:, :2]), strict=True):
        np.testing.assert_array_equal(one, other)
    assert found.damping() == given[:, lyapunov.DISSIPATION].mean()
    assert found.done == 3000


@pytest.mark.parametrize("cycles", [2999, 100_000])
def test_where_the_rows_are_cut_changes_no_bit(cycles, monkeypatch):
    monkeypatch.setattr(block_averages, "GROUPS", 1024)
    given = rows(cycles)
    whole = kept(given, [])
    random = np.random.default_rng(1)
    cut = kept(given, sorted(random.integers(0, cycles, 40)))
    assert cut.damping() == whole.damping()
    for one, other in zip(cut.exponents(), whole.exponents(), strict=True):
        np.testing.assert_array_equal(one, other)
    assert cut.is_settling(ONES) == whole.is_settling(ONES)
    np.testing.assert_array_equal(cut._section, whole._section)
    np.testing.assert_array_equal(cut._last, whole._last)


@pytest.mark.parametrize("done", [100_000, 54_321, 40])
def test_groups_of_cycles_give_the_same_averages(done, monkeypatch):
    monkeypatch.setattr(block_averages, "GROUPS", 8192)
    given = rows(done)
    mean, spread = kept(given, [], 100_000).exponents()
    exact, uncertainty = averages(given[:, :2])
    np.testing.assert_allclose(mean, exact, rtol=1e-12)
    if done > 1000:
        np.testing.assert_allclose(spread, uncertainty, rtol=0.15)  # of 32 blocks


def test_the_range_of_a_rotation_is_seen_in_groups():
    """Its blocks have the same means; only how far the sum goes from a line tells of it."""
    turned = np.cos(np.arange(1_000_000) * 0.7)
    given = np.tile(turned[:, np.newaxis], lyapunov.GROWTH)
    _, spread = kept(given, []).exponents()
    _, exact = averages(given[:, :2])
    np.testing.assert_allclose(spread, exact, rtol=0.5)


def test_a_disturbance_that_vanishes_counts_in_a_group(monkeypatch):
    monkeypatch.setattr(block_averages, "GROUPS", 64)
    given = rows(1000)
    given[500, lyapunov.SECOND] = -np.inf
    mean, _ = kept(given, []).exponents()
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
        given = np.hstack([np.zeros((len(section), lyapunov.SECTION)), section])
        assert settling(section) is expected
        assert kept(given, [], cycles).is_settling(ONES) is expected


def test_memory_does_not_grow_with_the_cycles():
    given = rows(16_384)
    tracemalloc.start()
    found = Averaged(10**8)
    for _ in range(100):
        found.add(given)
    found.exponents()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 10e6
