"""Where the numbers of a state stand: each has a place of its own, and flows agree with it."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine.state import BEHIND, FIRST, FRESH, MODE, ONE_MASS, Parts
from vibroimpact.response.one_mass import OneMass

SIZES = [(1, 2, 1), (1, 0, 0), (3, 5, 2)]


@pytest.mark.parametrize("sizes", SIZES)
def test_each_part_has_a_place(sizes: tuple[int, int, int]) -> None:
    parts = Parts(*sizes)
    masses, stops, memories = sizes
    places = [
        MODE,
        FRESH,
        *(parts.displacement(mass) for mass in range(masses)),
        *(parts.velocity(mass) for mass in range(masses)),
        *(parts.deformation(stop) for stop in range(stops)),
        *(parts.memory(link) for link in range(memories)),
        parts.age,
    ]
    assert places == list(range(parts.width))
    assert parts.width == FIRST + parts.total + BEHIND - 2
    point = parts.of_point
    assert (point.displacement(), point.age) == (0, parts.total)


def test_a_state_is_written_where_its_layout_says() -> None:
    stops = {"right": vi.Bumper(2e4, 300.0, 0.01), "left": vi.Bumper(3e4, 200.0, 0.02)}
    oscillator = vi.Oscillator(60.0, vi.Isolator(2e3, 40.0), **stops)
    states = OneMass(oscillator)
    state = vi.State(0.012, -0.3, {"right": 0.004, "left": 0.001})
    vector, places = states.vector_of(state), states.places
    assert len(vector) == places.width
    assert vector[places.displacement()] == 0.012
    assert vector[places.velocity()] == -0.3
    assert vector[places.deformation(0)] == 0.004
    assert vector[places.deformation(1)] == 0.001
    assert places == ONE_MASS
    np.testing.assert_array_equal(np.flatnonzero(states.velocities()), [places.of_point.velocity()])
