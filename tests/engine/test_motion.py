"""A motion packed, mirrored and seen from its own side."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vibroimpact.engine import motion as layout
from vibroimpact.engine.motion import (
    BOTH,
    LEFT,
    RELEASED,
    RIGHT,
    SLIPS,
    STATE,
    Motion,
    coordinates,
    mirrored,
    pack,
    unpacked,
)
from vibroimpact.engine.one_mass.table import mirror_image
from vibroimpact.engine.state import FLIGHT

CLOCK = (0.6, 0.8)
MODES = [FLIGHT, RIGHT, LEFT, BOTH]
SWAPPED = {FLIGHT: FLIGHT, RIGHT: LEFT, LEFT: RIGHT, BOTH: BOTH}


def motion(mode: int, fresh: int = 0) -> Motion:
    """One whose eight numbers all differ."""
    return Motion(mode, fresh, 0.1, -0.2, (0.3, 0.4), 0.6, 0.5, CLOCK)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("fresh", [0, RIGHT, LEFT | RELEASED, SLIPS])
def test_packing_loses_nothing(mode: int, fresh: int) -> None:
    state = np.full(STATE + 2, math.nan)
    pack(motion(mode, fresh), state)
    assert unpacked(state) == motion(mode, fresh)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("fresh", [0, RIGHT, LEFT, RIGHT | RELEASED])
def test_the_mirror_image_in_the_kernel_and_in_python(mode: int, fresh: int) -> None:
    one = motion(mode, fresh)
    image = mirrored(one)
    assert image.mode == SWAPPED[mode]
    assert image.fresh == SWAPPED[fresh & BOTH] | (fresh & RELEASED)
    assert image[2:] == (-0.1, 0.2, (0.4, 0.3), -0.6, 0.5, CLOCK)
    assert mirrored(image) == one
    here, there = np.empty(STATE + 2), np.empty(STATE + 2)
    pack(one, here)
    pack(image, there)
    np.testing.assert_array_equal(mirror_image(here), there)
    np.testing.assert_array_equal(here[[layout.U, layout.V]], [0.1, -0.2])  # left as it was


def test_a_left_contact_is_seen_as_the_mirror_image_of_a_right_one() -> None:
    s, c = CLOCK
    assert coordinates(motion(FLIGHT)) == (1.0, (0.1, -0.2, s, c))
    assert coordinates(motion(RIGHT)) == (1.0, (0.3, -0.2, s, c))
    assert coordinates(motion(LEFT)) == (-1.0, (0.4, 0.2, -s, -c))
    assert coordinates(motion(BOTH)) == (1.0, (0.3, -0.2, s, c))


def test_which_way_friction_lets_go_is_mirrored() -> None:
    right, left = SLIPS << 0, SLIPS << 1
    assert mirrored(motion(FLIGHT, right)).fresh == left
    assert mirrored(motion(RIGHT, left | LEFT)).fresh == right | RIGHT
