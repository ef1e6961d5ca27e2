"""The tables of all modes, and the motion read from them at any time."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vibroimpact.engine.forcing.harmonic import turn
from vibroimpact.engine.linear.evaluate import horner, node, travel
from vibroimpact.engine.linear.layout import (
    FORGOTTEN,
    LATE_TABLES,
    NODES,
    ORDER,
    PLAN,
    SIZE,
    TABLES,
    VALID_FROM,
    H,
    Row,
)
from vibroimpact.engine.linear.tables import build
from vibroimpact.engine.motion import BOTH, LEFT, RIGHT, SEEN_LEFT
from vibroimpact.engine.parameters import SIZE as RIG
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.state import FLIGHT
from vibroimpact.engine.stops.kelvin_voigt import relaxed
from vibroimpact.engine.stops.places import overlapping
from vibroimpact.engine.stops.rigid import resting
from vibroimpact.law_numbers import StopNumbers

PRESSED = (20.0, 0.4, -0.3)


def plan(
    damping: float,
    right: StopNumbers | None = None,
    left: StopNumbers | None = None,
    amplitude: float = 0.0,
    omega: float = 1.0,
) -> np.ndarray:
    made = np.zeros(PLAN)
    made[:RIG] = rig_vector(1.0, 1.0, damping, right, left)
    build(made, amplitude, omega)
    return made


def test_free_vibration_at_and_between_the_nodes() -> None:
    made = plan(0.0)
    h = made[TABLES + H]
    for i in (0, 1, 7, NODES - 1):
        for y in (0.0, 0.3, 0.999):
            at = node(made, TABLES, i, Row(0.0, 1.0, 0.0, 1.0))
            x, v, s, c = travel(made, TABLES, y, at)
            t = (i + y) * h
            expected = (math.sin(t), math.cos(t), math.sin(t), math.cos(t))
            assert (x, v, s, c) == pytest.approx(expected, abs=2e-15)


def test_forced_motion_at_the_steady_state() -> None:
    """With c = 1 and ω = 2 it is the well-known amplitude and lag at every node."""
    made = plan(1.0, amplitude=0.6, omega=2.0)
    h = made[TABLES + H]
    response = -0.6 / (1.0 - 4.0 + 2.0j)  # of sin θ

    def steady(t: float) -> tuple[float, float]:
        turned = response * np.exp(2.0j * t)
        return float(turned.imag), float((2.0j * turned).imag)

    for i in range(NODES):
        x, v, _, _ = node(made, TABLES, i, Row(*steady(0.0), 0.0, 1.0))
        assert (x, v) == pytest.approx(steady(i * h), abs=1e-15)


def test_the_late_table_is_the_early_one_without_its_fast_part() -> None:
    """x″ + 100.1 x′ + 101 x = 0: where the fast part is gone both go on alike."""
    made = plan(0.1, (100.0, 100.0, 0.0))
    early = TABLES + SIZE * RIGHT
    late = early + LATE_TABLES
    fast = 50.05 + math.sqrt(50.05**2 - 101.0)
    slow = 101.0 / fast
    assert made[late + VALID_FROM] == pytest.approx(FORGOTTEN / fast)
    assert made[late + H] > 5.0 * made[early + H]
    for y in (0.0, 0.4, 1.0):
        x, v, _, _ = travel(made, late, y, Row(1.0, -slow, 0.0, 1.0))
        expected = math.exp(-slow * y * made[late + H])
        assert (x, v) == pytest.approx((expected, -slow * expected), rel=1e-13)


def test_pressed_on_both_sides_is_one_motion_seen_from_two() -> None:
    made = plan(0.1, PRESSED, (50.0, 1.0, -0.2), amplitude=0.6, omega=1.2)
    assert overlapping(made)
    x, v, s, c = 0.2, -0.3, 0.6, 0.8
    for i in range(1, NODES):
        right = node(made, TABLES + SIZE * BOTH, i, Row(x, v, s, c))
        left = node(made, TABLES + SIZE * SEEN_LEFT, i, Row(0.5 - x, -v, -s, -c))
        mirrored = (0.5 - left[0], -left[1], -left[2], -left[3])
        assert right == pytest.approx(mirrored, abs=5e-15)


def test_at_rest_only_the_forcing_moves() -> None:
    made = plan(0.1, (0.5, -0.3), amplitude=0.6, omega=1.2)
    assert resting(made, RIGHT)
    assert not resting(made, FLIGHT)
    assert not resting(made, LEFT)
    table = TABLES + SIZE * RIGHT
    x, v, s, c = node(made, table, 5, Row(0.0, 0.0, 0.0, 1.0))
    assert (x, v) == (0.0, 0.0)
    angle = 5 * 1.2 * made[table + H]
    assert (s, c) == pytest.approx((math.sin(angle), math.cos(angle)), abs=1e-15)


def test_bumpers_out_of_reach_of_one_another_have_no_table_of_both() -> None:
    made = plan(0.1, PRESSED, (20.0, 0.4, 0.3))
    assert not overlapping(made)
    assert made[TABLES + SIZE * BOTH + H] == 0.0


@pytest.mark.parametrize("angle", [0.0, 1e-9, -0.01, 0.125])
def test_a_phasor_turned(angle: float) -> None:
    s, c = turn(np.empty(0), math.sin(1.0), math.cos(1.0), angle)
    assert (s, c) == pytest.approx((math.sin(1.0 + angle), math.cos(1.0 + angle)), abs=2e-16)


def test_a_free_bumper_relaxes_and_is_forgotten() -> None:
    assert relaxed(0.3, 2.0, 0.5) == pytest.approx(0.3 * math.exp(-1.0), rel=1e-15)
    assert relaxed(0.3, 2.0, FORGOTTEN) == 0.0
    assert relaxed(0.3, math.inf, 1e-9) == 0.0
    assert relaxed(0.0, math.inf, 0.0) == 0.0


def test_value_and_slope_of_a_series() -> None:
    series = np.arange(1.0, ORDER + 1.0)
    polynomial = np.polynomial.Polynomial(series)
    expected = (polynomial(0.3), polynomial.deriv()(0.3))
    assert horner(series, 0.3) == pytest.approx(expected, rel=1e-15)
