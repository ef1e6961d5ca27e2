"""Sums over a leap's nodes: exact for what a leap can hold, in Python and compiled."""

from __future__ import annotations

import math

import numba
import numpy as np
import pytest
from numpy.polynomial import Polynomial, legendre

from vibroimpact.engine.memory import pointer
from vibroimpact.engine.taylor.nodes import (
    COSINES,
    COUNT,
    END_OF_ONE,
    END_OF_TWO,
    FADING,
    PLACES,
    SINES,
    integral,
    nodewise,
    spectrum,
    twice,
)


def _formula(x, v, k, c):
    return (x + 2.0) * k - v * (1.0 - c * v)


_bent = nodewise(_formula, (16, PLACES), 32)


@numba.njit
def _compiled(memory, h, start, slope):
    plan = pointer(memory)
    integral(plan, 0, 16, h, start, slope)
    twice(plan, 0, 48, h * h, start, slope)
    spectrum(plan, 0, 64, 1.0, 0.0, 0.0)
    _bent(plan, (0.3, 0.7))
    return memory[0]


def _plain(memory, h, start, slope):
    integral(memory, 0, 16, h, start, slope)
    twice(memory, 0, 48, h * h, start, slope)
    spectrum(memory, 0, 64, 1.0, 0.0, 0.0)
    _bent(memory, (0.3, 0.7))


@pytest.mark.parametrize("run", [_compiled, _plain])
def test_polynomials_are_integrated_exactly(run) -> None:
    rng = np.random.default_rng(1)
    one = Polynomial(rng.uniform(-1.0, 1.0, COUNT))
    memory = np.zeros(80)
    memory[:COUNT] = one(PLACES)
    run(memory, 0.5, 1.5, -0.2)
    expected = 1.5 - 0.2 * PLACES + 0.5 * one.integ()(PLACES)
    np.testing.assert_allclose(memory[16:32], expected, atol=2e-15)
    expected_twice = 1.5 - 0.2 * PLACES + 0.25 * one.integ(2)(PLACES)
    np.testing.assert_allclose(memory[48:64], expected_twice, atol=2e-15)
    np.testing.assert_allclose(
        legendre.legval(2 * PLACES - 1, memory[64:]), one(PLACES), atol=4e-15
    )
    np.testing.assert_allclose(memory[32:48], _formula(memory[16:32], PLACES, 0.3, 0.7), atol=2e-15)
    assert END_OF_ONE @ memory[:COUNT] == pytest.approx(one.integ()(1.0), abs=1e-15)
    assert END_OF_TWO @ memory[:COUNT] == pytest.approx(one.integ(2)(1.0), abs=1e-15)


@pytest.mark.parametrize("y", np.linspace(-1.0, 1.0, 21))
def test_series_are_right_to_rounding(y: float) -> None:
    assert SINES(y * y) * y == pytest.approx(math.sin(y), abs=1e-16, rel=4e-16)
    assert COSINES(y * y) == pytest.approx(math.cos(y), rel=4e-16)
    assert FADING(y) == pytest.approx(-math.expm1(-y) / y if y else 1.0, rel=6e-16)
