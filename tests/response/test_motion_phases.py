"""A recorded motion followed again, phase by phase."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine.motion import BOTH
from vibroimpact.engine.observers import phases as layout
from vibroimpact.engine.observers.phases import ONE_MASS
from vibroimpact.engine.observers.record import IMPACT
from vibroimpact.response.motion_phases import (
    contact_intervals,
    parting_velocity,
    phases,
    recorded,
)

CASE = vi.laboratory.case("B2-G1-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 2.0, 0.3)
WALL = vi.Oscillator(
    2.0, vi.Isolator(5.0, 0.3), vi.RigidStop(0.4, 0.1), vi.Bumper(40.0, 0.5, 0.02), force=3.0
)


@pytest.fixture(scope="module")
def motion():
    return vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 6.4, samples=512)


def test_a_row_has_a_place_for_each_mass_and_each_stop():
    """The columns of several masses do not overlap, and fill the row."""
    for masses, stops, drifts in ((1, 2, 0), (3, 0, 2), (2, 5, 1)):
        several = layout.Layout(masses, stops, drifts)
        columns = [
            *range(layout.SYSTEM),
            *(several.mass(i, n) for n in range(masses) for i in range(layout.MASS)),
            *(several.stop(i, n) for n in range(stops) for i in range(layout.STOP)),
            *(several.drift(i, n) for n in range(drifts) for i in range(layout.DRIFT)),
        ]
        assert columns == list(range(several.width))
    assert ONE_MASS == (1, 2, 0)


def test_they_are_those_between_the_events(motion):
    """To the last bit: the motion that is followed again is the same."""
    every = phases(motion, recorded(motion))
    rows, events = every.rows, motion.sizes["event"]
    assert len(rows) == events + 1
    np.testing.assert_array_equal(every.bounds[1:-1], motion["event_time"])
    np.testing.assert_array_equal(rows[:-1, layout.KIND], motion["event_contact"])
    side = np.where(motion["event_stop"] == "right", 0, 1)
    np.testing.assert_array_equal(rows[:-1, layout.AT_STOP], side)
    np.testing.assert_array_equal(every.of_mass(layout.ARRIVAL)[:-1, 0], motion["event_velocity"])
    assert rows[-1, layout.KIND] == layout.NOTHING
    assert every.bounds[-1] == pytest.approx(6.4 / 2.0, rel=1e-12)
    np.testing.assert_allclose(np.diff(every.bounds), rows[:, layout.LENGTH], rtol=1e-9)
    touched = every.pressed
    assert (np.abs(np.diff(touched.any(axis=1).astype(int))) == 1).all()  # flights between contacts
    assert every.notes == []


def test_more_phases_than_there_is_room_for_at_first():
    """The room grows meanwhile: a section is then followed again, and no phase counts twice."""
    data = vi.simulate(vi.Rig(WALL, vi.Harmonic(2.0, 0.3)), 130, vi.State(0.05, 0.3), samples=8)
    every = phases(data, recorded(data))
    assert len(every.rows) > 1500
    assert len(every.rows) == data.sizes["event"] + 1
    np.testing.assert_array_equal(every.bounds[1:-1], data["event_time"])
    assert every.rows[:, layout.LENGTH].sum() == pytest.approx(float(data["time"][-1]), rel=1e-12)


def test_an_instant_has_a_phase(motion):
    first = motion.isel(time=[0])
    every = phases(first, recorded(first))
    (row,) = every.rows
    u = float(first["displacement"][0])
    for column in (layout.U_LEAST, layout.U_MOST):
        assert row[ONE_MASS.mass(column)] == pytest.approx(u, abs=1e-15)
    assert row[layout.LENGTH] == pytest.approx(0.0, abs=1e-200)


def test_whose_motion_it_is(motion):
    origin = recorded(motion)
    assert (origin.oscillator, origin.shaking.phase) == (CASE.oscillator, 0.3)
    assert (origin.cycles, origin.periodic) == (6.4, False)
    with pytest.raises(vi.InputError, match="this is not a recorded motion"):
        recorded(motion["displacement"])
    steady = vi.steady(vi.Rig(CASE.oscillator, SHAKEN))
    assert recorded(steady).periodic
    for part in (slice(3, None), slice(0, -3)):
        assert not recorded(steady.isel(time=part)).periodic


def test_contacts_from_the_events_alone():
    rig, start = WALL.replace(left=vi.Bumper(40.0, 0.5, -0.15)), vi.State(0.05, 0.3)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(4.0, 0.3)), 9.2, start, samples=64)
    every = phases(data, recorded(data))
    parting = parting_velocity(data, rig)
    np.testing.assert_allclose(parting, every.of_mass(layout.PARTING)[:-1, 0], rtol=1e-15)
    assert (every.rows[:, layout.KIND] == IMPACT).any()
    assert (every.rows[:, layout.TOUCHED] == BOTH).any()
    for number, side in enumerate(("right", "left")):
        held = contact_intervals(data, side, data["event_time"].values, float(data["time"][-1]))
        touched = every.pressed[:, number]
        assert touched.any()
        length = every.rows[touched, layout.LENGTH].sum()
        assert np.diff(held).sum() == pytest.approx(length, rel=1e-9)
        assert (held[1:, 0] > held[:-1, 1]).all()
