"""A straight line between two samples of a record."""

from __future__ import annotations

import math

import pytest

from engine.forcing.plans import begun
from vibroimpact.engine.forcing import ramp
from vibroimpact.engine.linear.layout import MOST, STEEPEST
from vibroimpact.engine.parameters import Drive

LINE = begun(ramp, Drive(interval=0.1), 4.0, 30.0)
"""Within 4 m/s², no steeper than 120 m/s³."""


def test_the_clock_is_the_acceleration_and_its_slope() -> None:
    assert ramp.value(LINE, -1.5, 20.0) == -1.5
    assert ramp.turned(LINE, -1.5, 20.0, 0.05) == pytest.approx((-0.5, 20.0), rel=1e-15)
    assert ramp.turn(LINE, -1.5, 20.0, 0.01) == pytest.approx((-1.3, 20.0), rel=1e-15)
    assert (ramp.pace(LINE), ramp.count(LINE), ramp.plane(LINE, 1)) == (0.0, 1, 0)
    assert (LINE[MOST], LINE[STEEPEST]) == (4.0, 120.0)
    assert ramp.wave(LINE, 1, True) == (1.0, 1.0, 0.0, 1.0, 0.0)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_level_is_exceeded_where_the_line_crosses_it(sign: float) -> None:
    t, s, c = ramp.release_time(LINE, sign, 0.5, sign * -1.5, sign * 20.0, 0.2)
    assert t == pytest.approx(0.1, rel=1e-15)
    assert (s, c) == (sign * 0.5, sign * 20.0)
    assert ramp.release_time(LINE, sign, 0.5, sign * -1.5, sign * 20.0, 0.09)[0] == math.inf
    assert ramp.release_time(LINE, sign, 0.5, sign * -1.5, sign * -20.0, 9.0)[0] == math.inf
    assert ramp.release_time(LINE, sign, 0.5, sign * 0.6, sign * -20.0, 9.0)[0] == 0.0
    # Just at the level it goes by where the line leads.
    assert ramp.release_time(LINE, sign, 0.5, sign * 0.5, sign * 1.0, 9.0)[0] == 0.0
    assert ramp.release_time(LINE, sign, 0.5, sign * 0.5, sign * -1.0, 9.0)[0] == math.inf
