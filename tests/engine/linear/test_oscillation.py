"""The matrix of a free oscillation, with exact fractions."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from vibroimpact.engine.linear.oscillation import oscillation


@pytest.mark.parametrize("k", [1.0, 2.3, 0.017, 5.1e7])
@pytest.mark.parametrize("angle", [0.01, 0.25, 0.7, math.pi / 2, 3.0, 4.0])
def test_the_energy_is_kept_to_more_than_a_rounding(k: float, angle: float) -> None:
    *matrix, out, swing, pull = map(Fraction, oscillation(angle / math.sqrt(k), 0.0, k))
    a, b, c, d = (x + y for x, y in zip(matrix, (out, swing, pull, out), strict=True))
    stiffness = Fraction(k)
    assert abs(a * a + c * c / stiffness - 1) < 1e-21
    assert abs(b * b * stiffness + d * d - 1) < 1e-21
    assert abs(a * b + c * d / stiffness) * math.sqrt(k) < 1e-21


@pytest.mark.parametrize("k", [1e-200, 1e200])
def test_far_away_it_is_as_good_as_its_rounding(k: float) -> None:
    with np.errstate(over="ignore", invalid="ignore"):  # as Python, numpy reports it
        a, b, c, d, *left_out = oscillation(1.0 / math.sqrt(k), 0.0, k)
    assert np.isfinite(left_out).all()
    assert a == d == pytest.approx(math.cos(1.0), rel=1e-15)
    assert -b * c == pytest.approx(math.sin(1.0) ** 2, rel=1e-15)


def test_damped() -> None:
    c, k, t = 0.3, 2.0, 1.7
    a, b, pull, d, *left_out = oscillation(t, c, k)
    assert left_out == [0.0, 0.0, 0.0]
    assert a * d - b * pull == pytest.approx(math.exp(-c * t), rel=1e-14)
    assert a - d == pytest.approx(c * b, rel=1e-14)
    assert pull == pytest.approx(-k * b, rel=1e-14)
