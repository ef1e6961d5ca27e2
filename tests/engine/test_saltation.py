"""Each kind of event against the motions that it joins: parabolas before and after it."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from vibroimpact.engine import saltation
from vibroimpact.engine.one_mass.disturbed_events import DISTURBANCE, MEMORY
from vibroimpact.engine.stops.rebound import Rebound

SMALL = mpmath.mpf(10) ** -12
"""Of a disturbance, of the event's size: the second order is 1e-12 of the first."""
ROWS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.3, -0.8, 0.5))
"""Disturbances of u, u̇ and a third part."""


def event_time(g):
    """The zero of a function of time next to 0."""
    return mpmath.findroot(g, 0, tol=mpmath.mpf(10) ** -60)


def derivative(through, row):
    """What becomes of a disturbance at the event, by differences of motions with 40 digits.

    `through` begins and ends at the instant of the undisturbed event: it goes back by the rates
    before it, on to the disturbed event, and comes back by those after it.
    """
    with mpmath.workdps(40):
        ends = [through(*(sign * SMALL * mpmath.mpf(one) for one in row)) for sign in (1, -1)]
        return [float((one - other) / (2 * SMALL)) for one, other in zip(*ends, strict=True)]


def parabola(u, v, a, t):
    return u + v * t + a * t**2 / 2, v + a * t


@pytest.mark.parametrize("row", ROWS)
@pytest.mark.parametrize("e", [0.7, 1.0, 1e-3, 0.0])
@pytest.mark.parametrize("arrival", [1.3, -0.2])
@pytest.mark.parametrize("order", [1.0, 0.8])
def test_impact(order, e, arrival, row):
    """From e |v| the speed of the return grows as the power `order` of that of the arrival."""
    before, after = -0.4, 2.1

    def through(u, v, _):
        v = arrival + v
        t = event_time(lambda t: parabola(u, v, before, t)[0])
        u, v = parabola(u, v, before, t)
        u, v = parabola(0, -e * arrival * (v / arrival) ** order, after, -t)
        return u, v + e * arrival

    q = np.zeros(DISTURBANCE)
    q[:2] = row[:2]
    saltation.impact(q, 0, Rebound(e, order, 1.0), arrival, before, after)
    np.testing.assert_allclose(q[:2], derivative(through, row), rtol=1e-11, atol=1e-12)


@pytest.mark.parametrize("row", ROWS)
@pytest.mark.parametrize("arrival", [1.3, 1e-3])
def test_contact_with_a_dashpot(arrival, row):
    """A bumper that still relaxes, at 0.3 m/s; the dashpot takes the closing speed times C."""
    damping, before, face = 3.0, -0.4, -0.3

    def through(u, v, deformation):
        v = arrival + v
        t = event_time(lambda t: parabola(u, v, before, t)[0] - deformation - face * t)
        u, v = parabola(u, v, before, t)
        after = before - damping * (arrival - face)
        u, v = parabola(u, v, after, -t)
        return u, v - arrival, u

    q = np.array([row[0], row[1], row[2], 0.0, 0.0])
    saltation.contact(q, 0, 2, damping)
    np.testing.assert_allclose(q[:3], derivative(through, row), rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("row", ROWS)
@pytest.mark.parametrize("arrival", [1.3, -0.2])
def test_contact_with_a_force_that_jumps(arrival, row):
    force, before = 0.9, -0.4
    after = before - math.copysign(force, arrival)

    def through(u, v, _):
        v = arrival + v
        t = event_time(lambda t: parabola(u, v, before, t)[0])
        u, v = parabola(u, v, before, t)
        return parabola(u, v, after, -t)

    q = np.zeros(DISTURBANCE)
    q[:2] = row[:2]
    saltation.force_jump(q, 0, arrival, force)
    expected = derivative(lambda *y: np.subtract(through(*y), (0, arrival)), row)
    np.testing.assert_allclose(q[:2], expected, rtol=1e-11, atol=1e-12)


@pytest.mark.parametrize("row", ROWS)
@pytest.mark.parametrize("after", [1.7, 0.0])
def test_turn_with_friction_and_sticking(after, row):
    before = 2.3

    def through(u, v, _):
        t = event_time(lambda t: v + before * t)
        u, v = parabola(u, v, before, t)
        return parabola(u, v, after, -t)

    q = np.zeros(DISTURBANCE)
    q[:2] = row[:2]
    saltation.turn(q, 0, before, after)
    np.testing.assert_allclose(q[:2], derivative(through, row), rtol=1e-11, atol=1e-12)


@pytest.mark.parametrize("row", ROWS)
def test_a_rate_that_jumps_at_an_impact(row):
    """What an isolator remembers follows u, by 0.8 before the impact and by 0.5 after it."""
    e, arrival = 0.6, 1.3

    def through(u, v, z):
        v = arrival + v
        t = event_time(lambda t: u + v * t)
        return (z + 0.8 * v * t - 0.5 * (-e * v) * t,)

    q = np.array([row[0], row[1], 0.0, 0.0, row[2]])
    saltation.jump(q, MEMORY, -q[0] / arrival, 0.8 * arrival, -0.5 * e * arrival)
    np.testing.assert_allclose(q[MEMORY], derivative(through, row)[0], rtol=1e-11)


@pytest.mark.parametrize("row", ROWS)
def test_yielding(row):
    def through(_, __, z):
        rate = mpmath.mpf(0.8)
        t = -z / rate
        return (z + rate * t,)

    q = np.array([row[0], row[1], 0.0, 0.0, row[2]])
    saltation.yielding(q, MEMORY)
    assert q[MEMORY] == derivative(through, row)[0] == 0.0
    assert q[:2].tolist() == list(row[:2])


def test_rest_and_detachment_leave_nothing_of_what_they_end():
    q = np.arange(1.0, 6.0)
    saltation.detachment(q, 2)
    assert q.tolist() == [1.0, 2.0, 0.0, 4.0, 5.0]
    saltation.rest(q, 0)
    assert q.tolist() == [0.0, 0.0, 0.0, 4.0, 5.0]
