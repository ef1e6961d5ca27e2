"""Disturbances brought to unit size lose nothing but their size."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vibroimpact.engine.linear.carry import press_area
from vibroimpact.engine.linear.growth import AREA, normalise
from vibroimpact.engine.motion import BOTH, FLIGHT, LEFT, RIGHT
from vibroimpact.engine.observers.tangent import DISTURBANCE, tie
from vibroimpact.engine.parameters import free_rig

MODES = [FLIGHT, RIGHT, LEFT, BOTH]
WEIGHT = 1.7
RIG = free_rig()


def minors(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The area that two disturbances span."""
    assert a[4] == b[4] == 0.0  # a linear isolator remembers nothing
    pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    return np.array([a[i] * b[j] - a[j] * b[i] for i, j in pairs])


def pair(mode: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    a, b = np.random.default_rng(seed).normal(size=(2, DISTURBANCE))
    a[4] = b[4] = 0.0
    tie(mode, a, 0)
    tie(mode, b, 0)
    return a, b


@pytest.mark.parametrize("mode", MODES)
def test_sizes_are_those_of_the_norm(mode: int) -> None:
    a, b = pair(mode)
    w = minors(a, b)
    q = a.copy()
    free = [0, 1, *([2] if not mode & RIGHT else []), *([3] if not mode & LEFT else [])]
    scale = np.array([WEIGHT, 1.0, WEIGHT, WEIGHT])[free]
    one, other = scale * a[free], scale * b[free]
    first, both = normalise(RIG, q, w, WEIGHT, mode)
    assert first == pytest.approx(math.log(np.linalg.norm(one)), rel=1e-13)
    gram = (one @ one) * (other @ other) - (one @ other) ** 2
    assert both == pytest.approx(0.5 * math.log(gram), rel=1e-11)
    assert normalise(RIG, q, w, WEIGHT, mode) == pytest.approx((0.0, 0.0), abs=1e-14)


@pytest.mark.parametrize("mode", MODES)
def test_the_area_of_tied_disturbances(mode: int) -> None:
    a, b = pair(mode, 1)
    w = minors(a, b)
    tied = w.copy()
    press_area(mode, tied)
    np.testing.assert_allclose(tied, w, atol=1e-15)


def test_after_a_rest_it_begins_anew() -> None:
    q, w = np.zeros(DISTURBANCE), np.zeros(AREA)
    assert normalise(RIG, q, w, WEIGHT, RIGHT) == (-math.inf, -math.inf)
    assert abs(q).max() > 0.0
    assert q[2] == q[0]
