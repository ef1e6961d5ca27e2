"""States that are followed until they are caught."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.attraction.label_states import (
    NO_TRAPS,
    CaughtStates,
    Region,
    SectionSetup,
    Traps,
    follow_region,
)
from vibroimpact.engine.absorption import CENTRE, OWNER, REACH, form_of, trap_width
from vibroimpact.engine.status import Status
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.prepared_rig import prepare

CASE = vi.laboratory.case("B3-10mm-A3")
EXCITATION = vi.Harmonic(CASE.amplitude, 0.7, 0.4)
STAGE = SectionSetup(vi.Rig(CASE.oscillator, EXCITATION))
STARTS = np.array([[0.0, 0.0], [0.01, 0.05], [-0.004, 0.08], [0.007, -0.02]])


def points() -> np.ndarray:
    coordinates = np.zeros((len(STARTS), 5))
    coordinates[:, :2] = STARTS
    return coordinates


def followed(region: Region) -> CaughtStates:
    return follow_region(region, np.zeros(2, dtype=np.int64))


def begun(traps: Traps, cycles: int, stage: SectionSetup = STAGE) -> CaughtStates:
    return followed(Region(stage, points(), np.zeros((len(STARTS), 8)), traps, cycles))


def ball(owner: int, centre: np.ndarray, radius: float) -> np.ndarray:
    row = np.zeros(trap_width(5))
    row[OWNER], row[REACH], row[CENTRE : CENTRE + 5] = owner, radius, centre
    row[form_of(5) :] = (np.diag([1.0, 1.0, 0.0, 0.0, 0.0]) / radius**2).ravel()
    return row


def states_after(cycles: int) -> np.ndarray:
    engine = prepare(vi.Rig(CASE.oscillator, EXCITATION))
    begin = [engine_state(CASE.oscillator, vi.State(u, v)) for u, v in STARTS]
    if not cycles:
        return np.array(begin)
    return np.array([engine.propagate(one, cycles)[1] for one in begin])


@pytest.mark.parametrize("cycles", [0, 1, 5])
def test_without_traps_states_are_where_they_lead(cycles):
    ends = begun(NO_TRAPS, cycles)
    np.testing.assert_allclose(ends.states[:, 2:7], states_after(cycles)[:, 2:7], atol=1e-15)
    np.testing.assert_array_equal(ends.states[:, 0], states_after(cycles)[:, 0])
    assert (ends.owner == -1).all()
    assert (ends.cycles == cycles).all()
    assert (ends.outcome == Status.NOT_SETTLED).all()


def test_a_ball_catches_the_first_that_comes():
    where = states_after(3)[1, 2:4]
    centre = np.array([*where, 0.0, 0.0, 0.0])
    rows = np.array([ball(7, centre + 1.0, 1e-3), ball(4, centre, 1e-9)])
    ends = begun(Traps(rows, NO_TRAPS.cells, NO_TRAPS.grid), 10)
    assert list(ends.owner) == [-1, 4, -1, -1]
    assert list(ends.cycles) == [10, 3, 10, 10]
    assert ends.outcome[1] == Status.DONE
    others = states_after(10)[[0, 2, 3]]  # what is caught need not go on
    np.testing.assert_allclose(ends.states[:, 2:7], others[:, 2:7], atol=1e-15)


def test_cells_catch_as_well():
    where = states_after(2)[2, 2:4]
    side = np.array([1e-5, 1e-4])
    cells = np.full((3, 5), -1, dtype=np.int64)
    cells[2, 1] = 9  # row along the velocity, column along the displacement
    corner = where - side * [1.5, 2.5]
    ends = begun(Traps(NO_TRAPS.rows, cells, np.array([*corner, *side])), 10)
    assert list(ends.owner) == [-1, -1, 9, -1]
    assert ends.cycles[2] == 2


def test_a_limit_is_told():
    ends = begun(NO_TRAPS, 10, STAGE._replace(max_events=1))
    assert Status.TOO_MANY_EVENTS in ends.outcome
    given_up = ends.outcome == Status.TOO_MANY_EVENTS
    assert (ends.cycles[given_up] < 10).all()
    assert len(ends.states) == (~given_up).sum()


def test_it_stops_when_told():
    progress = np.array([0, 1], dtype=np.int64)
    region = Region(STAGE, points(), np.zeros((len(STARTS), 8)), NO_TRAPS, 10)
    ends = follow_region(region, progress)
    assert (ends.outcome == Status.STOPPED).all()
    assert (ends.cycles == 0).all()


def test_a_region_is_all_that_is_needed_elsewhere():
    import pickle

    region = Region(STAGE, points(), np.zeros((len(STARTS), 8)), NO_TRAPS, 10)
    there = pickle.loads(pickle.dumps(followed(pickle.loads(pickle.dumps(region)))))
    np.testing.assert_array_equal(there.states, followed(region).states)
