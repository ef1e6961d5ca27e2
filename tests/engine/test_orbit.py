"""The small linear systems of Newton's method."""

from __future__ import annotations

import numpy as np
import pytest

from vibroimpact.engine.orbit import solve


@pytest.mark.parametrize("n", [1, 2, 5])
def test_elimination_against_numpy(n: int) -> None:
    rng = np.random.default_rng(n)
    for _ in range(20):
        a, b = rng.normal(size=(n, n)), rng.normal(size=n)
        x = b.copy()
        assert solve(a.ravel().copy(), x, n)
        np.testing.assert_allclose(a @ x, b, rtol=1e-9, atol=1e-12)


def test_a_zero_on_the_diagonal_is_no_obstacle() -> None:
    x = np.array([2.0, 3.0])
    assert solve(np.array([0.0, 1.0, 1.0, 0.0]), x, 2)
    np.testing.assert_array_equal(x, [3.0, 2.0])


def test_a_singular_system_is_refused() -> None:
    assert not solve(np.array([1.0, 2.0, 2.0, 4.0]), np.ones(2), 2)
