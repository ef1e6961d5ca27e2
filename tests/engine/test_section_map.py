"""A Newton step may land where no motion can be; it is put where one can."""

from __future__ import annotations

import numpy as np
import pytest

from vibroimpact.engine.motion import LEFT, RIGHT, Motion, unpacked
from vibroimpact.engine.one_mass.table import place
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.state import FLIGHT
from vibroimpact.law_numbers import IsolatorNumbers, PowerLaw, StopNumbers

DAMPED, PLAIN, WALL = (20.0, 0.4, 1.0), (20.0, 0.0, 1.0), (0.5, 1.0)


def placed(rig: np.ndarray, mode: int, *parts: float) -> Motion:
    state = np.array([mode, 0.0, *parts, 0.0, 0.0, 1.0])
    place(rig, state)
    motion: Motion = unpacked(state)
    return motion


def put(
    right: StopNumbers | None,
    left: StopNumbers | None,
    mode: int,
    u: float,
    v: float,
    r: float,
    lft: float,
) -> Motion:
    return placed(rig_vector(1.0, 1.0, 0.1, right, left), mode, u, v, r, lft, 0.0)


@pytest.mark.parametrize(
    ("right", "left", "start", "mode", "u", "deformations"),
    [
        # In flight a bumper's deformation is its own, but it does not pull.
        (DAMPED, DAMPED, (FLIGHT, 0.5, 0.0, 0.1, -0.1), FLIGHT, 0.5, (0.1, 0.0)),
        # Without a dashpot it is gone at once.
        (PLAIN, DAMPED, (FLIGHT, 0.5, 0.0, 0.1, 0.2), FLIGHT, 0.5, (0.0, 0.2)),
        # A mass inside a bumper presses it.
        (DAMPED, DAMPED, (FLIGHT, 1.25, 0.0, 0.1, 0.0), RIGHT, 1.25, (0.25, 0.0)),
        (DAMPED, DAMPED, (FLIGHT, -1.25, 0.0, 0.0, 0.1), LEFT, -1.25, (0.0, 0.25)),
        # Flung back too fast it has left it already: the force would pull.
        (DAMPED, DAMPED, (RIGHT, 1.25, -100.0, 0.25, 0.0), FLIGHT, 1.25, (0.25, 0.0)),
        # Out of a contact that is none.
        (DAMPED, DAMPED, (RIGHT, 0.75, 0.0, 0.3, 0.0), FLIGHT, 0.75, (0.0, 0.0)),
        # No mass inside a wall; at rest only who rests.
        (WALL, DAMPED, (FLIGHT, 1.25, 0.5, 0.3, 0.0), FLIGHT, 1.0, (0.0, 0.0)),
        (WALL, DAMPED, (RIGHT, 1.0, 0.0, 0.0, 0.0), RIGHT, 1.0, (0.0, 0.0)),
        (WALL, DAMPED, (RIGHT, 1.0, -0.5, 0.0, 0.0), FLIGHT, 1.0, (0.0, 0.0)),
        # Where there is no stop there is nothing to press.
        (None, DAMPED, (FLIGHT, 9.0, 0.0, 0.0, 0.0), FLIGHT, 9.0, (0.0, 0.0)),
    ],
)
def test_the_nearest_state_that_can_be(right, left, start, mode, u, deformations) -> None:
    motion = put(right, left, *start)
    assert motion.mode == motion.fresh == mode
    assert motion.u == u
    assert motion.v == start[2]
    assert motion.faces == pytest.approx(deformations, abs=1e-15)


def test_a_spring_that_yields_is_not_stretched_further() -> None:
    rig = rig_vector(1.0, 1.0, 0.1, None, None, law=IsolatorNumbers(hysteretic=2.0, limit=0.2))
    for memory, z in ((0.1, 0.1), (0.3, 0.2), (-7.0, -0.2)):
        assert placed(rig, FLIGHT, 0.5, 0.0, 0.0, 0.0, memory).z == z


def test_a_stop_without_memory_keeps_its_closing_speed_only_where_it_is_pressed() -> None:
    rig = rig_vector(1.0, 1.0, 0.1, PowerLaw(20.0, 1.5, -0.5, 0.0, 1.0), None)
    pressed = placed(rig, FLIGHT, 1.25, 0.0, 0.7, 0.0, 0.0)
    assert (pressed.mode, pressed.faces[0]) == (RIGHT, 0.7)
    free = placed(rig, RIGHT, 0.75, 0.0, 0.7, 0.0, 0.0)
    assert (free.mode, free.faces[0]) == (FLIGHT, 0.0)
