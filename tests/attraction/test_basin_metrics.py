"""Measures of labelled grids whose borders are known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vibroimpact.attraction.basin_metrics import border_distances, entropies, uncertainty_exponent

N = 256


def halves() -> np.ndarray:
    labels = np.zeros((N, N), dtype=np.int64)
    labels[:, N // 2 :] = 1
    return labels


def cantor(levels: int) -> np.ndarray:
    """Gaps of the middle-third Cantor set, labelled by whether their level is even."""
    line = np.full(3**levels, -1, dtype=np.int64)

    def fill(begin: int, length: int, level: int) -> None:
        third = length // 3
        line[begin + third : begin + 2 * third] = level % 2
        if third > 1:
            fill(begin, third, level + 1)
            fill(begin + 2 * third, third, level + 1)

    fill(0, len(line), 0)
    line[line < 0] = levels % 2
    return line


def test_a_smooth_border_has_the_exponent_one():
    exponent = uncertainty_exponent(halves())
    assert exponent.value == pytest.approx(1.0, abs=0.02)
    assert exponent.uncertainty < 0.01


def test_the_border_of_a_cantor_set_has_its_dimension():
    line = cantor(8)  # 3^8 points
    # Along the other axis nothing changes, which halves each share and no exponent.
    exponent = uncertainty_exponent(np.tile(line, (line.size // 2, 1))[:2187])
    assert exponent.value == pytest.approx(1.0 - math.log(2.0) / math.log(3.0), abs=0.03)


def test_states_at_random_have_no_exponent_and_all_entropy():
    labels = np.random.default_rng(0).integers(0, 2, (N, N))
    assert uncertainty_exponent(labels).value == pytest.approx(0.0, abs=0.01)
    entropy = entropies(labels)
    assert entropy.basin == pytest.approx(math.log(2.0), abs=0.03)
    assert entropy.border == pytest.approx(entropy.basin, abs=0.001)


def test_entropies_of_halves():
    labels = halves()  # the border cuts a column of boxes of 5 at 128 = 25 · 5 + 3
    mixed = -(0.6 * math.log(0.6) + 0.4 * math.log(0.4))
    entropy = entropies(labels)
    assert entropy.border == pytest.approx(mixed)
    assert entropy.basin == pytest.approx(mixed / (N // 5))
    assert entropies(np.zeros((N, N), dtype=np.int64)) == (0.0, 0.0)


def test_what_has_no_label_counts_for_nothing():
    labels = halves()
    labels[::7] = -2
    assert uncertainty_exponent(labels).value == pytest.approx(1.0, abs=0.03)
    assert entropies(np.full((N, N), -1)).basin != entropies(labels).basin
    assert math.isnan(uncertainty_exponent(np.zeros((N, N), dtype=np.int64)).value)


def test_distances_to_a_border():
    x, y = np.linspace(0.0, 1.0, N), np.linspace(0.0, 2.0, N)
    points = [np.array([[0.1, 1.0], [0.2, 1.5]]), np.array([[0.9, 1.0]]), np.array([[5.0, 5.0]])]
    distances = border_distances(halves(), x, y, points)
    assert distances[:2] == pytest.approx([0.3, 0.4], abs=1.5 / N)
    assert math.isnan(distances[2])
    alone = border_distances(np.zeros((N, N), dtype=np.int64), x, y, points[:1])
    assert alone[0] == math.inf
