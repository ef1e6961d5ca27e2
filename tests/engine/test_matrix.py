"""Small matrices beside numpy's."""

from __future__ import annotations

import numpy as np
import pytest

from vibroimpact.engine.matrix import radius, solve


@pytest.mark.parametrize("seed", range(5))
def test_the_radius_is_that_of_the_largest_eigenvalue(seed: int) -> None:
    matrix = np.random.default_rng(seed).normal(size=(5, 5))
    matrix[:, 2:4] = 0.0
    value = radius(matrix.ravel().copy(), np.zeros(25), 5)
    assert value == pytest.approx(max(abs(np.linalg.eigvals(matrix))), rel=3e-4)
    assert radius(np.zeros(25), np.zeros(25), 5) == 0.0


def test_the_radius_of_a_rotation_is_one() -> None:
    """What neither grows nor dies is not said to die."""
    for angle in np.linspace(0.1, 3.0, 12):
        turned = np.array(
            [[np.cos(angle), -3.0 * np.sin(angle)], [np.sin(angle) / 3.0, np.cos(angle)]]
        )
        assert radius(turned.ravel().copy(), np.zeros(4), 2) == pytest.approx(1.0, abs=3e-4)


@pytest.mark.parametrize("seed", range(5))
def test_linear_equations(seed: int) -> None:
    rng = np.random.default_rng(seed)
    matrix, right = rng.normal(size=(5, 5)), rng.normal(size=5)
    matrix[0, 0] = 0.0  # so that rows must be exchanged
    x = right.copy()
    assert solve(matrix.ravel().copy(), x, 5)
    np.testing.assert_allclose(matrix @ x, right, rtol=0.0, atol=1e-12)


def test_a_singular_matrix_is_told() -> None:
    assert not solve(np.zeros(25), np.ones(5), 5)
