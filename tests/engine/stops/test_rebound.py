"""The laws of rebound of rigid walls: how they stand in a vector, and how one is asked."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vibroimpact.engine.stops import rebound as laws
from vibroimpact.engine.stops.rebound import Rebound
from vibroimpact.law_numbers import Wall


def falling(numbers: Any, at: int, speed: float) -> Rebound:
    """1 / (1 + a w): no impact is as another."""
    e = 1.0 / (1.0 + numbers[at + 1] * speed)
    return Rebound(e, e, 1.0)


def half(numbers: Any, at: int, speed: float) -> Rebound:
    """Half of its number."""
    return Rebound(0.5 * numbers[at], 1.0, 0.5 * numbers[at])


def test_each_law_is_asked_for_by_its_place() -> None:
    ask = laws.choice({"constant": laws.constant, "falling": falling, "half": half})
    numbers = [9.0, 0.0, 0.6, 0.25]
    expected = {0.0: (0.6, 1.0, 0.6), 1.0: (2.0 / 3.0, 2.0 / 3.0, 1.0), 2.0: (0.3, 1.0, 0.3)}
    for code, ratios in expected.items():
        numbers[1] = code
        assert tuple(ask(np.array(numbers), 1, 2.0)) == pytest.approx(ratios, rel=1e-15)


def test_a_constant_restitution_and_its_gap_are_a_wall() -> None:
    wall = Wall("constant", (0.7,), 0.1)
    assert laws.written((0.7, 0.1)) == laws.written(wall) == [0.0, 0.7, 0.0, 0.0, 0.0]
    speeds = np.array([[0.0, 1.0], [2.0, 3.0]])
    assert (laws.restitutions(wall, speeds) == np.full((2, 2), 0.7)).all()
    assert laws.restitutions(wall, np.empty(0)).shape == (0,)


def test_a_law_has_few_numbers_and_a_known_name() -> None:
    with pytest.raises(ValueError, match="at most 4"):
        laws.written(Wall("constant", (0.7, 1.0, 2.0, 3.0, 4.0), 0.1))
    with pytest.raises(ValueError, match="'soft' is not a law of rebound; constant"):
        laws.written(Wall("soft", (0.7,), 0.1))
