"""One sine."""

from __future__ import annotations

import math

import numpy as np
import pytest

from engine.forcing.plans import begun
from vibroimpact.engine.forcing import harmonic
from vibroimpact.engine.forcing.wave import Wave
from vibroimpact.engine.linear.layout import MOST, STEEPEST
from vibroimpact.engine.parameters import Drive

OMEGA = 3.0


@pytest.mark.parametrize(
    ("drive", "size"),
    [
        (Drive(), 0.7),
        (Drive(1.0, -1.0, 2.0), -0.7 * 9.0),
        (Drive(0.0, -0.5), -0.35),
        (Drive(0.0, -0.5, 2.0), -0.35 * 9.0),
    ],
    ids=["acceleration", "displacement", "force", "unbalance"],
)
def test_what_is_given_as_a_base_acceleration(drive: Drive, size: float) -> None:
    plan = begun(harmonic, drive, 0.7, OMEGA)
    for angle in (0.0, 0.4, 2.0, 5.0):
        s, c = math.sin(angle), math.cos(angle)
        assert harmonic.value(plan, s, c) == pytest.approx(size * s, rel=1e-15)
        later = harmonic.turned(plan, s, c, 0.3)
        assert later == pytest.approx((math.sin(angle + 0.9), math.cos(angle + 0.9)), abs=1e-15)
    assert (plan[MOST], plan[STEEPEST]) == pytest.approx((abs(size), abs(size) * OMEGA))
    assert harmonic.wave(plan, 1, False) == pytest.approx(Wave(size, OMEGA, 1.0, 1.0, 0.0))
    assert (harmonic.count(plan), harmonic.pace(plan), harmonic.plane(plan, 1)) == (1, OMEGA, 0)


@pytest.mark.parametrize("scale", [1.0, -1.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("level", [-0.6, 0.0, 0.3, 0.69])
def test_a_level_is_exceeded_where_many_samples_exceed_it(
    scale: float, sign: float, level: float
) -> None:
    plan = begun(harmonic, Drive(1.0, scale), 0.7, OMEGA)
    times = np.linspace(0.0, 2.2, 220_001)
    for angle in np.arange(0.1, 6.2, 0.37):
        above = sign * scale * 0.7 * np.sin(OMEGA * times + angle) > level
        first = float(times[np.argmax(above)])
        t, s, c = harmonic.release_time(plan, sign, level, math.sin(angle), math.cos(angle), 2.2)
        assert t == pytest.approx(first, abs=2e-5)
        if t > 0.0:
            assert sign * harmonic.value(plan, s, c) == pytest.approx(level, abs=1e-15)
            there = math.sin(OMEGA * t + angle), math.cos(OMEGA * t + angle)
            assert (s, c) == pytest.approx(there, abs=1e-13)


def test_a_level_out_of_reach_is_never_exceeded() -> None:
    plan = begun(harmonic, Drive(), 0.7, OMEGA)
    assert harmonic.release_time(plan, 1.0, 0.71, 0.0, 1.0, 1e9)[0] == math.inf
    assert harmonic.release_time(plan, 1.0, 0.5, 0.0, 1.0, 0.1)[0] == math.inf
    assert harmonic.release_time(plan, 1.0, 0.5, 1.0, 0.0, 1.0) == (0.0, 1.0, 0.0)


def test_small_turns() -> None:
    plan = begun(harmonic, Drive(), 0.7, OMEGA)
    for angle in (-0.25, 1e-3, 0.25):
        turned = harmonic.turn(plan, math.sin(1.0), math.cos(1.0), angle)
        assert turned == pytest.approx((math.sin(1.0 + angle), math.cos(1.0 + angle)), abs=1e-15)
    nudged = harmonic.nudged(plan, 0.6, 0.8, 1e-9)
    assert nudged == pytest.approx((0.6 + 8e-10, 0.8 - 6e-10), rel=1e-15)
