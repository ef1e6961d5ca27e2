"""The certified search on functions whose roots are known."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vibroimpact.engine.linear.layout import ORDER
from vibroimpact.engine.linear.roots import NONE, Clearance, first_root


def search(
    coefficients: list[float],
    offset: float = 0.0,
    sign: float = 1.0,
    memory: float = 0.0,
    rate: float = 0.0,
    double: bool = False,
    low: float = -0.5,
    high: float = 0.5,
) -> float:
    series = np.zeros(ORDER)
    series[: len(coefficients)] = coefficients
    return first_root(series, Clearance(offset, sign, memory, rate, double), low, high)


def from_roots(roots: list[float]) -> list[float]:
    """Coefficients of a polynomial that starts positive at −1/2."""
    c = np.polynomial.polynomial.polyfromroots(roots)
    return list(c * np.sign(np.polynomial.polynomial.polyval(-0.5, c)))


def test_no_root() -> None:
    assert search([1.0, 0.5]) == NONE


def test_a_rising_zero_is_not_a_crossing() -> None:
    # Positive, down through zero at -0.3: that one counts, not the rise at 0.2.
    assert search(from_roots([-0.3, 0.2])) == pytest.approx(-0.3, abs=1e-15)


@given(st.lists(st.floats(-0.49, 0.49), min_size=1, max_size=6, unique=True))
@settings(max_examples=300)
def test_first_of_many(roots: list[float]) -> None:
    ordered = sorted(roots)
    if any(b - a < 1e-3 for a, b in pairwise(ordered)):
        return
    assert len(roots) + 1 <= ORDER
    # The coefficients' rounding moves a root by eps over the slope there.
    slope = math.prod(abs(ordered[0] - r) for r in ordered[1:])
    assert search(from_roots(ordered)) == pytest.approx(ordered[0], abs=1e-15 + 1e-14 / slope)


@pytest.mark.parametrize("depth", [10.0**-k for k in range(2, 15)])
def test_close_pair_is_found_and_a_miss_is_not(depth: float) -> None:
    """A parabola that dips below zero by `depth`, and one that stays above by as much."""
    assert search([-depth, 0.0, 1.0]) == pytest.approx(-math.sqrt(depth), rel=1e-6)
    assert search([depth, 0.0, 1.0]) == NONE


def test_touch_to_rounding_is_no_crossing() -> None:
    assert search([0.0, 0.0, 1.0]) == NONE


def test_memory_fast_against_the_interval() -> None:
    """1e-3 exp(−1e4 (y + ½)) − (y + ½) + …: the exponential is gone within a thousandth."""
    # f = memory exp(-rate (y - low)) + 1e-4 - (y + 0.5) has its root close to low.
    root = search([1e-4 - 0.5, -1.0], memory=1e-3, rate=1e4)
    x = root + 0.5
    assert 1e-3 * math.exp(-1e4 * x) + 1e-4 - x == pytest.approx(0.0, abs=1e-15)
    assert 0.0 < x < 1e-3


def test_double_zero_at_the_start_is_left_behind() -> None:
    """A detachment: f = m (exp(−x) − 1 + x) − u, which opens, and later closes at a root."""
    memory, rate = 1e-2, 40.0
    pull = 1.0  # f'' of the polynomial part is −2 pull; the memory gives m rate² = 16
    root = search([0.0, 0.0, -pull], memory=memory, rate=rate, double=True, low=0.0)
    x = rate * root
    assert memory * (math.expm1(-x) + x) - pull * root**2 == pytest.approx(0.0, abs=1e-15)
    assert root > 0.1


def test_double_zero_that_closes_at_once() -> None:
    """Parting acceleration negative: the contact goes on from the start."""
    assert search([0.0, 0.0, -1.0], memory=1e-6, rate=1.0, double=True, low=0.0) < 1e-10
