"""A straight line between two samples of a record."""

from __future__ import annotations

import math

import numpy as np
import pytest

from engine.forcing.plans import begun
from vibroimpact.engine.forcing import ramp
from vibroimpact.engine.linear.layout import MOST, STEEPEST
from vibroimpact.engine.parameters import Drive


@pytest.fixture(scope="module")
def line() -> np.ndarray:
    """Within 4 m/s², no steeper than 120 m/s³."""
    return begun(ramp, Drive(interval=0.1), 4.0, 30.0)


def test_the_clock_is_the_acceleration_and_its_slope(line: np.ndarray) -> None:
    assert ramp.value(line, -1.5, 20.0) == -1.5
    assert ramp.turned(line, -1.5, 20.0, 0.05) == pytest.approx((-0.5, 20.0), rel=1e-15)
    assert ramp.turn(line, -1.5, 20.0, 0.01) == pytest.approx((-1.3, 20.0), rel=1e-15)
    assert (ramp.pace(line), ramp.count(line), ramp.plane(line, 1)) == (0.0, 1, 0)
    assert (line[MOST], line[STEEPEST]) == (4.0, 120.0)
    assert ramp.wave(line, 1, True) == (1.0, 1.0, 0.0, 1.0, 0.0)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_level_is_exceeded_where_the_line_crosses_it(line: np.ndarray, sign: float) -> None:
    t, s, c = ramp.release_time(line, sign, 0.5, sign * -1.5, sign * 20.0, 0.2)
    assert t == pytest.approx(0.1, rel=1e-15)
    assert (s, c) == (sign * 0.5, sign * 20.0)
    assert ramp.release_time(line, sign, 0.5, sign * -1.5, sign * 20.0, 0.09)[0] == math.inf
    assert ramp.release_time(line, sign, 0.5, sign * -1.5, sign * -20.0, 9.0)[0] == math.inf
    assert ramp.release_time(line, sign, 0.5, sign * 0.6, sign * -20.0, 9.0)[0] == 0.0
    # Just at the level it goes by where the line leads.
    assert ramp.release_time(line, sign, 0.5, sign * 0.5, sign * 1.0, 9.0)[0] == 0.0
    assert ramp.release_time(line, sign, 0.5, sign * 0.5, sign * -1.0, 9.0)[0] == math.inf
