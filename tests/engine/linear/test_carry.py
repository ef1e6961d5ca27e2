"""What the tables' own tangent flow is made of: the exponential of a mode's matrix."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from vibroimpact.engine.linear.carry import transition


@pytest.mark.parametrize("c", [0.0, 0.3, 2.0 - 1e-9, 2.0, 2.0 + 1e-9, 5.0, 400.0])
@pytest.mark.parametrize("t", [0.0, 1e-9, 0.01, 1.7, 30.0])
def test_transition_is_the_matrix_exponential(c, t):
    with mpmath.workdps(50):
        exact = mpmath.expm(mpmath.matrix([[0, 1], [-1, -mpmath.mpf(c)]]) * mpmath.mpf(t))
        expected = [float(exact[i, j]) for i in range(2) for j in range(2)]
    np.testing.assert_allclose(transition(c, 1.0, t), expected, rtol=3e-8, atol=1e-15)
    if abs(c - 2.0) > 1e-6:
        np.testing.assert_allclose(transition(c, 1.0, t), expected, rtol=1e-11, atol=1e-15)


@pytest.mark.parametrize(("c", "row"), [(0.0, (1.0, 3.0, 0.0, 1.0)), (0.5, None)])
def test_transition_without_a_spring(c, row):
    """x = x₀ + v₀ t, or x₀ + v₀ (1 - exp(-c t))/c."""
    fading = math.exp(-c * 3.0)
    expected = row or (1.0, (1.0 - fading) / c, 0.0, fading)
    np.testing.assert_allclose(transition(c, 0.0, 3.0), expected, rtol=1e-15, atol=0.0)
