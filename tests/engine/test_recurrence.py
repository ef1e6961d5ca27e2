"""A motion counts as settled only if its limit is within the tolerance."""

from __future__ import annotations

import numpy as np
import pytest

from vibroimpact.engine import recurrence
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.parameters import free_rig
from vibroimpact.engine.state import FIRST, LARGEST

PARTS = 5
UNITS = np.ones(PARTS)


def settled(motion, tolerance: float, cycles: int = 6000) -> tuple[int, int]:
    """The period that is found of states, and behind how many cycles."""
    rig = free_rig()
    plan = plan_of(rig, ("motion",))
    plan[: len(rig)] = rig  # whose stiffness makes velocities of displacements
    known = np.zeros(recurrence._PAST + recurrence.LONGEST * (FIRST + LARGEST))
    recurrence.start(known)

    def state(k: int) -> np.ndarray:
        vector = np.zeros(FIRST + LARGEST + 3)
        vector[FIRST : FIRST + PARTS] = motion(k)
        return vector

    for k in range(cycles):
        recurrence.remember(plan, state(k), known, k)
        recurrence.compare(plan, state(k + 1), known, UNITS, k + 1)
        if (k + 1) % recurrence.BLOCK == 0:
            n = recurrence.verdict(plan, state(k + 1), known, UNITS, k + 1, tolerance)
            if n:
                return n, k + 1
    return 0, cycles


@pytest.mark.parametrize("rate", [0.3, 0.9, 0.99])
@pytest.mark.parametrize("tolerance", [1e-6, 1e-10])
def test_what_is_missing_is_within_the_tolerance(rate: float, tolerance: float) -> None:
    n, k = settled(lambda k: 1.0 + rate**k * np.arange(1, PARTS + 1), tolerance)
    assert n == 1
    assert rate**k * PARTS <= tolerance
    assert k > recurrence.BLOCK


def test_an_alternating_approach_is_of_one_cycle() -> None:
    assert settled(lambda k: 1.0 + (-0.7) ** k * np.ones(PARTS), 1e-10)[0] == 1


@pytest.mark.parametrize("period", [2, 3, 16])
def test_a_longer_period_is_recognised(period: int) -> None:
    places = np.random.default_rng(1).normal(size=(period, PARTS))
    assert settled(lambda k: places[k % period] + 0.8**k, 1e-10)[0] == period


def test_a_period_beyond_the_longest_is_none() -> None:
    places = np.random.default_rng(1).normal(size=(recurrence.LONGEST + 1, PARTS))
    assert settled(lambda k: places[k % len(places)], 1e-10) == (0, 6000)


def test_rounding_that_is_left_does_not_keep_a_motion_from_settling() -> None:
    noise = np.random.default_rng(1).normal(size=(400, PARTS))
    n, k = settled(lambda k: 1.0 + 0.5**k + 1e-12 * noise[k % 400], 1e-15)
    assert n == 1
    assert k < 300


def test_a_motion_that_closes_in_is_waited_for() -> None:
    """Beyond the cycles that are allowed only while it has come closer of late."""
    known = np.zeros(recurrence._PAST)
    known[recurrence._SCALE], known[recurrence._BEST], known[recurrence._SINCE] = 1.0, 1e-5, 1.0
    assert recurrence.closes_in(known, 200, 100)
    assert not recurrence.closes_in(known, 5000, 100)
    known[recurrence._SINCE] = 10.0
    assert not recurrence.closes_in(known, 200, 100)
    known[recurrence._SINCE], known[recurrence._BEST] = 1.0, 0.1
    assert not recurrence.closes_in(known, 200, 100)
