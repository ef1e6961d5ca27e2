"""Where a motion goes, and where it is later."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine.one_mass.table import mirror_image
from vibroimpact.engine.status import Status
from vibroimpact.response.engine_input import engine_state
from vibroimpact.stability.settled_motion import approach, reach, state_distance

CASE = vi.laboratory.case("B3-10mm-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 1.2, 0.4)


def test_it_repeats_itself():
    motion = approach(vi.Rig(CASE.oscillator, SHAKEN), vi.State())
    assert (motion.status, motion.period) == (Status.DONE, 1)
    status, state = motion.engine.propagate(motion.state, 1.0)
    assert status is Status.DONE
    assert state_distance(motion, motion.state, state, reach(motion, motion.state)) < 1e-11


def test_a_start_as_the_engine_sees_it():
    start = vi.State(2e-3, -0.05)
    vector = engine_state(CASE.oscillator, start)
    motions = [approach(vi.Rig(CASE.oscillator, SHAKEN), initial) for initial in (start, vector)]
    np.testing.assert_array_equal(motions[0].state, motions[1].state)
    np.testing.assert_array_equal(vector, engine_state(CASE.oscillator, start))


def test_the_phase_of_a_start_is_that_of_the_section():
    motion = approach(vi.Rig(CASE.oscillator, SHAKEN), vi.State(phase=1.3))
    assert motion.excitation == SHAKEN.replace(phase=1.3)


def test_the_mirror_image_half_a_cycle_later_is_a_motion():
    motion = approach(vi.Rig(CASE.oscillator, SHAKEN), vi.State())
    _, half = motion.engine.propagate(motion.state, 0.5)
    image = approach(vi.Rig(CASE.oscillator, SHAKEN), mirror_image(half))
    assert image.cycles < 16 < motion.cycles
    size = reach(motion, motion.state)
    assert state_distance(motion, image.state, mirror_image(half), size) < 1e-10
    assert state_distance(motion, image.state, motion.state, size) > 1e-2  # one of a pair


@pytest.mark.parametrize("cycles", [0.5, 3.0])
def test_a_limit_that_is_met_is_told(cycles):
    motion = approach(vi.Rig(CASE.oscillator, SHAKEN), vi.State())
    assert motion.engine.propagate(motion.state, cycles, max_events=1)[0] is Status.TOO_MANY_EVENTS
