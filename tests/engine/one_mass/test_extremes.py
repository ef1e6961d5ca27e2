"""Extremes and turning points of series whose shape is known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vibroimpact.engine.linear.layout import ORDER
from vibroimpact.engine.one_mass import extremes
from vibroimpact.engine.one_mass.extremes import series_extremes
from vibroimpact.engine.one_mass.margin import slope_series


def series(*coefficients: float) -> np.ndarray:
    return np.array([*coefficients, *[0.0] * (ORDER - len(coefficients))])


def test_both_extremes_of_a_cubic_lie_inside() -> None:
    """y³ − 0.12 y has them at ±0.2, off any dyadic point."""
    least, most, at_least, at_most = series_extremes(
        series(0.0, -0.12, 0.0, 1.0), -0.35, 0.3, math.inf, -math.inf
    )
    assert (at_least, at_most) == pytest.approx((0.2, -0.2), abs=1e-7)
    assert (least, most) == pytest.approx((-0.016, 0.016), rel=1e-14)


def test_what_was_wider_before_stays() -> None:
    extrema = series_extremes(series(0.0, 1.0), -0.5, 0.5, -3.0, 0.25)
    assert extrema == (-3.0, 0.5, -0.5, 0.5)


def test_a_constant_is_passed_in_one_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """A mass at rest on its wall, for which steps of 2⁻²⁷ would take seconds."""
    looked_at = []

    def counted(one: np.ndarray, y: float) -> tuple[float, float, float]:
        looked_at.append(y)
        assert len(looked_at) < 10
        return jet.py_func(one, y)

    jet = extremes.jet
    monkeypatch.setattr(extremes, "jet", counted)
    extrema = series_extremes.py_func(series(0.3), -0.5, 0.5, math.inf, -math.inf)
    assert extrema == (0.3, 0.3, -0.5, -0.5)
    assert looked_at == [-0.5, 0.5]


def test_no_sample_lies_outside_and_the_ends_are_values() -> None:
    rng = np.random.default_rng(1)
    y = np.linspace(-0.5, 0.5, 4001)
    for _ in range(200):
        one = rng.normal(size=ORDER) * 3.0 ** rng.integers(0, 3, ORDER)
        p = np.polynomial.Polynomial(one)
        least, most, at_least, at_most = series_extremes(one, -0.5, 0.5, math.inf, -math.inf)
        size = abs(one).max()
        assert least <= p(y).min() + 1e-14 * size
        assert most >= p(y).max() - 1e-14 * size
        assert (least, most) == pytest.approx((p(at_least), p(at_most)), abs=1e-13 * size)


def test_the_slope_of_a_series_and_its_first_sign() -> None:
    slope = np.empty(ORDER)
    assert slope_series(series(0.0, -0.2, 1.0), slope) == -1.0
    np.testing.assert_array_equal(slope[:3], [-0.2, 2.0, 0.0])
    assert slope_series(series(0.0, 1.2, 1.0), slope) == 1.0
    # Flat at the beginning: what follows decides.
    assert slope_series(series(0.0, 1.0, 1.0), slope) == 1.0
