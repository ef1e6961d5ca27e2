"""A state carried into a changed rig is one that this rig can have."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine import parameters as par
from vibroimpact.engine.state import MODE, ONE_MASS
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.engine_system import engine_rig
from vibroimpact.response.hold_rows import Settling
from vibroimpact.stability.nearest_state import nearest_state
from vibroimpact.stability.parameter_sweep import rigs_along, stepped

CASE = vi.laboratory.case("B2-G1-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 2.5)


def rig_with(right, left=None, isolator=None) -> vi.Oscillator:
    return vi.Oscillator(550.0, isolator or vi.Isolator(26e3, 1e3), right, left)


def pressing(u: float, v: float = 0.1) -> np.ndarray:
    """A state that presses the bumper of the case on the right."""
    return engine_state(CASE.oscillator, vi.State(u, v))


def test_a_state_that_can_be_stays_as_it_is():
    for u in (-9e-3, -2e-3, 0.0, 5e-3, 9e-3):
        state = pressing(u)
        np.testing.assert_array_equal(nearest_state(vi.Rig(CASE.oscillator, SHAKEN), state), state)


def test_a_narrower_gap_presses_the_bumper():
    state = nearest_state(vi.Rig(rig_with(vi.Bumper(5e5, 900.0, 2e-3)), SHAKEN), pressing(5e-3))
    assert state[ONE_MASS.deformation(0)] == pytest.approx(3e-3)


def test_a_wider_gap_leaves_the_bumper_relaxing():
    state = nearest_state(vi.Rig(rig_with(vi.Bumper(5e5, 900.0, 20e-3)), SHAKEN), pressing(9e-3))
    assert state[MODE] == 0
    assert state[ONE_MASS.deformation(0)] == pytest.approx(1.5e-3)
    state = nearest_state(vi.Rig(rig_with(vi.Bumper(5e5, 0.0, 20e-3)), SHAKEN), pressing(9e-3))
    assert state[ONE_MASS.deformation(0)] == 0.0


def test_a_wall_is_not_passed():
    walls = rig_with(vi.RigidStop(0.5, 4e-3), vi.RigidStop(0.5, 3e-3))
    assert nearest_state(vi.Rig(walls, SHAKEN), pressing(9e-3))[ONE_MASS.displacement()] == 4e-3
    assert nearest_state(vi.Rig(walls, SHAKEN), pressing(-9e-3))[ONE_MASS.displacement()] == -3e-3


def test_an_isolator_remembers_no_more_than_it_can():
    rig = rig_with(None, None, vi.BilinearIsolator(5e4, 2e4, 100.0, 100.0))
    state = np.zeros(ONE_MASS.width)
    state[ONE_MASS.memory()] = -1.0
    most = engine_rig(vi.Rig(rig, SHAKEN))[par.YIELD]
    assert nearest_state(vi.Rig(rig, SHAKEN), state)[ONE_MASS.memory()] == -most


def test_frequencies_in_steps_are_a_sweep():
    """What is carried on along the frequency is what `sweep` carries on, to the bit."""
    grid = np.linspace(1.5, 3.0, 7)
    every = rigs_along(
        PARAMETERS["frequency"], vi.Rig(CASE.oscillator, SHAKEN.replace(phase=0.3)), grid
    )
    held = []
    stepped(every, None, Settling(), held.append, np.zeros(2, dtype=np.int64))
    swept = vi.sweep(CASE, grid, "forward", phase=0.3).isel(direction=0)
    np.testing.assert_array_equal(
        [one.motion.state[ONE_MASS.displacement()] for one in held],
        swept["section"].sel(component="displacement"),
    )
    np.testing.assert_array_equal([one.motion.cycles for one in held], swept["cycles"])
