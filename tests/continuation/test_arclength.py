"""Pseudo-arclength continuation of curves that are known in closed form, in n unknowns."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
import pytest

from vibroimpact.continuation.arclength import (
    MOST,
    distance,
    follow,
    is_other_curve,
    predicted,
    unit_tangent,
)
from vibroimpact.continuation.closing import crossing
from vibroimpact.continuation.zero import between_zeros, zero_within


@dataclass(frozen=True, eq=False)
class At:
    """A point on a sphere's circle."""

    y: np.ndarray
    tangent: np.ndarray
    arclength: float


class Circle:
    """|y| = 1 in the plane of the first two of n unknowns, each with a scale of its own."""

    def __init__(self, unknowns: int, beyond: float = math.inf, hole: float = math.inf):
        self.scale = np.array([2.0, 0.5, 3.0, 4.0][:unknowns])
        self.seen = np.ones(unknowns)
        self.beyond, self.hole = beyond, hole
        self.moved = 0

    def jacobian(self, y):
        rows = np.zeros((len(y) - 1, len(y)))
        rows[0, :2] = 2.0 * y[:2] * self.scale[:2]
        rows[1:, 2:] = np.diag(self.scale[2:])
        return rows

    def solve(self, aim, normal):
        y = aim.copy()
        for _ in range(20):
            residual = np.array([y[0] ** 2 + y[1] ** 2 - 1.0, *y[2:]])
            matrix = np.vstack([self.jacobian(y), normal])
            right = np.append(-residual, -normal @ ((y - aim) / self.scale))
            y = y + np.linalg.solve(matrix, right) * self.scale
        return y

    def step(self, here, length):
        aim = predicted(self, here, length)
        y = self.solve(aim, here.tangent)
        if is_other_curve(self, y, aim, length) or y[0] < -self.hole:
            return None, False
        tangent = unit_tangent(self.jacobian(y), here.tangent, self.seen)
        return At(y, tangent, here.arclength + distance(self, y, here.y)), False

    def corner(self, here, length):
        return []

    def in_other_coordinates(self, here):
        self.moved += 1
        return None

    def end(self, here, there):
        if there.y[1] > self.beyond:
            return [], "beyond"
        first = self.first
        guess = crossing(self, here, there, first.y, first.tangent)
        if guess is not None and distance(self, self.solve(guess, first.tangent), first.y) < 1e-9:
            return [there], "closed"
        return None

    def lost(self, here):
        return "lost"

    def start(self, angle=0.3):
        y = np.zeros(len(self.scale))
        y[:2] = math.cos(angle), math.sin(angle)
        along = np.zeros(len(y))
        along[1] = 1.0
        self.first = At(y, unit_tangent(self.jacobian(y), along, self.seen), 0.0)
        return self.first


@pytest.mark.parametrize("unknowns", [2, 3, 4])
def test_a_circle_is_gone_round_once(unknowns):
    circle = Circle(unknowns)
    trace = follow(circle, circle.start(), 5000)
    assert trace.ended == "closed"
    points = np.array([point.y for point in trace.points])
    np.testing.assert_allclose(np.hypot(points[:, 0], points[:, 1]), 1.0, rtol=1e-12)
    angles = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    assert (np.diff(angles) > 0.0).all()
    assert angles[-2] < 0.3 + math.tau <= angles[-1]
    steps = [distance(circle, a, b) for a, b in itertools.pairwise(points)]
    assert max(steps) < 1.1 * MOST
    assert trace.points[-1].arclength == pytest.approx(sum(steps))


def test_why_it_ends():
    circle = Circle(2)
    short = follow(circle, circle.start(), 7)
    assert (len(short.points), short.ended) == (7, "7 points were reached")
    circle = Circle(2, beyond=0.9)
    trace = follow(circle, circle.start(), 5000)
    assert trace.ended == "beyond"
    assert trace.points[-1].y[1] <= 0.9
    circle = Circle(3, hole=0.5)
    trace = follow(circle, circle.start(), 5000)
    assert trace.ended == "lost"
    assert trace.points[-1].y[0] == pytest.approx(-0.5, abs=1e-8)
    assert circle.moved  # other coordinates were tried


def test_points_that_lead_nowhere_end_it():
    class Creeping(Circle):
        def step(self, here, length):
            return super().step(here, length) if length <= 1e-5 else (None, False)

    circle = Creeping(2)
    trace = follow(circle, circle.start(), 5000)
    assert trace.ended == "lost"
    assert len(trace.points) < 200


def test_progress_sees_every_point():
    circle, seen = Circle(2), []
    trace = follow(circle, circle.start(), 20, seen.append)
    assert seen == trace.points[1:]


def test_a_crossing_counts_in_the_same_sense_and_nearby_only():
    circle = Circle(2)
    mark = circle.start(0.3)
    here, there = (At(circle.start(a).y, mark.tangent, 0.0) for a in (0.29, 0.31))
    guess = crossing(circle, here, there, mark.y, mark.tangent)
    np.testing.assert_allclose(guess, mark.y, atol=1e-3)
    assert crossing(circle, there, here, mark.y, mark.tangent) is None
    opposite = [At(circle.start(a + math.pi).y, mark.tangent, 0.0) for a in (0.31, 0.29)]
    assert crossing(circle, *opposite, mark.y, mark.tangent) is None


@pytest.mark.parametrize("root", [1e-9, 0.3, 0.999])
def test_a_zero_to_rounding(root):
    calls = []

    def solved(x):
        calls.append(x)
        return x

    zero, length = zero_within(0.0, 1.0, solved, lambda x: math.expm1(5.0 * (x - root)))
    assert zero == length == pytest.approx(root, abs=1e-14)
    assert len(calls) < 40
    assert zero_within(0.0, 1.0, lambda x: None, lambda x: x - 0.5) is None


@pytest.mark.parametrize("at", [0.07, 0.4, 0.9])
@pytest.mark.parametrize("low", [-1e-8, -1e-3, 1e-8, 0.3])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_two_zeros_within_a_step(at, low, sign):
    """They are seen however close they are; and where there are none, that is seen at once."""
    calls = []

    def function(x):
        return sign * (low + 8.0 * (math.cosh(x - at) - 1.0) + (x - at) ** 3)

    def solved(x):
        calls.append(x)
        return x

    mean = np.mean([function(x) for x in np.linspace(0.0, 1.0, 4001)])
    point = between_zeros((function(0.0), function(1.0)), mean, 1.0, solved, function)
    assert len(calls) <= 8
    if low < 0.0:
        assert point is not None
        assert sign * function(point[0]) < 0.0
        assert point[1] == pytest.approx(at, abs=0.1)
    else:
        assert point is None
    assert between_zeros((1.0, 2.0), 1.5, 1.0, solved, function) is None
    assert between_zeros((1.0, 1.0), -1.0, 1.0, lambda x: None, function) is None


def test_a_tangent_of_a_singular_border():
    """Where `along` has no part in the tangent, it is still found."""
    jacobian = np.array([[1.0, 0.0]])
    np.testing.assert_allclose(
        np.abs(unit_tangent(jacobian, np.array([1.0, 0.0]), np.ones(2))), [0.0, 1.0], atol=1e-15
    )
